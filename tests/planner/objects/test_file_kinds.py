"""Files that MuJoCo compiles in its own way, or not at all, are read as their objects, or refused in one clear line."""

import os
import zipfile
from pathlib import Path

import numpy as np
import pytest
import trimesh

from planner.candidates.choice import make_candidates
from planner.candidates.confirmed import confirmed_candidates
from planner.errors import MasslessError, ObjectError
from planner.objects.given_mass import GivenMass
from planner.objects.mjcf.reader import read_object
from planner.objects.mjcf.visual import visual_difference
from planner.objects.object_source import ObjectSource
from planner.objects.rigid_object import RigidObject
from tests.strategies.mjcf_files import world, written
from tests.tools.lanes import first_fast

BOX = '<geom name="box" type="box" size=".025 .02 .03" mass=".2"/>'

GHOST = 'contype="0" conaffinity="0" group="2"'


def usable(thing: RigidObject) -> bool:
    """Whether everything that compiles the object again, to measure or to compare, still finds it."""
    visual_difference(thing)
    return len(confirmed_candidates(thing, make_candidates(thing, "20", 0.5, seed=0)).candidates) == 20


COMPILERS = {
    "discardvisual": '<compiler discardvisual="true"/>',
    "fusestatic": '<compiler fusestatic="true"/>',
    "both": '<compiler discardvisual="true" fusestatic="true"/>',
}


@pytest.mark.parametrize("compiler", COMPILERS)
@pytest.mark.parametrize("joint", first_fast(["<freejoint/>", ""]))
@pytest.mark.parametrize("first", ["seen", "solid"])
def test_what_the_compiler_may_discard_or_fuse_is_kept(tmp_path: Path, compiler: str, joint: str, first: str) -> None:
    seen = f'<geom type="box" size=".026 .021 .031" mass="0" {GHOST}/>'
    inner = '<body name="knob" pos="0 0 .03"><geom name="knob" size=".01" mass=".01"/></body>'
    geoms = seen + BOX if first == "seen" else BOX + seen
    text = world(f'<body name="part">{joint}{geoms}{inner}</body>')
    plain = read_object(written(tmp_path, text))
    thing = read_object(written(tmp_path, text.replace("<asset>", f"{COMPILERS[compiler]}<asset>"), "terse.xml"))
    assert (thing.body, thing.mass, [part.geom for part in thing.parts]) == ("part", plain.mass, ["box", "knob"])
    np.testing.assert_array_equal(thing.inertia, plain.inertia)
    assert usable(thing)


LINK = """<link name="part"><inertial><mass value="0.2"/>
  <inertia ixx="1e-4" iyy="1e-4" izz="1e-4" ixy="0" ixz="0" iyz="0"/></inertial>
  <visual><geometry><box size="0.05 0.04 0.06"/></geometry></visual>
  <collision><geometry><box size="0.05 0.04 0.06"/></geometry></collision></link>"""

KNOB = LINK.replace('"part"', '"knob"').replace('value="0.2"', 'value="0.1"')

IN_WORLD = f'<link name="world"/>{LINK}<joint name="j" type="{{}}"><parent link="world"/><child link="part"/></joint>'

URDFS = {
    "one link": LINK,
    "floating": IN_WORLD.format("floating"),
    "fixed to the world": IN_WORLD.format("fixed"),
    "two links": f'{LINK}{KNOB}<joint name="j" type="fixed"><parent link="part"/><child link="knob"/></joint>',
    "own settings": f'<mujoco><compiler discardvisual="false" fusestatic="false"/></mujoco>{LINK}',
}


@pytest.mark.parametrize("kind", URDFS)
def test_every_kind_of_root_of_a_urdf_is_a_body(tmp_path: Path, kind: str) -> None:
    thing = read_object(written(tmp_path, f'<robot name="thing">{URDFS[kind]}</robot>', "thing.urdf"))
    mass, parts = (0.3, 2) if kind == "two links" else (0.2, 1)
    assert (round(thing.mass, 9), len(thing.parts)) == (mass, parts)
    np.testing.assert_allclose(thing.extent, [0.05, 0.04, 0.06])
    assert usable(thing) or parts == 2


