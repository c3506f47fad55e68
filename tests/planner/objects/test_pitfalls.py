"""What real object files do to a loader, one test per pitfall, each with a small file made here.

Refusals (articulated, flexible, signed distance fields, geoms in the world) and placeholder inertias are in
`test_mjcf.py`; shared objects, where they are present, are read in the same file.
"""

from pathlib import Path

import numpy as np
import pytest
import trimesh

from planner.arrays import Floats, Mask
from planner.candidates.choice import make_candidates
from planner.errors import ObjectError
from planner.objects.mass_doubts import mass_doubts, union_volume
from planner.objects.mjcf.compiled import compile_mjcf
from planner.objects.mjcf.reader import read_object
from planner.objects.mjcf.visual import visual_difference
from planner.objects.rigid_object import RigidObject
from tests.strategies.cups import HALF, WALL, box_cup, cup_mesh, mesh_cup
from tests.strategies.mjcf_files import world, written

WEDGE = "0 0 0  4 0 0  0 2 0  4 2 0  0 0 1  0 2 1"
"""A ramp of 4 x 2 x 1: its centre of mass is not in its middle, so MuJoCo recentres and turns it."""

AXES = ("1 0 0", "0 1 0", "0 0 1")

RAMP = np.array(WEDGE.split(), dtype=float).reshape(-1, 3)


def read(folder: Path, body: str, assets: str = "") -> RigidObject:
    return read_object(written(folder, world(body, assets)))


def corners(thing: RigidObject) -> Floats:
    """Lower and upper corner of everything that collides, shape (2, 3) [m]."""
    bounds = np.array([part.bounds() for part in thing.parts])
    return np.stack([bounds[:, 0].min(axis=0), bounds[:, 1].max(axis=0)])


def test_meshes_that_mujoco_recentres_lie_where_the_file_puts_them(tmp_path: Path) -> None:
    thing = read(
        tmp_path, '<body><geom type="mesh" mesh="m" pos="5 6 7"/></body>', f'<mesh name="m" vertex="{WEDGE}"/>'
    )
    model, _ = compile_mjcf(thing.file)
    assert np.abs(model.geom_pos[0] - [5, 6, 7]).max() > 0.4
    np.testing.assert_allclose(corners(thing) - [5, 6, 7], [[0, 0, 0], [4, 2, 1]], atol=1e-6)


def test_scale_angles_defaults_and_mesh_folders_are_those_of_the_compiler(tmp_path: Path) -> None:
    (tmp_path / "shapes").mkdir()
    trimesh.convex.convex_hull(RAMP).export(tmp_path / "shapes" / "ramp.stl")
    text = """<mujoco><compiler angle="radian" meshdir="shapes"/>
      <default><default class="solid"><geom type="mesh" mesh="ramp" friction=".3"/></default></default>
      <asset><mesh name="ramp" file="ramp.stl" scale=".01 .02 .03"/></asset>
      <worldbody><body childclass="solid"><geom euler="0 0 1.5707963267948966"/></body></worldbody></mujoco>"""
    thing = read_object(written(tmp_path, text))
    np.testing.assert_allclose(corners(thing), [[-0.04, 0, 0], [0, 0.04, 0.03]], atol=1e-7)
    assert thing.parts[0].friction == 0.3


def test_a_mirrored_mesh_keeps_its_normals_inward(tmp_path: Path) -> None:
    mesh = f'<mesh name="m" scale="-.01 .01 .01" vertex="{WEDGE}"/>'
    thing = read(tmp_path, '<body><geom type="mesh" mesh="m"/></body>', mesh)
    np.testing.assert_allclose(corners(thing), [[-0.04, 0, 0], [0, 0.02, 0.01]], atol=1e-8)
    contacts = make_candidates(thing, "50", None, seed=0).contacts
    assert (thing.parts[0].depth(contacts.points - 1e-4 * contacts.normals) < 0).all()


def test_what_collides_is_told_by_the_contact_test_and_not_by_name_or_group(tmp_path: Path) -> None:
    geoms = (
        '<geom name="visual" group="1" size=".01"/><geom name="collision" group="3" size=".5" contype="0"'
        ' conaffinity="0"/><geom name="one_sided" size=".02" contype="0" conaffinity="4" group="4"/>'
    )
    thing = read(tmp_path, f"<body>{geoms}</body>")
    assert [part.geom for part in thing.parts] == ["visual", "one_sided"]


def in_the_hollow(points: Floats) -> Mask:
    """Which points lie on the inner surface of the cup."""
    inner = HALF - WALL + 1e-6
    return (np.abs(points[:, :2]) < inner).all(axis=1) & (points[:, 2] > WALL - HALF - 1e-6)


