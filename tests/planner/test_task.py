"""Tasks by name and by file."""

from pathlib import Path

import numpy as np
import pytest

from planner.arrays import Floats
from planner.errors import TaskError
from planner.files.toml_file import MAX_FILE_BYTES
from planner.objects.mjcf.reader import read_object
from planner.objects.object_source import ObjectSource
from planner.objects.planar.reader import read_planar
from planner.task import Task, make_task
from planner.wrench_sets.cylinder import WrenchCylinder
from tests.strategies.bricks import brick

ASSETS = Path(__file__).resolve().parents[2] / "assets"

SCREWDRIVER = """
name = "screwdriver"
reference_point = [0, 0, 0.02]
[set]
kind = "cylinder"
force = 5
moment = 0.1
force_facets = 12
"""


def written(folder: Path, text: str) -> str:
    path = folder / "turn.toml"
    path.write_text(text, encoding="utf-8")
    return str(path)


def test_a_preset_acts_about_the_center_of_mass() -> None:
    task = make_task("gravity", brick())
    assert (task.name, task.wrenches.shape) == ("gravity", (72, 6))
    np.testing.assert_array_equal(task.reference_point, brick().center_of_mass)


def test_a_file_states_name_reference_point_and_set(tmp_path: Path) -> None:
    task = make_task(written(tmp_path, SCREWDRIVER), brick(mass=0.0))
    assert task.name == "screwdriver"
    np.testing.assert_array_equal(task.reference_point, [0, 0, 0.02])
    np.testing.assert_array_equal(task.wrenches, WrenchCylinder(force=5, moment=0.1, force_facets=12).vertices())


def test_a_file_may_leave_out_name_and_reference_point(tmp_path: Path) -> None:
    task = make_task(written(tmp_path, "set = {kind = 'single', wrench = [0, 0, -1, 0, 0, 0]}"), brick())
    assert task.name == "turn"
    np.testing.assert_array_equal(task.reference_point, brick().center_of_mass)
    np.testing.assert_array_equal(task.wrenches, [[0, 0, -1, 0, 0, 0]])


def test_a_file_may_name_a_preset_and_its_parameters(tmp_path: Path) -> None:
    task = make_task(written(tmp_path, "[set]\nkind = 'axes6'\nacceleration = 20"), brick())
    assert np.abs(task.wrenches).max() == pytest.approx(0.5 * 20)


NESTED = """<mujoco><worldbody>
  <body name="table" pos="1 2 0" euler="0 0 90">
    <body name="bar" euler="90 0 0" pos="0 0 1">{joint}<geom type="box" size=".05 .02 .03" mass="1"/></body>
  </body>
</worldbody></mujoco>"""
"""Turned by 90 degrees about x, then about z: body z is world x, body y is up, body x is world y."""

WORLD = """
frame = "world"
reference_point = [1, 2.1, 1.2]
[set]
kind = "polytope"
wrenches = [[0, 0, -9.81, 0, 0, 0], [1, 2, 3, 4, 5, 6]]
"""


@pytest.mark.parametrize("joint", ["", "<joint type='slide'/>"])
def test_a_task_in_the_world_frame_is_turned_into_the_body_as_its_file_places_it(tmp_path: Path, joint: str) -> None:
    (tmp_path / "bar.xml").write_text(NESTED.format(joint=joint))
    bar = read_object(ObjectSource(file=tmp_path / "bar.xml", body="bar"))
    task = make_task(written(tmp_path, WORLD), bar)
    np.testing.assert_allclose(task.reference_point, [0.1, 0.2, 0], atol=1e-12)
    np.testing.assert_allclose(task.wrenches, [[0.0, -9.81, 0, 0, 0, 0], [2.0, 3, 1, 5, 6, 4]], atol=1e-12)
    task = make_task(written(tmp_path, WORLD.replace("reference_point = [1, 2.1, 1.2]", "")), bar)
    np.testing.assert_array_equal(task.reference_point, bar.center_of_mass)


def test_a_task_that_names_no_frame_is_in_the_body_frame_whatever_the_pose(tmp_path: Path) -> None:
    (tmp_path / "bar.xml").write_text(NESTED.format(joint=""))
    bar = read_object(ObjectSource(file=tmp_path / "bar.xml", body="bar"))
    for frame in ("", 'frame = "body"'):
        task = make_task(written(tmp_path, WORLD.replace('frame = "world"', frame)), bar)
        np.testing.assert_array_equal(task.reference_point, [1, 2.1, 1.2])
        np.testing.assert_array_equal(task.wrenches[1], [1, 2, 3, 4, 5, 6])


def test_work_does_not_depend_on_the_frame_a_task_is_written_in(tmp_path: Path) -> None:
    """f . v + m . omega of any twist about the reference point is the same in both frames."""
    (tmp_path / "bar.xml").write_text(NESTED.format(joint="").replace('"90 0 0"', '"30 40 50"'))
    bar = read_object(ObjectSource(file=tmp_path / "bar.xml", body="bar"))
    turn = bar.pose_in_file.rotation
    twists = np.random.Generator(np.random.PCG64(0)).normal(size=(5, 2, 3))
    wrenches = make_task(written(tmp_path, WORLD), bar).wrenches
    work = np.array([[0, 0, -9.81, 0, 0, 0], [1, 2, 3, 4, 5, 6]]) @ (twists @ turn.T).reshape(5, 6).T
    np.testing.assert_allclose(wrenches @ twists.reshape(5, 6).T, work, atol=1e-12)


def test_a_planar_object_has_no_world(tmp_path: Path) -> None:
    planar = read_planar(ASSETS / "planar" / "convex.toml")
    text = 'frame = "world"\nset = {kind = "single", wrench = [0, -5, 0]}'
    with pytest.raises(TaskError, match="a planar object has only its own"):
        make_task(written(tmp_path, text), planar)


