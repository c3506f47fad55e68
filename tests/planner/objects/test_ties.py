"""What is fixed to a body belongs to the object; what hangs on a joint does once the joint is locked."""

from pathlib import Path

import numpy as np
import pytest

from planner.candidates.choice import make_candidates
from planner.errors import CandidateError, ObjectError
from planner.objects.mjcf.reader import read_object
from planner.objects.object_source import ObjectSource
from planner.objects.rigid_object import RigidObject
from tests.strategies.mjcf_files import world, written
from tests.strategies.tied_bodies import BOTTLE, KEYS, MUG


def read(
    folder: Path, content: str, body: str | None = None, locked: tuple[str, ...] = (), keyframe: str | None = None
) -> RigidObject:
    text = world(content).replace("</mujoco>", KEYS if content is BOTTLE else "</mujoco>")
    file = written(folder, text)
    return read_object(ObjectSource(file=file, body=body, locked_joints=locked, keyframe=keyframe))


@pytest.mark.parametrize(
    ("body", "touched"),
    [
        (None, ["wall", "bar", "ball"]),
        ("mug", ["wall", "bar", "ball"]),
        ("handle", ["bar", "ball"]),
        ("knob", ["ball"]),
    ],
)
def test_a_named_body_is_where_fingers_go_and_the_object_stays_whole(
    tmp_path: Path, body: str | None, touched: list[str]
) -> None:
    whole, named = read(tmp_path, MUG), read(tmp_path, MUG, body=body)
    assert [part.geom for part in named.parts] == ["wall", "bar", "ball"]
    assert named.mass == whole.mass == pytest.approx(0.43)
    assert named.body == (body or "mug")
    assert [part.geom for part, free in zip(named.parts, named.touchable, strict=True) if free] == touched
    on = make_candidates(named, "40", None, seed=0)
    assert {named.parts[part].geom for part in on.part} == set(touched)


def test_points_are_in_the_frame_of_the_named_body(tmp_path: Path) -> None:
    """The handle lies 55 mm from the mug's axis and is turned by 90 degrees about it."""
    whole, handle = read(tmp_path, MUG), read(tmp_path, MUG, body="handle")
    turned = np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1]])
    np.testing.assert_allclose(handle.center_of_mass, turned @ (whole.center_of_mass - [0.055, 0, 0]), atol=1e-12)
    np.testing.assert_allclose(handle.inertia, turned @ whole.inertia @ turned.T, atol=1e-15)
    bar = handle.parts[1].bounds()
    np.testing.assert_allclose(bar, [[-0.005, -0.005, -0.03], [0.005, 0.005, 0.03]], atol=1e-12)


def test_listed_points_off_the_named_body_are_refused(tmp_path: Path) -> None:
    points = tmp_path / "points.csv"
    points.write_text("0,0.015,0\n")  # on the wall, in the frame of the handle
    assert len(make_candidates(read(tmp_path, MUG, body="mug"), _csv(tmp_path, "0.04,0,0"), None)) == 1
    with pytest.raises(CandidateError, match="body 'handle', the only one to be touched"):
        make_candidates(read(tmp_path, MUG, body="handle"), str(points), None)


def _csv(folder: Path, line: str) -> str:
    path = folder / "one.csv"
    path.write_text(line)
    return str(path)


WELDS = {
    "two free bodies": '<weld body1="mug" body2="handle"/>',
    "the other way round": '<weld body1="handle" body2="mug"/>',
    "at sites": '<weld site1="here" site2="there"/>',
}


@pytest.mark.parametrize("weld", WELDS)
def test_bodies_that_a_constraint_welds_are_one_object(tmp_path: Path, weld: str) -> None:
    bodies = (
        '<body name="mug"><freejoint/><site name="here"/><geom name="wall" size=".04" mass=".4"/></body>'
        '<body name="handle" pos=".055 0 0"><freejoint/><site name="there"/>'
        '<geom name="bar" size=".005" mass=".02"/></body>'
    )
    text = world(bodies).replace("</mujoco>", f"<equality>{WELDS[weld]}</equality></mujoco>")
    path = written(tmp_path, text)
    for body, center in (("mug", 0.055 / 21), ("handle", -0.055 * 20 / 21)):
        thing = read_object(ObjectSource(file=path, body=body))
        assert thing.mass == pytest.approx(0.42)
        np.testing.assert_allclose(thing.center_of_mass, [center, 0, 0], atol=1e-12)
    inactive = written(tmp_path, text.replace("<weld ", '<weld active="false" '), "loose.xml")
    assert read_object(ObjectSource(file=inactive, body="handle")).mass == pytest.approx(0.02)


