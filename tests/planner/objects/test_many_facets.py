"""A mesh of many facets is read and planned on in bounded memory and in seconds, with what all facets would say."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import trimesh

import planner.objects.parts.hull as hulls
from planner.arrays import Floats
from planner.objects.mjcf.reader import read_object
from planner.objects.mjcf.visual import visual_difference
from planner.objects.parts.planes import MOST_ASKED, Planes
from planner.objects.parts.polyhedron import TIE, Polyhedron
from planner.objects.pose import Pose
from planner.objects.surface.coincident import covered_parts
from planner.objects.vectors import norm
from planner.pictures.sharp_edges import sharp_edges
from tests.strategies.parts import rigid_object
from tests.tools.commands import ROOT

RADIUS, MOST_BYTES, MOST_SECONDS = 0.03, 1e9, 60
MOST_CPU_SECONDS = 20
"""For 40,000 facets in any shape; when bounds were those of balls, needles and discs took twice that."""

FAR = np.array([1.0, -2.0, 0.5])
"""Where a body frame may be, metres from the object."""

TURN = Pose(position=np.zeros(3), quaternion=np.array([0.5, -0.1, 0.7, 0.5]))
"""How its axes may be turned."""

READ_AND_CHOOSE = """
import resource, sys
from pathlib import Path
from planner.candidates.choice import make_candidates
from planner.objects.object_file import read_object_file
ball = read_object_file(Path(sys.argv[1]))
candidates = make_candidates(ball, "300")
print(len(ball.parts[0].polygons), len(candidates), 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
"""


@pytest.mark.slow
def test_a_ball_of_80_000_facets_is_read_and_gets_candidates_in_a_gigabyte(tmp_path: Path) -> None:
    command = [sys.executable, "-c", READ_AND_CHOOSE, str(ball(tmp_path, subdivisions=6))]
    output = subprocess.check_output(command, cwd=ROOT, text=True, timeout=MOST_SECONDS)
    facets, candidates, peak = map(int, output.split())
    assert (facets, candidates) == (81_920, 300)
    assert peak < MOST_BYTES


INSPECT = """
import resource
from planner.commands.inspect import main
try:
    main()
finally:
    used = resource.getrusage(resource.RUSAGE_SELF)
    print(used.ru_utime + used.ru_stime, 1024 * used.ru_maxrss)
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    "balls",
    [[(3, 3, 100)], [(50, 50, 2)], [(30, 30, 30), (30, 30, 30)], [(30, 30, 30), (30.000003,) * 3]],
    ids=["needle", "disc", "twins", "near twins"],
)
def test_thin_and_doubled_shapes_of_40_000_facets_are_inspected_as_fast_as_balls(
    balls: list[tuple[float, float, float]], tmp_path: Path
) -> None:
    path = stretched_balls(tmp_path, 20_000, balls)
    command = [sys.executable, "-c", INSPECT, str(path)]
    output = subprocess.check_output(command, cwd=ROOT, text=True, timeout=10 * MOST_SECONDS)
    assert "300, " in output.split("candidates")[1]
    assert ("coincide: planned on as one" in output) == (len(balls) > 1)
    seconds, peak = map(float, output.split()[-2:])
    assert seconds < MOST_CPU_SECONDS
    assert peak < MOST_BYTES


def stretched_balls(folder: Path, corners: int, half_lengths: list[tuple[float, float, float]]) -> Path:
    """A file with ellipsoids [mm] about one centre, each of about twice as many facets as corners."""
    turns = np.arange(corners) + 0.5
    heights, angles = 1 - 2 * turns / corners, np.pi * (1 + 5**0.5) * turns  # Fibonacci's spiral
    radii = np.sqrt(1 - heights**2)
    ball = np.column_stack([radii * np.cos(angles), radii * np.sin(angles), heights])
    meshes = [f'<mesh name="m{number}" file="{number}.stl"/>' for number in range(len(half_lengths))]
    geoms = [f'<geom type="mesh" mesh="m{number}" mass="0.01"/>' for number in range(len(half_lengths))]
    for number, stretch in enumerate(half_lengths):
        hull = trimesh.convex.convex_hull(ball)
        hull.vertices *= 1e-3 * np.array(stretch)
        hull.export(folder / f"{number}.stl")
    path = folder / "balls.xml"
    path.write_text(
        f"<mujoco><asset>{''.join(meshes)}</asset><worldbody><body><freejoint/>{''.join(geoms)}</body></worldbody>"
        "</mujoco>"
    )
    return path


