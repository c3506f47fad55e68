"""Reading an object gives what MuJoCo collides and weighs, or a clear refusal."""

import logging
import re
import shutil
from pathlib import Path

import mujoco
import numpy as np
import pytest

from planner.errors import ObjectError
from planner.objects.mjcf.reader import read_object
from planner.objects.object_source import ObjectSource
from planner.objects.parts.box import Box
from planner.objects.parts.capsule import Capsule
from planner.objects.parts.cylinder import Cylinder
from planner.objects.parts.ellipsoid import Ellipsoid
from planner.objects.parts.polyhedron import Polyhedron
from planner.objects.parts.sphere import Sphere
from tests.strategies.mjcf_files import (
    EVERY_SHAPE,
    SHARED_OBJECTS,
    TETRAHEDRON,
    shared_object,
    world,
    written,
)
from tests.tools.lanes import first_fast


def compiled(path: Path) -> tuple[mujoco.MjModel, mujoco.MjData]:
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


def test_parts_lie_where_the_simulator_puts_their_geoms(tmp_path: Path) -> None:
    path = written(tmp_path, EVERY_SHAPE)
    model, data = compiled(path)
    rotation, origin = data.xmat[1].reshape(3, 3), data.xpos[1]
    parts = {part.geom: part for part in read_object(path).parts}
    assert list(parts) == ["mesh", "box", "sphere", "ellipsoid", "geom6", "capsule"]
    for name, part in parts.items():
        geom = 6 if name == "geom6" else model.geom(name).id
        position = (data.geom_xpos[geom] - origin) @ rotation
        orientation = rotation.T @ data.geom_xmat[geom].reshape(3, 3)
        if isinstance(part, Polyhedron) and not isinstance(part, Box):
            vertices = np.asarray(model.mesh_vert @ orientation.T + position)
            np.testing.assert_allclose(np.sort(vertices, axis=0), np.sort(part.vertices, axis=0), atol=1e-9)
        else:
            assert isinstance(part, Box | Sphere | Ellipsoid | Cylinder | Capsule)
            np.testing.assert_allclose(part.pose.position, position, atol=1e-14)
            np.testing.assert_allclose(part.pose.rotation, orientation, atol=1e-14)
            np.testing.assert_allclose(part.size, model.geom_size[geom][: len(part.size)])
        assert part.friction == (0.2 if name == "mesh" else 1.0)


def test_mass_properties_equal_those_of_the_simulated_free_body(tmp_path: Path) -> None:
    path = written(tmp_path, EVERY_SHAPE)
    model, data = compiled(path)
    thing = read_object(path)
    rotation, origin = data.xmat[1].reshape(3, 3), data.xpos[1]
    # momentum of unit velocities of the free joint: columns of its mass matrix, moments about B's origin
    inertia = np.empty((6, 6))
    for axis in range(6):
        mujoco.mj_mulM(model, data, inertia[axis], np.eye(6)[axis])
    arm = rotation @ thing.center_of_mass
    np.testing.assert_allclose(data.subtree_com[1], origin + arm, atol=1e-14)
    np.testing.assert_allclose(inertia[0, 0], thing.mass, rtol=1e-12)
    about_origin = thing.inertia + thing.mass * (
        thing.center_of_mass @ thing.center_of_mass * np.eye(3) - np.outer(thing.center_of_mass, thing.center_of_mass)
    )
    np.testing.assert_allclose(inertia[3:, 3:], about_origin, rtol=1e-10, atol=1e-12)


@pytest.mark.parametrize("name", first_fast(SHARED_OBJECTS, fast=2))
def test_shared_objects_are_read_whole(name: str) -> None:
    path = shared_object(name)
    body, parts = SHARED_OBJECTS[name]
    thing = read_object(path)
    model, _ = compiled(path)
    assert (thing.body, len(thing.parts)) == (body, parts)
    assert thing.mass == pytest.approx(model.body_mass.sum(), rel=1e-12)
    assert 0.01 < thing.size < 0.5


