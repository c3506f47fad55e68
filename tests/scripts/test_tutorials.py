"""Every tutorial runs as its docstring says, and its output bears out what it teaches."""

import contextlib
import io
import re
import runpy
import sys
from pathlib import Path

import pytest

from planner.grasps.grasp_file import read_grasp
from tests.tools.commands import ROOT, says

pytestmark = pytest.mark.slow

TUTORIALS = ROOT / "scripts" / "tutorials"


def output(name: str, *arguments: object) -> str:
    """What a tutorial prints."""
    script = str(TUTORIALS / f"{name}.py")
    with pytest.MonkeyPatch.context() as patch, contextlib.redirect_stdout(io.StringIO()) as said:
        patch.setattr(sys, "argv", [script, *map(str, arguments)])
        runpy.run_path(script, run_name="__main__")
    return said.getvalue()


def numbers(pattern: str, text: str) -> list[float]:
    return [float(match) for match in re.findall(pattern, text)]


def test_an_own_object_is_planned_checked_and_shown(tmp_path: Path) -> None:
    text = output("own_object", "--folder", tmp_path)
    assert says(text, "14 of 14 claims hold")
    assert read_grasp(tmp_path / "hammer.grasp.json").rho == pytest.approx(
        numbers(r"need ([\d.]+) N, on", text)[0], 1e-3
    )
    assert (tmp_path / "hammer.report.html").stat().st_size > 50_000


def test_a_task_that_contains_another_needs_more() -> None:
    narrow, wide = numbers(r"rho +([\d.]+) N", output("design_a_task"))
    assert wide > 2 * narrow


def test_rougher_fingertips_never_need_more_and_no_grasp_beats_the_best() -> None:
    rows = [line.split() for line in output("compare_frictions").splitlines()[1:]]
    best, kept = [float(row[1]) for row in rows], [float(row[-1]) for row in rows]
    assert best == sorted(best, reverse=True)
    assert best[0] == kept[0]
    assert all(old >= 0.999 * new for old, new in zip(kept, best, strict=True))
    assert kept[-1] > 1.05 * best[-1]  # the best contacts have moved


def test_more_fingers_carry_more_and_mujoco_agrees() -> None:
    text = output("size_a_finger")
    payloads = numbers(r"carry ([\d.]+) kg", text)
    assert len(payloads) == 3
    assert payloads == sorted(payloads)
    assert says(text, "MuJoCo says pass")


def test_pads_help_a_jaw_while_they_are_small_and_friction_does_beyond() -> None:
    rows = [line.split() for line in output("size_a_jaw").splitlines()[1:]]
    rho = {(row[0], float(row[4])): [float(force) for force in row[5:10]] for row in rows}
    weight = {row[0]: float(row[1]) for row in rows}
    assert len(rho) == 9
    for force in rho.values():
        assert force == sorted(force, reverse=True)
        assert 1.7 < force[0] / force[1] <= 2.01  # twice the pad, half the force
        assert force[3] < 1.4 * force[4]  # and hardly more than friction alone asks for
    for name in weight:
        slippery, usual, rough = (rho[name, friction] for friction in (0.3, 0.5, 0.8))
        assert 0.8 * rough[0] <= 1.01 * 0.3 * slippery[0]
        assert rough[-1] < usual[-1] < slippery[-1]
    shares = {name: rho[name, 0.5][-1] / weight[name] for name in weight}
    assert shares["box"] == pytest.approx(2, abs=0.2) and shares["bottle"] == pytest.approx(2, abs=0.2)
    assert shares["tool"] == pytest.approx(3, abs=0.3)
    for row in rows:
        enough = [radius for radius, force in zip((1, 2, 4, 8), map(float, row[5:9]), strict=True) if force <= 10]
        pads = f"pads of {enough[0]} mm" if enough else "no such pads"
        assert " ".join(row[10:]) == f"closing with 10 N: {pads}"


def test_every_tutorial_has_a_test() -> None:
    tested = set(re.findall(r'output\("(\w+)"', Path(__file__).read_text()))
    assert tested == {path.stem for path in TUTORIALS.glob("*.py")}