def test_a_fine_mesh_that_is_its_own_hull_looks_as_it_collides(tmp_path: Path) -> None:
    difference = visual_difference(read_object(ball(tmp_path, subdivisions=5)))
    assert difference is not None
    assert difference.largest < 1e-6 * RADIUS


def ball(folder: Path, subdivisions: int) -> Path:
    """A file with a ball of 20 * 4^subdivisions facets."""
    trimesh.creation.icosphere(subdivisions=subdivisions, radius=RADIUS).export(folder / "ball.stl")
    path = folder / "ball.xml"
    path.write_text(
        '<mujoco><asset><mesh name="b" file="ball.stl"/></asset><worldbody><body><freejoint/><geom type="mesh" '
        'mesh="b" mass="0.2"/></body></worldbody></mujoco>'
    )
    return path


def lump(
    corners: int, half_lengths: tuple[float, float, float], power: float = 1.0, at: Floats = FAR, turn: Pose = TURN
) -> Polyhedron:
    """A superellipsoid of about twice as many facets as corners; below 1 the power makes it boxy."""
    directions = np.random.default_rng(corners).normal(size=(corners, 3))
    directions /= norm(directions)[:, None]
    vertices = np.sign(directions) * np.abs(directions) ** power * half_lengths
    return Polyhedron.hull(turn.rotate(vertices) + at, geom="lump", friction=0.5)


def near_and_far(part: Polyhedron) -> Floats:
    """Points inside, on, and outside of a part: also its corners, and the middles of facets and of edges."""
    triangles, _ = part.triangles()
    lower, upper = 2 * part.bounds() - part.bounds().mean(axis=0)
    anywhere = np.random.default_rng(0).uniform(lower, upper, (500, 3))
    on = [triangles.mean(axis=1)[::40], triangles[::40, :2].mean(axis=1), part.vertices[::40]]
    return np.concatenate([anywhere, part.bounds().mean(axis=0)[None], *on])


@pytest.mark.parametrize(
    ("half_lengths", "power"),
    [
        ((0.03, 0.03, 0.03), 1.0),
        ((0.03, 0.02, 0.1), 1.0),
        ((0.001, 0.03, 0.03), 1.0),
        ((1e-3, 1e-3, 1e-3), 1.0),
        ((0.003, 0.003, 0.1), 1.0),
        ((0.05, 0.05, 0.002), 1.0),
        ((0.05, 0.04, 0.002), 0.4),  # a plate with a round rim
        ((0.002, 0.002, 0.1), 0.4),
    ],
)
def test_the_nearest_of_many_facets_is_the_one_that_all_would_name(
    half_lengths: tuple[float, float, float], power: float
) -> None:
    part = lump(3000, half_lengths, power)
    assert len(part.offsets) > MOST_ASKED
    points = near_and_far(part)
    planes = Planes(
        outward_normals=part.outward_normals,
        offsets=part.offsets,
        middles=part.vertices[[ring[0] for ring in part.polygons]],
    )
    below = planes.below(points)
    np.testing.assert_allclose(planes.depth(points), below.min(axis=1), atol=1e-14)
    length = float(norm(np.ptp(part.vertices, axis=0)))
    first = (below <= below.min(axis=1, keepdims=True) + TIE * length).argmax(axis=1)
    assert (part.nearest_facet(points) == first).all()


def test_depth_in_many_facets_keeps_its_sign_and_never_exceeds_the_distance() -> None:
    part = lump(3000, (0.03, 0.02, 0.05))
    points = near_and_far(part)
    depths, below = part.depth(points), (part.offsets - points @ part.outward_normals.T).min(axis=1)
    clear = np.abs(below) > 1e-14
    assert ((depths > 0) == (below > 0))[clear].all()
    assert (depths <= below + 1e-14).all()
    np.testing.assert_allclose(depths[below < 0], below[below < 0], atol=1e-14)
    assert (below > 0).any() and (below < 0).any()