def test_a_reduced_hull_keeps_the_vertices_mujoco_keeps(tmp_path: Path) -> None:
    ball = '<mesh name="ball" builtin="sphere" params="3" maxhullvert="{}"/>'
    body = '<body><geom type="mesh" mesh="ball"/></body>'
    full, reduced = (read_object(written(tmp_path, world(body, ball.format(n)))).parts[0] for n in (-1, 12))
    assert isinstance(full, Polyhedron)
    assert isinstance(reduced, Polyhedron)
    assert len(full.vertices) > 600
    assert 8 <= len(reduced.vertices) <= 12


GEOM = '<geom size=".1"/>'


@pytest.mark.parametrize(
    ("bodies", "asked", "chosen"),
    [
        (f'<body name="a">{GEOM}</body>', None, "a"),
        (f"<body><body name='inner'>{GEOM}</body></body>", None, "body1"),
        (f"<body><body name='inner'>{GEOM}</body></body>", "inner", "inner"),
        (f'<body name="a">{GEOM}</body><body name="b">{GEOM}</body>', "b", "b"),
        (f'<body name="table">{GEOM}</body><body name="b"><freejoint/>{GEOM}</body>', None, "b"),
        (f'<body name="eye"><camera/></body><body name="b">{GEOM}</body>', None, "b"),
        (f"<body><body name='x'><joint type='slide'/><joint/>{GEOM}</body></body>", None, "body1"),
    ],
)
def test_the_object_is_the_body_asked_for_or_the_only_one(
    tmp_path: Path, bodies: str, asked: str | None, chosen: str
) -> None:
    assert read_object(ObjectSource(file=written(tmp_path, world(bodies)), body=asked)).body == chosen


FLEX = (
    '<flexcomp name="f" type="grid" count="3 3 1" spacing=".1 .1 .1" radius=".01" dim="2">'
    '<elasticity young="1e4"/></flexcomp>'
)
TORUS = '<plugin instance="torus"/>'


@pytest.mark.parametrize(
    ("text", "body", "message"),
    [
        ("<mujoco><worldbody><bod/></worldbody></mujoco>", None, "(?s)cannot compile.*unrecognized element"),
        (world(f'<body name="a">{GEOM}</body>'), "b", "no body named 'b'.*'a'"),
        (world(f'<body name="a">{GEOM}</body>'), "world", "no body named 'world'"),
        (world(f'<body name="a">{GEOM}</body><body name="b">{GEOM}</body>'), None, "several objects.*'a', 'b'.*--body"),
        (world(GEOM), None, "wrap them in a <body>"),
        (world('<geom type="plane" size="1 1 1"/>'), None, "no body of the file collides"),
        (world('<body name="a"><geom size="1" contype="0" conaffinity="0"/></body>'), None, "no body of the file"),
        (world('<body name="a"><geom size="1" contype="0" conaffinity="0"/></body>'), "a", "'a' collides"),
        (world(f'<body>{GEOM}<geom name="p" type="plane" size="1 1 1"/></body>'), None, "'p' is a plane"),
        (
            world(
                '<body><geom name="h" type="hfield" hfield="h"/></body>',
                '<hfield name="h" nrow="2" ncol="2" size="1 1 1 1" elevation="0 1 1 0"/>',
            ),
            None,
            "'h' is a hfield",
        ),
        (
            world(f'<body name="l">{GEOM}<body name="lid"><joint/>{GEOM}</body></body>'),
            None,
            "'l' is articulated.*'lid'",
        ),
        (world('<body><geom name="g" size="inf"/></body>'), None, "'g' has a size.*not finite"),
        (world("<body><geom type='mesh' mesh='m'/></body>", '<mesh name="m" file="gone.obj"/>'), None, "gone.obj"),
        (
            world("<body><geom type='mesh' mesh='m'/></body>", '<mesh name="m" vertex="0 0 0 1 0 0 0 1 0 1 1 0"/>'),
            None,
            "coplanar",
        ),
        (
            world("<body><geom type='mesh' mesh='m'/></body>", '<mesh name="m" vertex="0 0 0 1 0 0 0 1 0 0 0 1e-6"/>'),
            None,
            "'geom0' is flat",
        ),
        (world(f'<body name="soft">{FLEX}</body>'), None, "flex"),
        (world(f'<body name="soft">{GEOM}{FLEX}</body>'), None, "flexible|articulated"),
        (
            "<mujoco><extension><plugin plugin='mujoco.sdf.torus'><instance name='torus'/></plugin></extension><asset>"
            f"<mesh name='t'>{TORUS}</mesh></asset><worldbody><body>"
            f"<geom name='s' type='sdf' mesh='t'>{TORUS}</geom></body></worldbody></mujoco>",
            None,
            "'s' is a sdf",
        ),
    ],
)
def test_what_is_no_single_rigid_object_is_refused(tmp_path: Path, text: str, body: str | None, message: str) -> None:
    with pytest.raises(ObjectError, match=message):
        read_object(ObjectSource(file=written(tmp_path, text), body=body))


