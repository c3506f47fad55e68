"""Tasks by name and by file."""

from pathlib import Path

import numpy as np
import pytest

from planner.errors import TaskError
from planner.task import Task, make_task
from planner.toml_file import MAX_FILE_BYTES
from planner.wrench_sets.cylinder import Cylinder
from tests.planner.wrench_sets.brick import brick

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
    np.testing.assert_array_equal(task.wrenches, Cylinder(force=5, moment=0.1, force_facets=12).vertices())


def test_a_file_may_leave_out_name_and_reference_point(tmp_path: Path) -> None:
    task = make_task(written(tmp_path, "set = {kind = 'single', wrench = [0, 0, -1, 0, 0, 0]}"), brick())
    assert task.name == "turn"
    np.testing.assert_array_equal(task.reference_point, brick().center_of_mass)
    np.testing.assert_array_equal(task.wrenches, [[0, 0, -1, 0, 0, 0]])


def test_a_file_may_name_a_preset_and_its_parameters(tmp_path: Path) -> None:
    task = make_task(written(tmp_path, "[set]\nkind = 'axes6'\nacceleration = 20"), brick())
    assert np.abs(task.wrenches).max() == pytest.approx(0.5 * 20)


@pytest.mark.parametrize("path", sorted((ASSETS / "tasks").glob("*.toml")), ids=lambda path: path.stem)
def test_the_shipped_task_files_load(path: Path) -> None:
    assert make_task(str(path), brick()).name == path.stem


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("name = ", "Invalid value"),
        ("name = 'a'", "missing required field `set`"),
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
    with pytest.raises(TaskError, match="presets paper, gravity, axes6"):
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
def test_a_task_needs_wrenches_that_fit_its_reference_point(wrenches: np.ndarray, message: str) -> None:
    with pytest.raises(TaskError, match=message):
        Task(name="task", reference_point=np.zeros(3), wrenches=wrenches)


def test_a_planar_task_has_wrenches_of_three_numbers() -> None:
    wrenches = Cylinder(force=1, moment=1, dimension=2).vertices()
    assert Task(name="plane", reference_point=np.zeros(2), wrenches=wrenches).wrenches.shape == (16, 3)
