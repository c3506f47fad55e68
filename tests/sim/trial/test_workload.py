"""The progress of a measurement is told as one count that never falls and ends where it said it would."""

from dataclasses import replace

import pytest

from sim.squeeze.squeeze import measure_squeeze_force
from sim.trial.workload import Workload
from sim.validation.critical_force import expected_simulations
from sim.validation.validation import validate_contacts
from tests.strategies.planned_grasps import prism

Told = list[tuple[str, float, float]]


def test_parts_add_up_to_the_whole() -> None:
    told: Told = []
    work = Workload(lambda *line: told.append(line), 30)
    first = work.part("first", 10)
    first(5)
    second = work.part("second", 20)
    second(20)
    assert told == [
        ("simulations (first)", 0, 30),
        ("simulations (first)", 5, 30),
        ("simulations (second)", 10, 30),
        ("simulations (second)", 30, 30),
    ]


def test_a_part_that_grows_makes_the_whole_grow() -> None:
    told: Told = []
    part = Workload(lambda *line: told.append(line), 30).part("bisecting", 10)
    part(5, 40)
    assert told[-1] == ("simulations (bisecting)", 5, 60)


def test_a_validation_tells_how_far_it_is() -> None:
    few = replace(prism(), wrenches=prism().wrenches[::16])
    told: Told = []
    validate_contacts(few.loaded, measure=True, observe=lambda *line: told.append(line))
    done = [line[1] for line in told]
    count = len(few.wrenches)
    assert done == sorted(done)
    assert {line[2] for line in told} == {2 * count + 4 + expected_simulations(count)}
    assert done[-1] == pytest.approx(told[-1][2])
    assert len({line[0] for line in told}) == 3


def test_a_squeeze_tells_how_far_it_is() -> None:
    few = replace(prism(), wrenches=prism().wrenches[::16])
    told: Told = []
    measure_squeeze_force(few.loaded, observe=lambda *line: told.append(line))
    done, expected = [line[1] for line in told], [line[2] for line in told]
    assert done == sorted(done)
    assert expected == sorted(expected, reverse=True)
    assert done[-1] <= expected[-1]
