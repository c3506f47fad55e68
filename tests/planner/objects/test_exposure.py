"""What of the parts' surfaces a finger can reach."""

import numpy as np
import pytest

from planner.objects.exposure import exposed
from tests.planner.objects.shapes import box, rigid_object

UP = np.array([[0.0, 0.0, -1.0]])  # inward normal of a top face


@pytest.mark.parametrize(
    ("neighbour", "reachable"),
    [
        (box((0, 0, 3), (1, 1, 1)), True),  # far above
        (box((0, 0, 1.5), (1, 1, 1)), False),  # overlapping
        (box((0, 0, 2), (1, 1, 1)), False),  # glued on
        (box((0, 0, 2.01), (1, 1, 1)), False),  # above a crack
        (box((0.5, 0, 0), (1, 1, 1)), True),  # coplanar tops
        (box((1, 0, 2), (0.999, 1, 1)), True),  # a step next to the point
    ],
)
def test_a_face_is_reachable_unless_another_part_covers_it(neighbour: object, reachable: bool) -> None:
    thing = rigid_object(box((0, 0, 0), (1, 1, 1)), neighbour)  # type: ignore[arg-type]
    assert exposed(thing, np.array([[0.0, 0.0, 1.0]]), UP, np.array([0])).tolist() == [reachable]
