"""Lengths on a screen: in mm, readable at any size."""

import numpy as np
import pytest

from planner.millimetres import in_mm, point_in_mm


@pytest.mark.parametrize(
    ("length", "shown"),
    [(0.04, "40"), (80.0, "80000"), (1234.5678, "1235000"), (1.23456e-7, "0.0001235"), (-0.0, "0"), (np.inf, "inf")],
)
def test_a_length_has_four_digits_and_no_exponent(length: float, shown: str) -> None:
    assert in_mm(length) == shown


def test_fewer_digits_are_rounded() -> None:
    assert in_mm(0.0019999, 1) == "2"


def test_a_point_is_printed_to_a_thousandth_and_has_no_negative_zero() -> None:
    assert point_in_mm(np.array([-1e-12, 0.0123456, -100.0])) == "(0, 12.346, -100000)"