@pytest.mark.parametrize("body", [None, "bottle", "cap", "ring"])
@pytest.mark.parametrize(
    ("locked", "loose"),
    [((), True), (("screw",), True), (("screw", "pull"), True), (("screw", "pull", "flip"), False), (("all",), False)],
)
def test_jointed_relatives_are_refused_until_every_joint_is_locked(
    tmp_path: Path, body: str | None, locked: tuple[str, ...], loose: bool
) -> None:
    if loose:
        with pytest.raises(ObjectError, match=r"articulated.*--lock-joints screw pull flip"):
            read(tmp_path, BOTTLE, body=body, locked=locked)
        return
    thing = read(tmp_path, BOTTLE, body=body, locked=locked)
    assert thing.mass == pytest.approx(0.421)
    assert [part.geom for part in thing.parts] == ["wall", "lid", "loop"]


def test_joints_are_locked_where_the_keyframe_puts_them(tmp_path: Path) -> None:
    """The keyframe turns the cap by 90 degrees about z and pulls it by 100 mm along z."""
    closed = read(tmp_path, BOTTLE, locked=("all",))
    opened = read(tmp_path, BOTTLE, locked=("all",), keyframe="open")
    np.testing.assert_allclose(np.ptp(closed.parts[1].bounds(), axis=0), [0.03, 0.02, 0.02], atol=1e-9)
    np.testing.assert_allclose(np.ptp(opened.parts[1].bounds(), axis=0), [0.02, 0.03, 0.02], atol=1e-9)
    lifted = opened.parts[1].bounds()[1, 2] - closed.parts[1].bounds()[1, 2]
    assert lifted == pytest.approx(0.1)
    seen_from_cap = read(tmp_path, BOTTLE, body="cap", locked=("all",), keyframe="open")
    assert seen_from_cap.parts[0].bounds()[:, 2].mean() == pytest.approx(-0.175)


@pytest.mark.parametrize(
    ("body", "locked", "keyframe", "message"),
    [
        (None, ("scrw",), None, r"'scrw'.*no joint.*'screw', 'pull', 'flip'"),
        (None, ("all",), "shut", r"no keyframe named 'shut'.*'open'"),
        (None, (), "open", r"none is locked.*--lock-joints"),
        ("lid", ("all",), None, r"no body named 'lid'.*'cap'"),
    ],
)
def test_what_is_not_in_the_file_is_listed(
    tmp_path: Path, body: str | None, locked: tuple[str, ...], keyframe: str | None, message: str
) -> None:
    with pytest.raises(ObjectError, match=message):
        read(tmp_path, BOTTLE, body, locked, keyframe)


SIX = "".join(
    f'<joint type="{kind}" axis="{axis}"/>' for kind in ("slide", "hinge") for axis in ("1 0 0", "0 1 0", "0 0 1")
)


def test_what_moves_freely_is_no_relative(tmp_path: Path) -> None:
    """A thing on a table of the same file, and two things of one wrapper."""
    on_table = (
        f'<body name="table"><geom size="1" mass="9"/><body name="thing">{SIX}<geom size=".1" mass="1"/></body></body>'
    )
    thing = read(tmp_path, on_table)
    assert (thing.body, thing.mass, len(thing.parts)) == ("thing", 1, 1)
    assert read(tmp_path, on_table, body="table").mass == 9
    two = "".join(f'<body name="{name}">{SIX}<geom size=".1" mass="1"/></body>' for name in "ab")
    assert read(tmp_path, f"<body>{two}</body>", body="b").mass == 1
    with pytest.raises(ObjectError, match="several objects: bodies 'a', 'b'"):
        read(tmp_path, f"<body>{two}</body>")


def test_a_body_without_geoms_to_touch_is_refused(tmp_path: Path) -> None:
    body = '<body name="mug"><freejoint/><geom size=".04"/><body name="sticker"><site/></body></body>'
    with pytest.raises(ObjectError, match=r"no geom of body 'sticker'.*'mug'"):
        read(tmp_path, body, body="sticker")


def test_a_thing_connected_by_a_ball_is_jointed(tmp_path: Path) -> None:
    bodies = "".join(
        f'<body name="{name}" pos="{x} 0 0"><freejoint/><geom size=".1"/></body>' for name, x in (("a", 0), ("b", 1))
    )
    text = world(bodies).replace(
        "</mujoco>", '<equality><connect name="chain" body1="a" body2="b" anchor=".5 0 0"/></equality></mujoco>'
    )
    path = written(tmp_path, text)
    with pytest.raises(ObjectError, match="--lock-joints chain"):
        read_object(ObjectSource(file=path, body="a"))
    assert len(read_object(ObjectSource(file=path, body="a", locked_joints=("chain",))).parts) == 2


def test_joints_of_the_file_without_names_can_be_locked(tmp_path: Path) -> None:
    inner = '<body name="b" pos=".1 0 0"><joint/><geom size=".1"/></body>'
    body = f'<body name="a"><freejoint/><geom size=".1"/>{inner}</body>'
    with pytest.raises(ObjectError, match="--lock-joints joint1 "):
        read(tmp_path, body)
    assert len(read(tmp_path, body, locked=("joint1",)).parts) == 2
