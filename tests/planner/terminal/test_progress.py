"""Estimates of the time left are what the pace says, and never nonsense."""

import pytest

from planner.terminal.progress import PATIENCE, Pace, in_words, progress_text, seconds_left


def test_the_rest_takes_as_long_as_the_pace_says() -> None:
    assert seconds_left(10.0, 5, 20) == 30.0
    assert seconds_left(10.0, 20, 20) == 0.0
    assert seconds_left(10.0, 25, 20) == 0.0
    assert seconds_left(10.0, 0, 20) is None


def test_at_a_steady_pace_every_estimate_is_right_once_there_is_one() -> None:
    pace, rate, total, began = Pace(), 4.0, 90.0, 1000.0
    for second in range(20):
        left = pace.left(rate * second, total, began + second)
        assert left == (pytest.approx(total / rate - second) if second >= PATIENCE else None)


def test_work_found_half_done_is_timed_by_what_is_done_since() -> None:
    pace = Pace()
    assert pace.left(50, 100, 0.0) is None
    assert pace.left(60, 100, 10.0) == pytest.approx(40.0)


def test_a_count_that_falls_is_new_work_with_a_pace_of_its_own() -> None:
    pace = Pace()
    pace.left(0, 10, 0.0)
    assert pace.left(10, 10, 100.0) == 0.0
    assert pace.left(0, 30, 100.0) is None
    assert pace.left(3, 30, 103.0) == pytest.approx(27.0)


def test_more_work_than_expected_lengthens_the_estimate() -> None:
    pace = Pace()
    pace.left(0, 100, 0.0)
    assert pace.left(50, 100, 10.0) == pytest.approx(10.0)
    assert pace.left(50, 200, 10.0) == pytest.approx(30.0)


@pytest.mark.parametrize(
    ("seconds", "words"),
    [(0.0, "0 s"), (41.6, "42 s"), (119.0, "119 s"), (125.0, "2 min"), (3590.0, "1 h 0 min"), (7500.0, "2 h 5 min")],
)
def test_durations_are_as_exact_as_an_estimate_deserves(seconds: float, words: str) -> None:
    assert in_words(seconds) == words


def test_progress_says_how_much_of_how_much_and_how_long() -> None:
    assert progress_text("grasps (mug)", 12, 90, 400.0) == "12 of 90 grasps (mug), about 7 min left"
    assert progress_text("subsets", 0, 1_679_580, None) == "0 of 1,679,580 subsets"
