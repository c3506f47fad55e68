"""Random assemblies of parts that coincide, are coplanar, or nearly so: what MJCF files of real objects are full of."""

from pathlib import Path

import numpy as np
from numpy.random import Generator

from planner.arrays import Floats

OFFSETS = (0.0, 0.0, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3)
"""How far two surfaces that should be one are apart [m]: on the object's sizes, both sides of every tolerance."""

SIZE = np.array([0.03, 0.02, 0.04])
"""Half lengths of the first part, roughly [m]."""


def random_assembly(folder: Path, seed: int) -> Path:
    """An object of a random kind of two to four parts, written to a file of the folder."""
    generator = np.random.default_rng(seed)
    kind = KINDS[seed % len(KINDS)]
    assets, geoms = kind(generator, SIZE * generator.uniform(0.5, 1.5, 3))
    pose = f'pos="{_words(generator.normal(size=3) / 10)}" quat="{_words(generator.normal(size=4))}"'
    path = folder / f"{kind.__name__.strip('_')}_{seed}.xml"
    path.write_text(
        f"<mujoco><asset>{assets}</asset><worldbody><body name='thing' {pose}><freejoint/>{geoms}</body></worldbody>"
        "</mujoco>"
    )
    return path


def _offset(generator: Generator) -> float:
    return float(generator.choice(OFFSETS) * generator.choice([-1, 1]))


def _twins(generator: Generator, half: Floats) -> tuple[str, str]:
    """One primitive twice, one of them larger or smaller by an offset."""
    kind = str(generator.choice(["box", "cylinder", "capsule", "ellipsoid", "sphere"]))
    return "", _geom(kind, half) + _geom(kind, half + _offset(generator), friction=0.6)


def _mesh_and_primitive(generator: Generator, half: Floats) -> tuple[str, str]:
    """A box, and a mesh with its corners, larger or smaller by an offset."""
    return _mesh("m", _corners(half + _offset(generator))), _geom("box", half) + _mesh_geom("m")


def _round_mesh_and_primitive(generator: Generator, half: Floats) -> tuple[str, str]:
    """A cylinder, and the prism that is drawn for it."""
    count, radius = int(generator.integers(6, 40)), half[0] * generator.choice([1, 1 / np.cos(np.pi / 24)])
    angles = np.arange(count) * 2 * np.pi / count
    ring = radius * np.column_stack([np.cos(angles), np.sin(angles)])
    prism = np.vstack([np.column_stack([ring, np.full(count, z)]) for z in (-half[2], half[2])])
    return _mesh("m", prism), _geom("cylinder", half) + _mesh_geom("m")


def _mesh_twice(generator: Generator, half: Floats) -> tuple[str, str]:
    """A random hull twice, the second scaled by a little."""
    points = generator.normal(size=(30, 3)) * half
    scale = 1 + float(generator.choice([0, 0, 1e-7, 1e-6, 1e-5, 1e-3]))
    return _mesh("m", points) + _mesh("n", points * scale), _mesh_geom("m") + _mesh_geom("n")


def _overlapping(generator: Generator, half: Floats) -> tuple[str, str]:
    """Boxes that overlap, with faces in one plane."""
    moved, other = half * generator.uniform(-1, 1, 3) * [1, 1, 0], half * generator.uniform(0.3, 1.2, 3)
    other[2] = half[2] + _offset(generator)
    return "", _geom("box", half) + _geom("box", other, moved, friction=0.4)


def _side_by_side(generator: Generator, half: Floats) -> tuple[str, str]:
    """Boxes that share a face, their outer faces in one plane or nearly."""
    step = np.array([2 * half[0] + _offset(generator), _offset(generator), _offset(generator)])
    return "", "".join(_geom("box", half, place * step) for place in range(int(generator.integers(2, 5))))


def _joined(generator: Generator, half: Floats) -> tuple[str, str]:
    """T and L of coplanar boxes."""
    thin = half * [0.2, 1, 1]
    place = np.array([half[0] * generator.choice([-0.8, 0.0, 0.8]), _offset(generator), half[2]])
    return "", _geom("box", half * [1, 1, 0.2]) + _geom("box", thin + np.array([0, _offset(generator), 0]), place)


def _inlaid(generator: Generator, half: Floats) -> tuple[str, str]:
    """A cylinder let into the top of a box."""
    plug = np.array([half[:2].min() * generator.uniform(0.2, 1), 0, half[2] * generator.uniform(0.1, 1)])
    return "", _geom("box", half) + _geom("cylinder", plug, np.array([0, 0, half[2] - plug[2] + _offset(generator)]))


def _rod(generator: Generator, half: Floats) -> tuple[str, str]:
    """A capsule and the cylinder between its caps, and another cylinder that goes on from there."""
    shared = half + np.array([_offset(generator), 0, 0])
    rest = _geom("cylinder", shared * [1, 1, 0.5], np.array([0, 0, 1.5 * half[2]]))
    return "", _geom("capsule", half) + _geom("cylinder", shared) + rest


def _pieces(generator: Generator, half: Floats) -> tuple[str, str]:
    """A box cut by oblique planes into touching hulls."""
    tilt = generator.uniform(-0.5, 0.5, 2)
    corners = _corners(half)
    cut = np.column_stack([corners[[0, 2, 4, 6], :2], corners[[0, 2, 4, 6], :2] @ tilt * 0.5])
    lower, upper = corners[corners[:, 2] < 0], corners[corners[:, 2] > 0]
    assets = _mesh("low", np.vstack([lower, cut])) + _mesh(
        "high", np.vstack([upper, cut + np.array([0, 0, _offset(generator)])])
    )
    return assets, _mesh_geom("low") + _mesh_geom("high")


KINDS = (
    _twins,
    _mesh_and_primitive,
    _round_mesh_and_primitive,
    _mesh_twice,
    _overlapping,
    _side_by_side,
    _joined,
    _inlaid,
    _rod,
    _pieces,
)


def _corners(half: Floats) -> Floats:
    return half * np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])


def _geom(kind: str, half: Floats, position: Floats | None = None, friction: float = 1.0) -> str:
    size = {"cylinder": half[[0, 2]], "capsule": half[[0, 2]], "sphere": half[:1]}.get(kind, half)
    place = np.zeros(3) if position is None else position
    return f'<geom type="{kind}" size="{_words(size)}" pos="{_words(place)}" mass="0.1" friction="{friction}"/>'


def _mesh(name: str, vertices: Floats) -> str:
    return f'<mesh name="{name}" vertex="{_words(vertices.ravel())}" inertia="convex"/>'


def _mesh_geom(name: str) -> str:
    return f'<geom type="mesh" mesh="{name}" mass="0.1"/>'


def _words(numbers: Floats) -> str:
    return " ".join(repr(float(number)) for number in numbers)