def test_a_mesh_collides_as_its_hull_and_its_hollow_holds_no_candidate(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    filled, hollow = (read_object(make(tmp_path)) for make in (mesh_cup, box_cup))
    assert "collides as its convex hull" in caplog.text
    on_top = np.array([[0.0, 0.0, HALF]])
    assert filled.parts[0].depth(on_top - [0, 0, 1e-3])[0] > 0
    points = [make_candidates(thing, "200", None, seed=0).contacts.points for thing in (filled, hollow)]
    below_the_lid = [cloud[cloud[:, 2] < HALF - 1e-6] for cloud in points]
    assert [bool(in_the_hollow(cloud).any()) for cloud in below_the_lid] == [False, True]


def test_visual_and_collision_shapes_that_differ_are_compared(tmp_path: Path) -> None:
    """The visual cup is the colliding boxes, but for a shift of 3 mm along x."""
    cup_mesh().export(tmp_path / "cup.stl")
    boxes = box_cup(tmp_path).read_text()
    seen = '<geom type="mesh" mesh="cup" contype="0" conaffinity="0" pos="{} 0 0"/></body>'
    text = boxes.replace("<asset>", '<asset><mesh name="cup" file="cup.stl"/>')
    same, shifted = (
        visual_difference(read_object(written(tmp_path, text.replace("</body>", seen.format(shift)))))
        for shift in (0.0, 0.003)
    )
    assert same is not None
    assert shifted is not None
    assert same.typical < 1e-6 * same.size
    assert same.largest < 1e-2 * same.size
    assert shifted.typical == pytest.approx(0.003, rel=0.1)
    assert shifted.largest < 0.0035
    filled = visual_difference(read_object(mesh_cup(tmp_path)))
    assert filled is not None
    assert filled.large  # the middle of its bottom is as far from the hull's walls as from its lid
    assert filled.largest == pytest.approx(WALL, rel=0.2)


def test_overlapping_parts_have_no_candidates_inside_each_other(tmp_path: Path) -> None:
    thing = read_object(box_cup(tmp_path))
    points = make_candidates(thing, "300", None, seed=0).contacts.points
    depths = np.array([part.depth(points) for part in thing.parts])
    assert depths.max() < 1e-9
    mesh = cup_mesh()
    distances = trimesh.triangles.closest_point(
        np.repeat(mesh.triangles, len(points), axis=0), np.tile(points, (len(mesh.faces), 1))
    ).reshape(len(mesh.faces), -1, 3)
    assert np.linalg.norm(distances - points, axis=2).min(axis=0).max() < 1e-7
    assert union_volume(thing) == pytest.approx(mesh.volume, rel=0.05)


@pytest.mark.parametrize("damage", ["open", "soup"])
def test_dirty_meshes_are_read_as_their_hull(tmp_path: Path, damage: str) -> None:
    """A scan that is not watertight, and one whose triangles share no vertex."""
    ball = trimesh.creation.icosphere(subdivisions=2, radius=0.05)
    triangles = ball.triangles[1:] if damage == "open" else ball.triangles
    faces = np.arange(3 * len(triangles)).reshape(-1, 3)
    dirty = trimesh.Trimesh(triangles.reshape(-1, 3), faces, process=False)
    assert not dirty.is_watertight
    dirty.export(tmp_path / "scan.obj")
    thing = read(
        tmp_path,
        '<body><geom type="mesh" mesh="scan"/></body>',
        '<mesh name="scan" file="scan.obj" inertia="shell"/>',
    )
    (part,) = thing.parts
    assert len(part.triangles()[0]) == len(ball.faces)
    np.testing.assert_allclose(corners(thing), ball.bounds, atol=1e-8)


def test_an_object_without_any_mesh_is_an_object(tmp_path: Path) -> None:
    thing = read(
        tmp_path, '<body><geom type="capsule" size=".01 .03"/><geom type="ellipsoid" size=".02 .03 .01"/></body>'
    )
    assert len(thing.parts) == 2
    assert visual_difference(thing) is None
    assert len(make_candidates(thing, "40", None, seed=0)) == 40


@pytest.mark.parametrize("length", [0.001, 10.0])
def test_candidates_of_small_and_large_objects_are_alike_up_to_scale(tmp_path: Path, length: float) -> None:
    def points(scale: float) -> Floats:
        box, stem = f"{scale} {2 * scale} {scale}", f"{scale / 2} {scale}"
        body = f'<body><geom type="box" size="{box}"/><geom type="cylinder" size="{stem}" pos="0 0 {scale}"/></body>'
        return make_candidates(read(tmp_path, body), "60", None, seed=0).contacts.points / scale

    np.testing.assert_allclose(points(length), points(0.1), atol=1e-8)


JOINTS = {
    "free": "<freejoint/>",
    "none": "",
    "six scalar": "".join(f'<joint type="{kind}" axis="{axis}"/>' for kind in ("slide", "hinge") for axis in AXES),
    "two slides": "".join(f'<joint type="slide" axis="{axis}"/>' for axis in AXES[:2]),
}


@pytest.mark.parametrize("joints", JOINTS)
@pytest.mark.parametrize("wrapped", [False, True])
def test_whatever_joints_move_the_object_it_is_the_same_object(tmp_path: Path, joints: str, wrapped: bool) -> None:
    solid = '<geom type="box" size=".01 .02 .03" pos=".1 0 0"/>'
    inside = f"<body>{solid}</body>" if wrapped else solid
    thing = read(tmp_path, f'<body name="thing" pos="1 2 3">{JOINTS[joints]}{inside}</body>')
    assert thing.body == "thing"
    np.testing.assert_allclose(thing.center_of_mass, [0.1, 0, 0], atol=1e-15)
    assert thing.mass == pytest.approx(1000 * 8 * 0.01 * 0.02 * 0.03)


def test_a_part_in_a_child_body_without_joint_belongs_to_the_object(tmp_path: Path) -> None:
    handle = '<body pos=".03 0 0"><geom name="handle" type="box" size=".01 .01 .01" mass="1"/></body>'
    thing = read(tmp_path, f'<body><freejoint/><geom name="cup" size=".02" mass="3"/>{handle}</body>')
    assert [part.geom for part in thing.parts] == ["cup", "handle"]
    np.testing.assert_allclose(thing.center_of_mass, [0.03 / 4, 0, 0], atol=1e-15)


def test_scene_furniture_and_options_do_no_harm(tmp_path: Path) -> None:
    solid = '<body name="thing"><freejoint name="free"/><geom size=".02"/></body>'
    plain = read(tmp_path, solid)
    text = f"""<mujoco><option timestep=".1" integrator="RK4" cone="elliptic" gravity="0 0 5"/>
      <visual><global fovy="20"/></visual>
      <asset><texture name="sky" type="skybox" builtin="flat" width="8" height="8"/><material name="m"/></asset>
      <worldbody><light/><camera/><geom type="plane" size="1 1 1" material="m"/><site/>
        <body name="sun"><light/></body>{solid}</worldbody>
      <sensor><framepos objtype="body" objname="thing"/></sensor>
      <keyframe><key qpos="9 9 9 0 1 0 0"/></keyframe></mujoco>"""
    furnished = read_object(written(tmp_path, text))
    assert (furnished.body, furnished.mass, len(furnished.parts)) == (plain.body, plain.mass, len(plain.parts))
    np.testing.assert_array_equal(corners(furnished), corners(plain))


def test_bodies_and_geoms_without_names_are_numbered(tmp_path: Path) -> None:
    thing = read(tmp_path, '<geom type="plane" size="1 1 1"/><body><geom size=".1"/><geom size=".2"/></body>')
    assert (thing.body, [part.geom for part in thing.parts]) == ("body1", ["geom1", "geom2"])


def test_included_files_are_found_from_any_working_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "objects" / "mug").mkdir(parents=True)
    (tmp_path / "elsewhere").mkdir()
    trimesh.convex.convex_hull(RAMP).export(tmp_path / "objects" / "mug" / "ramp.obj")
    written(tmp_path, '<mujoco><default><geom friction=".25"/></default></mujoco>', "common.xml")
    fragment = '<mujocoinclude><geom type="mesh" mesh="ramp"/></mujocoinclude>'
    written(tmp_path / "objects" / "mug", fragment, "body.xml")
    text = (
        '<mujoco><include file="../../common.xml"/><asset><mesh name="ramp" file="ramp.obj"/></asset>'
        '<worldbody><body><include file="body.xml"/></body></worldbody></mujoco>'
    )
    written(tmp_path / "objects" / "mug", text)
    monkeypatch.chdir(tmp_path / "elsewhere")
    thing = read_object(Path("../objects/mug/object.xml"))
    assert thing.parts[0].friction == 0.25
    np.testing.assert_allclose(thing.extent, [4, 2, 1], rtol=1e-6)


