import pytest

from planner.counted import counted


@pytest.mark.parametrize(("number", "said"), [(0, "no cuts"), (1, "1 cut"), (2, "2 cuts"), (12000, "12,000 cuts")])
def test_a_noun_agrees_with_its_number(number: int, said: str) -> None:
    assert counted(number, "cut") == said