def test_a_missing_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ObjectError, match="No such file or directory; give the path of an MJCF object"):
        read_object(tmp_path / "none.xml")


TEXTURED = world(
    '<body><geom size=".1" material="m"/><site material="m"/></body>',
    '<texture name="t" type="2d" file="gone.png"/><material name="m" texture="t"/>',
)


def test_a_missing_texture_is_only_warned_of(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    thing = read_object(written(tmp_path, TEXTURED))
    assert thing.mass == pytest.approx(1000 * 4 / 3 * np.pi * 0.1**3)
    assert "gone.png" in caplog.text


def test_a_missing_mesh_that_collides_is_refused_even_beside_a_missing_texture(tmp_path: Path) -> None:
    text = TEXTURED.replace("<asset>", '<asset><mesh file="away.obj"/>')
    text = text.replace("<body>", '<body><geom type="mesh" mesh="away"/>')
    with pytest.raises(ObjectError, match=r"gone\.png|away\.obj"):
        read_object(written(tmp_path, text))


HOLLOW = (
    '<mesh name="corner" vertex="0 0 0 2 0 0 2 .1 0 .1 .1 0 .1 2 0 0 2 0'
    ' 0 0 1 2 0 1 2 .1 1 .1 .1 1 .1 2 1 0 2 1" face="0 3 1 1 3 2 0 5 3 3 5 4'
    " 6 7 9 7 8 9 6 9 11 9 10 11 0 1 7 0 7 6 1 2 8 1 8 7 2 3 9 2 9 8"
    ' 3 4 10 3 10 9 4 5 11 4 11 10 5 0 6 5 6 11"/>'
)


@pytest.mark.parametrize(
    ("text", "warning"),
    [
        (world('<body><geom size=".1" mass="0"/></body>'), "no mass"),
        (world('<body><inertial pos="0 0 0" mass=".01" diaginertia="1 1 1"/><geom size=".01"/></body>'), "placeholder"),
        (world('<body><geom type="mesh" mesh="corner"/></body>', HOLLOW), "convex hull, 8[0-9] % of which"),
    ],
)
def test_doubtful_objects_are_read_with_a_warning(
    tmp_path: Path, text: str, warning: str, caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level(logging.WARNING):
        read_object(written(tmp_path, text))
    assert len(caplog.messages) == 1
    assert re.search(warning, caplog.messages[0])


def test_a_sound_object_is_read_without_warning(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    read_object(written(tmp_path, EVERY_SHAPE))
    assert not caplog.messages


def test_the_digest_follows_the_contents_and_not_the_place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    here, there = tmp_path / "here", tmp_path / "deep" / "there"
    (here / "parts").mkdir(parents=True)
    text = world('<body><geom type="mesh" mesh="m"/></body>', '<include file="parts/mesh.xml"/>')
    written(here, text)
    written(here / "parts", f"<mujocoinclude>{TETRAHEDRON.replace('tetrahedron', 'm')}</mujocoinclude>", "mesh.xml")
    shutil.copytree(here, there)
    before = read_object(here / "object.xml").sha256
    monkeypatch.chdir(there)
    assert read_object(Path("object.xml")).sha256 == before
    included = there / "parts" / "mesh.xml"
    included.write_text(included.read_text().replace('scale="2 1 1"', 'scale="2 1 2"'))
    assert read_object(there / "object.xml").sha256 != before