def test_unused_meshes_and_stray_files_are_no_part_of_the_object(tmp_path: Path) -> None:
    cup_mesh().export(tmp_path / "coacd_merged.obj")
    thing = read(tmp_path, '<body><geom size=".01"/></body>', f'<mesh name="unused" vertex="{WEDGE}"/>')
    assert len(thing.parts) == 1
    assert thing.size < 0.04


def test_what_mujoco_cannot_compile_is_refused_in_its_own_words(tmp_path: Path) -> None:
    mesh = f'<mesh name="m" vertex="{WEDGE}"/>'
    for text, message in (
        ('<mujoco><option apirate="50"/></mujoco>', "apirate"),
        (world('<body><geom size=".1"/></body>', mesh + mesh), "repeated name 'm'"),
    ):
        with pytest.raises(ObjectError, match=message):
            read_object(written(tmp_path, text))


def test_masses_are_those_of_the_compiled_model_whichever_geom_carries_them(tmp_path: Path) -> None:
    """Collision only, visual only, both (counted twice), stated; and exact in place of legacy inertia."""
    cup_mesh().export(tmp_path / "cup.stl")
    ghost = 'contype="0" conaffinity="0"'
    volume = cup_mesh().volume
    for geoms, inertia, mass in (
        (f'<geom size=".01" mass="2"/><geom size=".02" {ghost} mass="0"/>', "legacy", 2.0),
        (f'<geom size=".01" mass="0"/><geom size=".02" {ghost} mass="3"/>', "legacy", 3.0),
        (f'<geom size=".01" mass="2"/><geom size=".02" {ghost} mass="3"/>', "legacy", 5.0),
        ('<inertial pos="0 0 0" mass="7" diaginertia="1 1 1"/><geom size=".01" mass="2"/>', "legacy", 7.0),
        ('<geom type="mesh" mesh="cup"/>', "exact", 1000 * volume),
        ('<geom type="mesh" mesh="cup"/>', "convex", 1000 * (2 * HALF) ** 3),
    ):
        thing = read(tmp_path, f"<body>{geoms}</body>", f'<mesh name="cup" file="cup.stl" inertia="{inertia}"/>')
        assert thing.mass == pytest.approx(mass, rel=1e-5)


