"""What of the parts' surfaces a finger can reach."""

import numpy as np
import pytest

from planner.candidates.even import even_candidates
from planner.objects.parts.box import Box
from planner.objects.parts.ellipsoid import Ellipsoid
from planner.objects.pose import Pose
from planner.objects.surface.exposure import FINGERTIP, exposed, reachable
from tests.strategies.parts import box, rigid_object

UP = np.array([[0.0, 0.0, -1.0]])  # inward normal of a top face


@pytest.mark.parametrize(
    ("neighbour", "open_"),
    [
        (box((1, 1, 1), (0, 0, 3)), True),  # far above
        (box((1, 1, 1), (0, 0, 1.5)), False),  # overlapping
        (box((1, 1, 1), (0, 0, 2)), False),  # glued on
        (box((1, 1, 1), (0, 0, 2.01)), False),  # above a crack
        (box((1, 1, 1), (0.5, 0, 0)), True),  # coplanar tops
        (box((0.999, 1, 1), (1, 0, 2)), True),  # a step next to the point
    ],
)
def test_a_face_is_reachable_unless_another_part_covers_it(neighbour: Box, open_: bool) -> None:
    thing = rigid_object(box((1, 1, 1)), neighbour)
    assert exposed(thing, np.array([[0.0, 0.0, 1.0]]), UP, np.array([0])).tolist() == [open_]


def test_beside_another_parts_wall_there_must_be_room_for_a_fingertip() -> None:
    step = rigid_object(box((1, 1, 1)), box((0.25, 1, 1), (-0.75, 0, 2)))  # its wall is at x = -0.5
    from_wall = FINGERTIP * step.size * np.array([0.5, 0.99, 1.01, 10.0])
    points = np.stack([from_wall - 0.5, np.zeros(4), np.ones(4)], axis=1)
    normals, part = np.repeat(UP, 4, axis=0), np.zeros(4, dtype=int)
    assert reachable(step, points, normals, part).tolist() == [False, False, True, True]
    assert exposed(step, points, normals, part).all()


def test_coplanar_faces_side_by_side_leave_room_for_a_fingertip() -> None:
    pair = rigid_object(box((1, 1, 1)), box((1, 1, 1), (2, 0, 0)))
    assert reachable(pair, np.array([[0.9999, 0.0, 1.0]]), UP, np.array([0])).tolist() == [True]


def test_a_part_that_another_holds_takes_no_room_from_fingertips() -> None:
    def ellipsoid(shrink: float) -> Ellipsoid:
        semi_axes = np.array([0.04, 0.02, 0.05]) - shrink
        return Ellipsoid(geom="e", friction=0.5, pose=Pose.identity(), semi_axes=semi_axes)

    for shrink in (0.0, 1e-6, 1e-3):
        twins = rigid_object(ellipsoid(0.0), ellipsoid(shrink))
        assert len(even_candidates(twins, 100, None, seed=0)) == 100