@pytest.mark.parametrize("text", ["name = 'a'", "[set]\nkind = 'sphere'", "", "set = ", "[set]\nkind = 'box'"])
@pytest.mark.parametrize("planar", [False, True])
def test_a_complaint_shows_a_whole_file_that_works(tmp_path: Path, text: str, planar: bool) -> None:
    thing = read_planar(ASSETS / "planar" / "convex.toml") if planar else brick()
    with pytest.raises(TaskError) as caught:
        make_task(written(tmp_path, text), thing)
    _, sample = str(caught.value).split("can be: ")
    assert len(make_task(written(tmp_path, sample), thing).wrenches) == 1


@pytest.mark.parametrize("path", sorted((ASSETS / "tasks").glob("*.toml")), ids=lambda path: path.stem)
def test_the_shipped_task_files_load(path: Path) -> None:
    assert make_task(str(path), brick()).name == path.stem


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("name = ", "Invalid value"),
        ("name = 'a'", "missing required field `set`"),
        ("frame = 'hand'\n[set]\nkind = 'box'", r"Invalid enum value 'hand' - at `\$\.frame`"),
        ("color = 1\n[set]\nkind = 'box'", "unknown field `color`"),
        ("name = 3\n[set]\nkind = 'box'", r"Expected `str.*\$\.name"),
        ("[set]\nkind = 'sphere'", "set.kind is 'sphere'; allowed: ball, box, .*, paper, gravity, axes6"),
        ("[set]\nforce = 1", "set.kind is None; allowed"),
        ("[set]\nkind = ['box']", r"set.kind is \['box'\]; allowed"),
        ("set = 'box'", r"Expected `object`, got `str` - at `\$\.set`"),
        (SCREWDRIVER.replace("= 5", "= '5'"), r"Expected `float`, got `str` - at `\$\.set\.force`"),
        (SCREWDRIVER.replace("moment", "torque"), r"unknown field `torque` - at `\$\.set`"),
        (SCREWDRIVER.replace("= 5", "= nan"), "force must be finite and not negative, at most 1e.12, got nan"),
        (SCREWDRIVER.replace("= 5", "= inf"), "force must be finite and not negative, at most 1e.12, got inf"),
        (SCREWDRIVER.replace("= 12", "= 12.5"), r"Expected `int.*\$\.set\.force_facets"),
        (SCREWDRIVER.replace("= 12", "= 1000"), "6 to 200 facets, got 1000"),
        (SCREWDRIVER.replace("= 12", "= 200\nmoment_facets = 200"), "at most 4096 are allowed: use fewer facets"),
        (SCREWDRIVER.replace("0.02]", "nan]"), "reference_point must be finite"),
        (SCREWDRIVER.replace("0.02]", "0.02, 0]"), r"reference_point has shape \(4,\); expected 3 numbers"),
        (SCREWDRIVER + "dimension = 2", r"shape \(24, 3\); .* expected \(1 or more, 6\)"),
        ("[set]\nkind = 'polytope'\nwrenches = []", "wrenches is empty"),
        (
            "[set]\nkind = 'box'\nforce = [1, 1, 1]\nmoment = [0, 0, 0]\ncenter = [1e308, 0, 0, 0, 0, 0]",
            r"center must be finite and at most 1e.12",
        ),
        ("[set]\nkind = 'gravity'\nradius = -1", "radius must be finite and not negative, at most 1e.12, got -1"),
        ("a = " + 5000 * "[", "task file"),
        ("a = " + 5000 * "9", "task file"),
        (SCREWDRIVER.replace("= 5", "= 1" + 400 * "0"), "task file"),
    ],
)
def test_a_broken_file_is_refused_with_the_place_and_what_is_allowed(tmp_path: Path, text: str, message: str) -> None:
    path = written(tmp_path, text)
    with pytest.raises(TaskError, match=message) as caught:
        make_task(path, brick())
    assert path in str(caught.value)


@pytest.mark.parametrize("choice", ["papre", "", ".", "a\0b", 5000 * "x"])
def test_what_is_neither_preset_nor_file_is_refused_with_the_presets(choice: str) -> None:
    with pytest.raises(TaskError, match="presets paper, gravity, axes6 need no file; a whole task file can be: set = "):
        make_task(choice, brick())


def test_a_file_that_is_no_text_is_refused(tmp_path: Path) -> None:
    (tmp_path / "turn.toml").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(TaskError, match="task file"):
        make_task(str(tmp_path / "turn.toml"), brick())


def test_an_endless_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(TaskError, match=f"larger than {MAX_FILE_BYTES} bytes"):
        make_task(written(tmp_path, SCREWDRIVER + MAX_FILE_BYTES * "#"), brick())


@pytest.mark.parametrize(
    ("wrenches", "message"),
    [
        (np.zeros((0, 6)), r"\(0, 6\)"),
        (np.zeros(6), r"\(6,\)"),
        (np.zeros((2, 6)), "every wrench of the task is zero"),
        (np.ones((2, 3)), r"expected \(1 or more, 6\)"),
        (np.full((1, 6), np.nan), "not finite"),
    ],
)
def test_a_task_needs_wrenches_that_fit_its_reference_point(wrenches: Floats, message: str) -> None:
    with pytest.raises(TaskError, match=message):
        Task(name="task", reference_point=np.zeros(3), wrenches=wrenches)


def test_a_planar_task_has_wrenches_of_three_numbers() -> None:
    wrenches = WrenchCylinder(force=1, moment=1, dimension=2).vertices()
    assert Task(name="plane", reference_point=np.zeros(2), wrenches=wrenches).wrenches.shape == (16, 3)
