"""A planar object as a slab of convex pieces."""

import mujoco
import numpy as np
import pytest

from planner.arrays import Floats
from planner.errors import ObjectError
from planner.objects.planar.ear_clipping import is_convex, triangles
from planner.objects.planar.extrusion import extruded
from planner.objects.planar.simple_polygon import signed_area
from tests.strategies.planar_objects import HOOK, RECTANGLE, planar_object, star

COMB = [(0, 0), (6, 0), (6, 2), (5, 2), (5, 1), (4, 1), (4, 2), (3, 2), (3, 1), (2, 1), (2, 2), (0, 2)]
"""Its corners lie on few lines: what is left while ears are cut off has straight angles."""

POLYGONS = [np.array(RECTANGLE), np.array(HOOK), np.array(COMB, dtype=float), *map(star, range(40))]


@pytest.mark.parametrize("corners", POLYGONS)
def test_triangles_fill_the_polygon_without_overlap(corners: Floats) -> None:
    """As many as there must be, each with area, together of the polygon's area, none of them outside."""
    cut = triangles(corners)
    areas = [signed_area(corners[list(triangle)]) for triangle in cut]
    assert len(cut) == len(corners) - 2
    assert min(areas) > 0
    assert sum(areas) == pytest.approx(signed_area(corners))
    outline = planar_object([tuple(corner) for corner in corners.tolist()]).outline
    assert (outline.depth(np.array([corners[list(triangle)].mean(axis=0) for triangle in cut])) > 0).all()


def test_a_polygon_without_ears_is_refused() -> None:
    clockwise = np.array(RECTANGLE[::-1])
    with pytest.raises(ObjectError, match="cannot be cut into triangles"):
        triangles(clockwise)


def test_a_convex_outline_is_one_piece_and_a_concave_one_is_not() -> None:
    assert is_convex(np.array(RECTANGLE))
    assert len(extruded(planar_object(RECTANGLE)).parts) == 1
    assert len(extruded(planar_object(HOOK)).parts) == len(HOOK) - 2


def test_the_slab_is_the_area_times_the_thickness() -> None:
    planar = planar_object(HOOK, thickness=0.5)
    slab = extruded(planar)
    np.testing.assert_allclose(slab.extent, [4, 3, 0.5])
    generator = np.random.default_rng(0)
    points = np.column_stack([generator.uniform(-0.5, 4.5, (2000, 2)), generator.uniform(-0.4, 0.4, 2000)])
    inside = np.max([part.depth(points) for part in slab.parts], axis=0) > 0
    np.testing.assert_array_equal(inside, (planar.outline.depth(points[:, :2]) > 0) & (np.abs(points[:, 2]) < 0.25))


def test_mass_and_inertia_are_those_mujoco_gives_three_boxes() -> None:
    """The hook as boxes of 1 kg per unit of area."""
    boxes = ((2, 0.5, 2, 0.5), (3.5, 2, 0.5, 1), (0.5, 1.5, 0.5, 0.5))
    geoms = "".join(f'<geom type="box" pos="{x} {y} 0" size="{a} {b} 0.3" mass="{4 * a * b}"/>' for x, y, a, b in boxes)
    model = mujoco.MjModel.from_xml_string(f"<mujoco><worldbody><body>{geoms}</body></worldbody></mujoco>")
    slab = extruded(planar_object(HOOK, mass=7.0, thickness=0.6))
    turn = np.zeros(9)
    mujoco.mju_quat2Mat(turn, model.body_iquat[1])
    axes = turn.reshape(3, 3)
    assert slab.mass == pytest.approx(model.body_mass[1])
    np.testing.assert_allclose(slab.center_of_mass, model.body_ipos[1], atol=1e-12)
    np.testing.assert_allclose(slab.inertia, axes @ np.diag(model.body_inertia[1]) @ axes.T, atol=1e-9)
