"""What is printed about the frame of a task: enough to notice that a body lies otherwise than one thought."""

from pathlib import Path

import pytest

from tests.tools.commands import ASSETS, run, says

BAR = """<mujoco><worldbody><body name="bar" {pose}><freejoint/>
<geom name="bar" type="box" size="0.05 0.02 0.03" mass="1" friction="0.5"/></body></worldbody></mujoco>"""

DOWN = 'set = {kind = "single", wrench = [0, 0, -9.81, 0, 0, 0]}'


@pytest.mark.parametrize(
    ("pose", "turned"),
    [('euler="90 0 0" pos="0 0 1"', ", which the file turns by 90°"), ('pos="0 0 1"', ""), ('euler="0.01 0 0"', "")],
)
def test_the_task_line_names_the_frame_and_how_far_the_file_turns_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], pose: str, turned: str
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("bar.xml").write_text(BAR.format(pose=pose))
    Path("down.toml").write_text(DOWN)
    assert run("grasp-plan", "bar.xml", "--task", "down.toml", "--candidates", 30) == 0
    said = capsys.readouterr().out
    assert f"task        down: 1 wrench in the body frame{turned}, moments about (0, 0, 0) mm\n" in said


def test_a_planar_task_is_in_the_body_frame(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run("grasp-plan", ASSETS / "planar" / "convex.toml", "--candidates", 30) == 0
    assert says(
        capsys.readouterr().out, r"task gravity: \d+ wrenches in the body frame, moments about \([^,]+, [^,]+\) mm"
    )


def test_contacts_of_a_load_in_the_world_support_the_body_from_below_as_its_file_places_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Turned by 90 degrees about x, body -y is down; in the body frame the same numbers would be body -z."""
    monkeypatch.chdir(tmp_path)
    Path("bar.xml").write_text(BAR.format(pose='euler="90 0 0" pos="0 0 1"'))
    for frame, axis, height in (("world", 1, "-20.000"), ("body", 2, "-30.000")):
        Path("down.toml").write_text(f'frame = "{frame}"\n{DOWN}')
        assert run("grasp-plan", "bar.xml", "--task", "down.toml", "--candidates", 100) == 0
        contacts = [line.split()[2:5] for line in capsys.readouterr().out.splitlines() if line.startswith("contact")]
        assert [contact[axis] for contact in contacts] == 3 * [height]


def test_inspect_says_where_the_file_places_the_body(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "bar.xml"
    path.write_text(BAR.format(pose='euler="90 0 0" pos="0 0.5 1"'))
    assert run("grasp-inspect", path, "--candidates", 30) == 0
    assert says(
        capsys.readouterr().out,
        r"the body frame lies at \(0, 500, 1000\) mm in the world of the file, turned by 90° about",
    )