def test_names_that_are_not_utf8_are_read_as_latin1(tmp_path: Path) -> None:
    oil = '<body name="Ölkännchen"><joint name="Schräge"/><geom size=".1"/></body>'
    body = '<body name="Gefäß"><freejoint/><geom name="Griff-größe" size=".1"/>{}</body>'
    path = tmp_path / "latin.xml"
    path.write_bytes(world(body.format(oil)).encode("latin-1"))
    with pytest.raises(ObjectError, match=r"'Ölkännchen'.*--lock-joints 'Schräge'"):
        read_object(path)
    thing = read_object(ObjectSource(file=path, body="Ölkännchen", locked_joints=("Schräge",)))
    assert [part.geom for part in thing.parts] == ["Griff-größe", "geom1"]
    path.write_bytes(world(body.format("")).encode("latin-1"))
    assert usable(read_object(path))


def test_a_path_that_is_not_utf8_is_refused_with_the_way_out(tmp_path: Path) -> None:
    path = Path(os.fsdecode(os.fsencode(tmp_path) + b"/b\xffx.xml"))
    path.write_text(world('<body name="part"><freejoint/><geom size=".1"/></body>'))
    with pytest.raises(ObjectError, match=r"is not UTF-8.*rename the file"):
        read_object(path)


def test_an_archive_is_an_object_whose_digest_is_that_of_the_archive(tmp_path: Path) -> None:
    trimesh.creation.box([0.05, 0.04, 0.06]).export(tmp_path / "m.stl")
    text = world('<body name="part"><geom type="mesh" mesh="m" mass=".2"/></body>', '<mesh name="m" file="m.stl"/>')
    xml = written(tmp_path, text, "part.xml")
    for size in ("", ' scale="2 2 2"'):
        with zipfile.ZipFile(tmp_path / "part.mjz", "w") as archive:
            archive.writestr("part.xml", text.replace('file="m.stl"', f'file="m.stl"{size}'))
            archive.write(tmp_path / "m.stl", "m.stl")
        thing = read_object(tmp_path / "part.mjz")
        assert thing.mass == 0.2
        assert usable(thing)
        if not size:
            first = thing
    np.testing.assert_allclose(first.extent, read_object(xml).extent)
    assert first.sha256 != thing.sha256


MASSLESS = {
    "no mass": '<body name="p"><freejoint/><geom type="box" size=".02 .02 .02" pos=".1 0 0" mass="0"/></body>',
    "no density": '<body name="p"><freejoint/><geom type="box" size=".02 .02 .02" pos=".1 0 0" density="0"/></body>',
    "no joint": '<body name="p"><geom type="box" size=".02 .02 .02" pos=".1 0 0" mass="0"/></body>',
    "stated": '<body name="p"><freejoint/><inertial pos="0 0 0" mass="0" diaginertia="0 0 0"/>'
    '<geom type="box" size=".02 .02 .02" pos=".1 0 0"/></body>',
    "wrapped": '<body name="p"><freejoint/><body><geom type="box" size=".02 .02 .02" pos=".1 0 0" mass="0"/></body>'
    "</body>",
    "seen too": '<body name="p"><freejoint/><geom type="box" size=".02 .02 .02" pos=".1 0 0" mass="0"/>'
    f'<geom size=".5" mass="0" {GHOST}/></body>',
}


@pytest.mark.parametrize("kind", MASSLESS)
def test_an_object_without_mass_is_weighed_by_its_shape_when_its_mass_is_given(tmp_path: Path, kind: str) -> None:
    """A cube of edge 40 mm and 0.2 kg: m a^2 / 6 about its centre."""
    path = written(tmp_path, world(MASSLESS[kind]))
    thing = read_object(ObjectSource(file=path, given=GivenMass(mass=0.2)))
    assert thing.mass == 0.2
    np.testing.assert_allclose(thing.center_of_mass, [0.1, 0, 0], atol=1e-12)
    np.testing.assert_allclose(thing.inertia, 0.2 * 0.04**2 / 6 * np.eye(3), atol=1e-12)
    assert usable(thing)
    if kind == "no joint":
        assert read_object(path).mass == 0
    else:
        with pytest.raises(MasslessError, match="--mass"):
            read_object(path)


