"""A line is rewritten on terminals only, makes room for output, and never fills a log file."""

import logging

import pytest

from planner.errors import ObjectError
from planner.terminal.command_line import ExitCode, run
from planner.terminal.console import SELDOM, Console
from planner.terminal.progress import PATIENCE
from tests.tools.terminals import screen, terminal


class Clock:
    """Time that passes when told to."""

    now = 0.0

    def __call__(self) -> float:
        return self.now


def test_on_a_terminal_one_line_is_rewritten_and_output_pushes_it_down() -> None:
    with terminal() as wide:
        clock = Clock()
        console = Console(clock=clock)
        console.show("a long line about loading")
        console.say("object box")
        for done in range(4):
            clock.now += 1
            console.count("grasps", done, 9)
        written = wide.arrived()
        assert screen(written) == ["object box", "3 of 9 grasps, about 6 s left"]
        assert "1 of 9 grasps" in written
        console.clear()
        assert screen(written + wide.arrived())[1] == ""


def test_a_line_is_cut_at_the_edge_of_the_terminal() -> None:
    with terminal(columns=12) as narrow:
        Console().show("0123456789abcdef")
        assert narrow.arrived() == "\r0123456789a"


def test_many_counts_a_second_are_not_all_drawn() -> None:
    with terminal() as wide:
        clock = Clock()
        console = Console(clock=clock)
        for done in range(1000):
            clock.now += 1e-3
            console.count("steps", done, 1000)
        assert 5 <= wide.arrived().count("\r") <= 12


def test_elsewhere_plain_lines_come_seldom_and_without_control_characters(capsys: pytest.CaptureFixture[str]) -> None:
    clock = Clock()
    console = Console(clock=clock)
    console.show("loading")
    for tenth in range(200):
        clock.now = tenth / 10
        console.count("grasps", tenth, 200)
    captured = capsys.readouterr()
    lines = captured.err.splitlines()
    assert captured.out == ""
    assert lines[0] == "… 20 of 200 grasps, about 18 s left"
    assert len(lines) == 1 + (20 - PATIENCE) // SELDOM
    assert captured.err.replace("\n", "").isprintable()


def test_a_dumb_terminal_is_written_to_plainly() -> None:
    with terminal(kind="dumb") as dumb:
        console = Console()
        console.show("loading")
        console.announce("compiling")
        assert dumb.arrived() == "… compiling\n"


def test_quiet_leaves_errors_and_what_was_asked_for() -> None:
    with terminal() as wide:
        console = Console(quiet=True)
        console.show("loading")
        console.announce("compiling")
        console.count("grasps", 1, 2)
        console.say("rho")
        console.complain("error")
        console.write("{}")
        assert wide.arrived() == "error\n{}\n"


def test_words_leave_standard_output_to_json(capsys: pytest.CaptureFixture[str]) -> None:
    console = Console(json=True)
    console.say("rho")
    console.write("{}")
    assert capsys.readouterr() == ("{}\n", "rho\n")


def log_and_fail() -> ExitCode:
    logging.getLogger("planner.search").info("compiling the search, once; about 10 s")
    logging.getLogger("planner.objects").warning("mass 0")
    logging.getLogger("elsewhere").info("not for users")
    raise ObjectError("no body")


@pytest.mark.parametrize(
    ("quiet", "expected"),
    [
        (False, "… compiling the search, once; about 10 s\nWARNING: mass 0\nerror: no body\n"),
        (True, "error: no body\n"),
    ],
)
def test_infos_of_the_planner_are_announced_and_warnings_told(
    quiet: bool, expected: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit):
        run(log_and_fail, Console(quiet=quiet))
    assert capsys.readouterr() == ("", expected)


def test_an_announcement_on_a_terminal_is_gone_when_the_command_is() -> None:
    def announce() -> ExitCode:
        logging.getLogger("sim").info("compiling")
        return ExitCode.DONE

    with terminal() as wide:
        with pytest.raises(SystemExit):
            run(announce)
        written = wide.arrived()
        assert "compiling" in written and screen(written) == [""]
