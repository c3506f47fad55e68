import json
from dataclasses import dataclass

import msgspec
import numpy as np
import pytest

from planner.files.versioned_document import document_text


class Numbers(msgspec.Struct):
    """What a search may leave in a document."""

    value: object


@dataclass(frozen=True)
class Stranger:
    """Not JSON, because of what it holds."""

    value: complex


@pytest.mark.parametrize("value", [np.float64(0.25), np.int64(3), np.bool_(True)])
def test_a_number_of_numpy_is_a_number(value: np.generic) -> None:
    assert json.loads(document_text(Numbers(value))) == {"value": value.item()}


def test_what_is_no_json_is_refused() -> None:
    with pytest.raises(NotImplementedError, match="complex"):
        document_text(Numbers(Stranger(1j)))