def test_a_given_mass_leaves_the_masses_of_the_file_in_proportion(tmp_path: Path) -> None:
    """Only an object without any mass is weighed by its shape: this handle stays without."""
    handle = '<body pos=".1 0 0"><geom size=".02" mass="0"/></body>'
    path = written(tmp_path, world(f'<body><freejoint/><geom size=".02" mass="3"/>{handle}</body>'))
    thing = read_object(ObjectSource(file=path, given=GivenMass(mass=6.0)))
    np.testing.assert_array_equal(thing.center_of_mass, 0)


SHEET = "-.02 -.015 0  .02 -.015 0  .02 .015 0  -.02 .015 0"

LOOKS = {
    "flat": f'<mesh name="look" vertex="{SHEET}" face="0 1 2 0 2 3"/>',
    "a line": '<mesh name="look" vertex="0 0 0 1 0 0 2 0 0 3 0 0" face="0 1 2 1 2 3"/>',
    "a point": '<mesh name="look" vertex="0 0 0 0 0 0 0 0 0 0 0 0" face="0 1 2 1 2 3"/>',
    "not there": '<mesh name="look" file="gone.obj"/>',
    "not there, in a folder": '<mesh name="look" file="away/gone.stl"/>',
    "empty": '<mesh name="look" file="empty.obj"/>',
    "broken": '<mesh name="look" file="broken.stl"/>',
}


@pytest.mark.parametrize("look", LOOKS)
@pytest.mark.parametrize("joint", first_fast(["<freejoint/>", ""]))
def test_a_mesh_that_is_only_seen_is_planned_without_and_warned_of(
    tmp_path: Path, look: str, joint: str, caplog: pytest.LogCaptureFixture
) -> None:
    (tmp_path / "empty.obj").write_text("")
    (tmp_path / "broken.stl").write_bytes(b"solid nothing")
    seen = f'<geom type="mesh" mesh="look" mass="0" {GHOST}/>'
    thing = read_object(written(tmp_path, world(f"<body>{joint}{seen}{BOX}</body>", LOOKS[look])))
    assert (thing.mass, [part.geom for part in thing.parts]) == (0.2, ["box"])
    assert [message for message in caplog.messages if "planned without mesh 'look', which is only seen" in message]
    assert len(caplog.messages) == 1
    assert usable(thing)
    unused = read_object(written(tmp_path, world(f"<body>{joint}{BOX}</body>", LOOKS[look])))
    assert unused.mass == 0.2


@pytest.mark.parametrize("look", LOOKS)
def test_a_mesh_that_collides_is_never_left_out(tmp_path: Path, look: str) -> None:
    (tmp_path / "empty.obj").write_text("")
    (tmp_path / "broken.stl").write_bytes(b"solid nothing")
    for geom in (
        '<geom type="mesh" mesh="look" mass="0"/>',
        f'<geom type="mesh" mesh="look" mass="0"/><geom type="mesh" mesh="look" mass="0" {GHOST}/>',
    ):
        advice = {"flat": "thin box", "a line": "thin capsule", "a point": "small sphere"}.get(look, "cannot compile")
        with pytest.raises(ObjectError, match=advice):
            read_object(written(tmp_path, world(f"<body><freejoint/>{geom}{BOX}</body>", LOOKS[look])))