@pytest.mark.parametrize(
    ("mass", "doubt"), [(9e-4, "lighter than foam"), (1.1e-3, None), (2.4, None), (2.6, "heavier than any metal")]
)
def test_absurd_masses_are_doubted(tmp_path: Path, mass: float, doubt: str | None) -> None:
    """Less than 10 or more than 25,000 kg per m3: the cube here holds 0.1 litres."""
    half = 1e-4 ** (1 / 3) / 2
    thing = read(tmp_path, f'<body><geom type="box" size="{half} {half} {half}" mass="{mass}"/></body>')
    assert ["heavier" in each or "lighter" in each for each in mass_doubts(thing)] == ([True] if doubt else [])
    assert doubt is None or doubt in mass_doubts(thing)[0]


def test_contact_settings_of_the_file_do_not_move_the_surface(tmp_path: Path) -> None:
    """Margins and negative solref let geoms rest apart; planned is where they touch, with each geom's friction."""
    settings = 'margin=".005" gap=".001" solref="-6000 -300" condim="6" priority="2" contype="5" conaffinity="4"'
    thing = read(
        tmp_path, f'<body><geom size=".02" friction=".3 .1 .1" {settings}/><geom size=".01" pos="0 0 .05"/></body>'
    )
    contacts = make_candidates(thing, "100", None, seed=0).contacts
    assert set(contacts.friction.tolist()) == {0.3, 1.0}
    radii = np.where(contacts.friction == 0.3, 0.02, 0.01)
    middles = np.where(contacts.friction == 0.3, 0.0, 0.05)
    centers = np.column_stack([np.zeros((100, 2)), middles])
    np.testing.assert_allclose(np.linalg.norm(contacts.points - centers, axis=1), radii, rtol=1e-9)


@pytest.mark.parametrize("sunk", [0.0, 0.01, 0.02, 0.03])
def test_a_colliding_mesh_that_is_buried_in_another_part_is_no_visual_difference(tmp_path: Path, sunk: float) -> None:
    """A knob of 40 mm on a block of 80 mm, sunk into it by some of its height; a shift of what is seen still shows."""
    trimesh.creation.box([0.04, 0.04, 0.04]).export(tmp_path / "knob.stl")
    block = '<geom type="box" size=".04 .04 .04"/>'
    knob = f'<geom type="mesh" mesh="knob" pos="0 0 {0.06 - sunk}"/>'
    asset = '<mesh name="knob" file="knob.stl"/>'
    difference = visual_difference(read(tmp_path, f"<body>{block}{knob}</body>", asset))
    assert difference is not None
    assert difference.largest < 1e-6
    shown = f'<geom type="mesh" mesh="knob" pos="0 0 {0.063 - sunk}" contype="0" conaffinity="0"/>'
    shifted = visual_difference(read(tmp_path, f"<body>{block}{knob}{shown}</body>", asset))
    assert shifted is not None
    assert shifted.largest > 2e-3


def test_a_mesh_inside_another_part_shows_nothing_to_compare(tmp_path: Path) -> None:
    trimesh.creation.box([0.02, 0.02, 0.02]).export(tmp_path / "core.stl")
    body = '<body><geom type="box" size=".04 .04 .04"/><geom type="mesh" mesh="core"/></body>'
    assert visual_difference(read(tmp_path, body, '<mesh name="core" file="core.stl"/>')) is None