@pytest.mark.slow
def test_feet_on_many_facets_are_where_all_facets_put_them(monkeypatch: pytest.MonkeyPatch) -> None:
    part = lump(3000, (0.03, 0.02, 0.05))
    triangles, facets = part.triangles()
    rises = np.random.default_rng(1).normal(size=(len(facets), 3)) * [1e-4, 1e-4, 1e-3]
    feet, normals = part.project(triangles.mean(axis=1) + rises, facets)
    monkeypatch.setattr("planner.objects.parts.polyhedron.MOST_ASKED", len(facets))
    monkeypatch.setattr("planner.objects.parts.planes.MOST_ASKED", len(facets))
    plain, same = part.project(triangles.mean(axis=1) + rises, facets)
    np.testing.assert_allclose(feet, plain, atol=1e-15)
    assert (normals == same).all()


def tube() -> Floats:
    """A drum of quadrangles, some cut into many, and two faces of many corners."""
    angles = np.arange(60) * np.pi / 30
    ring = np.column_stack([np.cos(angles), np.sin(angles)])
    return np.concatenate([np.column_stack([ring, np.full(60, z)]) for z in (-1, -0.3, 0.2, 1)])


@pytest.mark.parametrize("precision", [np.float32, np.float64])
def test_coplanar_triangles_found_among_neighbours_are_those_found_among_all(
    precision: type, monkeypatch: pytest.MonkeyPatch
) -> None:
    shapes = [
        tube(),
        trimesh.creation.uv_sphere(count=[20, 30]).vertices,
        np.random.default_rng(2).normal(size=(99, 3)),
    ]
    for points in (shape.astype(precision).astype(float) for shape in shapes):
        plain = hulls.convex_facets(points, "g")
        monkeypatch.setattr(hulls, "MOST_COMPARED", 0)
        fast = hulls.convex_facets(points, "g")
        monkeypatch.undo()
        assert [ring.tolist() for ring in fast.polygons] == [ring.tolist() for ring in plain.polygons]
        np.testing.assert_allclose(fast.outward_normals, plain.outward_normals, atol=1e-14)


def test_quadrangles_found_at_once_are_those_found_one_by_one(monkeypatch: pytest.MonkeyPatch) -> None:
    sphere = trimesh.creation.uv_sphere(count=[40, 60]).vertices
    shapes = [sphere * stretch for stretch in ((1, 1, 1), (3, 3, 100), (50, 50, 2), (1, 1, 3e-4))]
    monkeypatch.setattr(hulls, "MOST_COMPARED", 0)
    for points in (shape.astype(np.float32).astype(float) for shape in shapes):
        fast = hulls.convex_facets(points, "g")
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(hulls, "_quadrangles", none_of)
            plain = hulls.convex_facets(points, "g")
        assert sum(len(ring) == 4 for ring in plain.polygons) > 500
        assert [ring.tolist() for ring in fast.polygons] == [ring.tolist() for ring in plain.polygons]
        assert (fast.outward_normals == plain.outward_normals).all() and (fast.offsets == plain.offsets).all()


def none_of(_: Floats, pairs: Floats, __: Floats) -> tuple[Floats, Floats]:
    """In place of the function that finds the quadrangles: it finds none."""
    return np.zeros(len(pairs), dtype=bool), np.zeros((0, 4), dtype=int)


@pytest.mark.parametrize(
    ("second", "covered"), [(1.0, {1: 0}), (0.9, {1: 0}), (1.1, {0: 1}), (1 + 1e-7, {1: 0}), (1 + 1e-5, {0: 1})]
)
def test_of_two_balls_of_many_facets_the_one_inside_adds_nothing(second: float, covered: dict[int, int]) -> None:
    ball = lump(3000, (0.03, 0.03, 0.03), at=np.zeros(3))
    other = Polyhedron.hull(second * ball.vertices, geom="other", friction=0.5)
    assert covered_parts(rigid_object(ball, other)) == covered
    aside = Polyhedron.hull(second * ball.vertices + [1e-3, 0, 0], geom="other", friction=0.5)
    assert bool(covered_parts(rigid_object(ball, aside))) == (abs(second - 1) > 0.05)


def test_a_sphere_has_no_sharp_edges_and_half_of_it_has_a_rim() -> None:
    sphere = trimesh.creation.icosphere(subdivisions=5)
    assert len(sharp_edges(sphere.triangles)) == 0
    upper = sphere.triangles[sphere.triangles[:, :, 2].min(axis=1) > 0]
    rim = np.unique(sharp_edges(upper).reshape(-1, 3).round(9), axis=0)
    assert 2 * len(rim) == 2 * len(sharp_edges(upper)) < len(upper)  # a closed line
    assert rim[:, 2].max() < 0.1