def test_a_mesh_that_is_left_out_keeps_the_mass_it_states(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    seen = f'<geom type="mesh" mesh="look" pos="0 0 .02" {{}} {GHOST}/>'
    stated, unstated = (
        read_object(written(tmp_path, world(f"<body><freejoint/>{seen.format(mass)}{BOX}</body>", LOOKS["not there"])))
        for mass in ('mass=".2"', "")
    )
    assert (stated.mass, unstated.mass) == (0.4, 0.2)
    np.testing.assert_allclose(stated.center_of_mass, [0, 0, 0.01])
    assert ["not counted" in message for message in caplog.messages] == [False, True]


def test_several_looks_and_textures_are_left_out_together(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    meshes = "".join(f'<mesh name="m{number}" file="gone{number}.obj"/>' for number in range(5))
    looks = "".join(f'<geom type="mesh" mesh="m{number}" mass="0" material="paint" {GHOST}/>' for number in range(5))
    paint = '<texture name="t" type="2d" file="gone.png"/><material name="paint" texture="t"/>'
    thing = read_object(written(tmp_path, world(f"<body><freejoint/>{looks}{BOX}</body>", meshes + paint)))
    assert thing.mass == 0.2
    assert len(caplog.messages) == 6


PAIRED = f'<geom name="pad" size=".02" {GHOST}/>'


def test_geoms_that_only_collide_in_pairs_collide(tmp_path: Path) -> None:
    def read(pair: str, geoms: str = PAIRED + BOX) -> RigidObject:
        table = '<geom name="table" type="plane" size="1 1 1"/>'
        body = f'<body name="part"><freejoint/>{geoms}<geom name="seen" size=".1" {GHOST}/></body>'
        text = world(table + body).replace("</mujoco>", f"<contact>{pair}</contact></mujoco>")
        return read_object(written(tmp_path, text))

    pair = '<pair geom1="table" geom2="pad"/>'
    assert [part.geom for part in read("").parts] == ["box"]
    assert [part.geom for part in read(pair).parts] == ["pad", "box"]
    assert [part.geom for part in read('<pair geom1="pad" geom2="table"/>').parts] == ["pad", "box"]
    alone = read(pair, PAIRED)
    assert [part.geom for part in alone.parts] == ["pad"]
    assert usable(alone)


@pytest.mark.parametrize("name", ["box.obj", "box.STL", "my box & co.msh", "box.ply", "box.glb"])
def test_a_mesh_in_place_of_an_object_is_told_which_mjcf_to_write(tmp_path: Path, name: str) -> None:
    path = tmp_path / name
    trimesh.creation.box([0.05, 0.04, 0.06]).export(tmp_path / "box.stl")
    path.write_bytes((tmp_path / "box.stl").read_bytes())
    with pytest.raises(ObjectError, match=r"MJCF|<mujoco>") as refused:
        read_object(path)
    if name == "box.STL":
        words = str(refused.value)
        text = words[words.index("<mujoco>") : words.index("</mujoco>") + len("</mujoco>")]
        thing = read_object(written(tmp_path, text, "box.xml"))
        np.testing.assert_allclose(thing.extent, [0.05, 0.04, 0.06], rtol=1e-6)


@pytest.mark.parametrize("name", ["none.obj", "x" * 300 + ".stl"])
def test_a_mesh_that_is_not_there_is_said_not_to_be_there(tmp_path: Path, name: str) -> None:
    with pytest.raises(ObjectError, match="cannot be read"):
        read_object(tmp_path / name)


@pytest.mark.parametrize(("condim", "torsion"), [(1, 0.0), (3, 0.0), (4, 0.3), (6, 0.3)])
def test_torsional_friction_is_that_of_the_file_where_its_contacts_have_any(
    tmp_path: Path, condim: int, torsion: float
) -> None:
    """And that of the smaller geom where two share the surface."""
    geom = BOX.replace("/>", f' condim="{condim}" friction=".9 .3 .1"/>')
    hard = BOX.replace("box", "twin", 1).replace("/>", ' condim="3" friction=".9 .3 .1"/>')
    alone = read_object(written(tmp_path, world(f"<body><freejoint/>{geom}</body>")))
    assert alone.torsions == pytest.approx([torsion])
    assert make_candidates(alone, "20").contacts.torsions == pytest.approx(np.full(20, torsion))
    assert make_candidates(alone, "20", friction=0.4).contacts.torsions == pytest.approx(np.full(20, torsion))
    twins = read_object(written(tmp_path, world(f"<body><freejoint/>{geom}{hard}</body>")))
    assert twins.torsions == pytest.approx([torsion, 0])
    assert not make_candidates(twins, "20").contacts.torsions.any()
