"""The report shows the grasp in a real browser, asks for nothing from the network, and trusts no name."""

import json
import re
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from planner.candidates.candidates import CandidateChoice
from planner.candidates.choice import make_candidates
from planner.candidates.listed import listed_candidates
from planner.contact_models.models import model_of
from planner.grasp_problem import GraspProblem
from planner.grasps.grasp import Grasp, TraceLine
from planner.objects.object_file import read_object_file
from planner.objects.rigid_object import RigidObject
from planner.planning import plan
from planner.search.certified import CertifiedSearch
from planner.search.result import Status
from planner.task import make_task
from sim.report.report_data import hopeless_wrench
from sim.report.report_page import report_page, write_report
from tests.tools.browser import visit, with_script
from tests.tools.commands import ASSETS, says

EVIL = "</script><script>alert(1)</script><img src=x onerror=alert(2)>{{scene}}&amp;\u2028'\""


class Scripts(HTMLParser):
    """The page's tags, and the text of its scripts."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.scripts: list[str] = []
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        assert not {"src", "href", "onerror", "onload"} & {name for name, _ in attrs}

    def handle_data(self, data: str) -> None:
        if self.tags and self.tags[-1] == "script" and data.strip():
            self.scripts.append(data)


def test_names_from_files_stay_text(prism: RigidObject, golden_grasp: Grasp) -> None:
    plain = Scripts(report_page(prism, golden_grasp, "prism.grasp.json"))
    task = replace(golden_grasp.task, name=EVIL)
    choice = CandidateChoice(candidates=EVIL)
    evil = replace(golden_grasp, body=EVIL, geoms=(EVIL,) * 3, task=task, packages={EVIL: EVIL}, command=EVIL)
    evil = replace(evil, candidate_choice=choice)
    page = Scripts(report_page(prism, evil, EVIL))
    assert page.tags == plain.tags
    assert page.scripts[1:] == plain.scripts[1:]
    data = json.loads(page.scripts[0])
    assert data["object"]["body"] == data["task"] == data["file"] == data["contacts"][2]["geom"] == EVIL
    assert data["command"] == data["candidate_choice"]["candidates"] == EVIL


def test_the_page_names_no_address(prism: RigidObject, golden_grasp: Grasp) -> None:
    page = report_page(prism, golden_grasp, "prism.grasp.json")
    assert set(re.findall(r"https?://[^\s\"')]*", page)) == {"http://www.w3.org/2000/svg"}  # a name, never fetched
    assert not re.search(r"\b(src|href)=|@import|url\((?!#)|fetch\(|XMLHttpRequest|innerHTML|eval\(", page)
    assert "default-src 'none'" in page


@pytest.mark.slow
def test_an_open_bound_is_shown_as_open(prism: RigidObject, golden_grasp: Grasp, tmp_path: Path) -> None:
    page = tmp_path / "open.html"
    write_report(page, prism, replace(golden_grasp, lower_bound=0.0, status=Status.TIME_LIMIT), "x.grasp.json")
    assert says(visit(page, profile=tmp_path / "profile").dom, "nothing is proven yet .time limit.")


@pytest.mark.slow
def test_strengths_are_shown_where_they_differ(
    prism: RigidObject, golden_grasp: Grasp, limited_grasp: Grasp, tmp_path: Path
) -> None:
    for name, grasp, shown in (("alike", golden_grasp, False), ("differ", limited_grasp, True)):
        data = json.loads(Scripts(report_page(prism, grasp, "x.grasp.json")).scripts[0])
        assert [contact["strength"] for contact in data["contacts"]] == grasp.contacts.strengths.tolist()
        page = tmp_path / f"{name}.html"
        write_report(page, prism, grasp, "x.grasp.json")
        seen = visit(page, profile=tmp_path / name).dom
        assert says(seen, "push with, times its strength") == says(seen, "<th>strength") == shown


PIXELS = """
const pixels = () => {
  scene.draw();
  const { gl } = scene, all = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
  gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, all);
  return all;
};
const differ = (a, b) => a.reduce((count, value, i) => count + (value !== b[i]), 0);
"""

MEASURE = """
const slider = document.getElementById("slider"), first = pixels(), wrench = document.body.dataset.wrench;
const shown = () => [...document.querySelectorAll("#fingers .value")].map((cell) => cell.textContent).join("|");
const forces = shown();
slider.value = slider.max;
slider.dispatchEvent(new Event("input"));
const last = pixels();
scene.yaw += 0.5;
tell(JSON.stringify({
  drawn: first.filter((_, i) => i % 4 === 3 && first[i] > 0).length, moved: differ(first, last),
  turned: differ(last, pixels()), wrench, last: document.body.dataset.wrench, forces,
  lastForces: shown(), error: scene.gl.getError(),
  requests: performance.getEntriesByType("resource").map((entry) => entry.name),
}));
"""


def test_a_browser_shows_the_grasp_and_the_slider_changes_the_forces(
    prism: RigidObject, golden_grasp: Grasp, tmp_path: Path
) -> None:
    page = tmp_path / "prism.html"
    write_report(page, prism, golden_grasp, "prism.grasp.json")
    told = visit(with_script(page, PIXELS + MEASURE), profile=tmp_path / "profile")
    assert told.console == ()
    seen = json.loads(told.told)
    assert seen["requests"] == []
    assert seen["error"] == 0
    assert seen["drawn"] > 20_000
    assert seen["moved"] > 2_000
    assert seen["turned"] > 20_000
    assert int(seen["wrench"]) == golden_grasp.critical_wrench
    assert int(seen["last"]) == len(golden_grasp.phi) - 1 - int(golden_grasp.phi[::-1].argmin())
    forces = np.linalg.norm(golden_grasp.forces[golden_grasp.critical_wrench], axis=1)
    assert [float(value) for value in re.findall(r"([\d.]+) N", seen["forces"])] == pytest.approx(forces, rel=1e-3)
    assert seen["forces"] != seen["lastForces"]


TORQUES = """
const texts = (row) => [...row.children].map((cell) => cell.textContent);
const rows = [...document.querySelectorAll("#fingers tr")].map(texts);
const radius = 0.01, axis = [0, 0.6, 0.8];
const arcs = [0.1, 0.5, 1].map((share) => turn([1, 2, 3], axis, share, 0.5, radius).map((skin) => [...skin]));
const drawn = pixels(), wrench = Number(document.body.dataset.wrench), moving = scene.moving.length;
data.torques[wrench].fill(0);
scene.show(wrench);
tell(JSON.stringify({ rows, arcs, moving, still: scene.moving.length, arcsPixels: differ(drawn, pixels()),
  error: scene.gl.getError(), words: document.getElementById("panels").textContent,
  legend: document.getElementById("legend").textContent }));
"""


def seen_torques(page: Path, rigid_object: RigidObject, grasp: Grasp, profile: Path) -> dict[str, Any]:
    """What a browser shows of the fingers' torques."""
    write_report(page, rigid_object, grasp, "box.grasp.json")
    told = visit(with_script(page, PIXELS + TORQUES), profile=profile)
    assert told.console == ()
    seen: dict[str, Any] = json.loads(told.told)
    assert seen["error"] == 0
    return seen


def test_the_torques_of_soft_fingers_are_told_and_drawn(
    box_object: RigidObject, soft_grasp: Grasp, tmp_path: Path
) -> None:
    seen = seen_torques(tmp_path / "box.html", box_object, soft_grasp, tmp_path / "profile")
    wrench, contacts = soft_grasp.critical_wrench, soft_grasp.contacts
    head, *rows = seen["rows"]
    assert head == ["", "planned force", "torque [N\u00a0mm]", "friction used"]
    torques = soft_grasp.torques[wrench]
    assert (np.abs(torques) > 1e-4).all()
    assert [float(row[2]) for row in rows] == pytest.approx(1000 * torques, rel=5e-3)
    used = model_of(contacts).utilisation(soft_grasp.forces[wrench], torques, contacts) / contacts.friction
    assert [float(row[3].removesuffix(" %")) for row in rows] == pytest.approx(100 * used, abs=0.5)
    assert seen["moving"] == seen["still"] + 2 * len(torques)  # an arc and its head for every torque
    assert seen["arcsPixels"] > 500
    assert says(seen["words"], "Rubbing and twisting share one cone.*torsion γ .mm.")
    assert "Arcs are the fingers' torques" in seen["legend"]


def test_hard_fingers_have_no_torques_on_the_page(prism: RigidObject, golden_grasp: Grasp, tmp_path: Path) -> None:
    seen = seen_torques(tmp_path / "prism.html", prism, golden_grasp, tmp_path / "profile")
    assert seen["rows"][0] == ["", "planned force", "friction used"]
    assert (seen["moving"], seen["arcsPixels"]) == (seen["still"], 0)
    assert not says(seen["words"], "torsion|torque|twist")
    assert "torque" not in seen["legend"]


def test_an_arc_turns_right_handed_about_its_axis_and_is_as_long_as_its_share(
    box_object: RigidObject, soft_grasp: Grasp, tmp_path: Path
) -> None:
    seen = seen_torques(tmp_path / "box.html", box_object, soft_grasp, tmp_path / "profile")
    axis, center = np.array([0, 0.6, 0.8]), np.array([1, 2, 3])
    for share, (tube, head) in zip((0.1, 0.5, 1.0), seen["arcs"], strict=True):
        places = np.array(tube).reshape(-1, 6)[:, :3] - center
        assert np.linalg.norm(places, axis=1) == pytest.approx(0.5, abs=0.011)
        assert places @ axis == pytest.approx(0, abs=0.011)
        start, stop = places[:6].mean(axis=0), places[-6:].mean(axis=0)
        across = np.cross(axis, start)
        angle = np.arctan2(stop @ across, stop @ start) % (2 * np.pi)
        assert angle == pytest.approx(1.4 * np.pi * share, abs=0.1)
        tip = np.array(head).reshape(-1, 6)[:, :3] - center
        assert (tip @ np.cross(axis, stop)).max() > 0.01  # the head points on


def with_log(grasp: Grasp, lines: int) -> Grasp:
    """The grasp with an invented search log that ends as its own does: halfway to the end at every line."""
    (end,) = grasp.search.trace[-1:]
    shares = [1 - 0.5**k for k in range(lines - 1)]
    log = tuple(
        TraceLine(
            seconds=end.seconds * share,
            nodes=int(end.nodes * share),
            open=lines,
            lower_bound=end.lower_bound * share,
            incumbent=None if share == 0 else grasp.rho * (2 - share),
            socp_solves=int(end.socp_solves * share**2),
            cuts=end.cuts,
        )
        for share in shares
    )
    return replace(grasp, search=replace(grasp.search, trace=(*log, end)))


CURVE = """
const all = (what) => [...document.querySelectorAll(`#gap ${what}`)];
const dots = () => all("circle").map((dot) => ["cx", "cy"].map((key) => Number(dot.getAttribute(key))));
const texts = () => all("text").map((text) => text.textContent);
const [first, names] = [dots(), texts()], log = document.getElementById("log");
document.querySelector("button[data-by=socp_solves]").click();
tell(JSON.stringify({ first, names, second: dots(), otherNames: texts(), open: log.open,
  rows: log.querySelectorAll("td:first-child").length, command: document.getElementById("command").textContent,
  words: document.getElementById("panels").textContent }));
"""


@pytest.mark.slow
def test_the_gap_curve_is_drawn_to_scale_and_a_long_log_is_folded(
    prism: RigidObject, golden_grasp: Grasp, tmp_path: Path
) -> None:
    page, command = tmp_path / "prism.html", "grasp-plan 'my  prism.xml' --friction 0.3"
    grasp = replace(with_log(golden_grasp, 12), command=command)
    write_report(page, prism, grasp, "prism.grasp.json")
    told = visit(with_script(page, CURVE), profile=tmp_path / "profile")
    assert told.console == ()
    seen = json.loads(told.told)
    trace = grasp.search.trace
    values = [line.lower_bound for line in trace] + [line.incumbent for line in trace if line.incumbent is not None]
    for dots, key in ((seen["first"], "seconds"), (seen["second"], "socp_solves")):
        places = [getattr(line, key) for line in trace] + [getattr(line, key) for line in trace[1:]]
        drawn = np.array(dots)
        assert drawn.shape == (12 + 11, 2)
        assert np.corrcoef(drawn[:, 0], places)[0, 1] == pytest.approx(1)
        assert np.corrcoef(drawn[:, 1], values)[0, 1] == pytest.approx(-1)  # drawings count downward
    assert {"time [s]", "rho, the force of a finger [N]"} <= set(seen["names"])
    assert "second-order cone programs solved" in seen["otherNames"]
    assert (seen["open"], seen["rows"], seen["command"]) == (False, 12, command)
    for said in (prism.sha256, f"clarabel {golden_grasp.packages['clarabel']}", "candidatescase3", "friction0.3"):
        assert said in seen["words"]


BARE = """
const dotted = pixels(), box = document.querySelector("#toggle input");
box.click();
const bare = pixels();
scene.moving = [];
tell(JSON.stringify({ dots: differ(dotted, bare), load: differ(bare, pixels()), error: scene.gl.getError(),
  requests: performance.getEntriesByType("resource").length, words: document.getElementById("panels").textContent,
  slider: document.getElementById("slider") !== null, curve: document.querySelectorAll("#gap circle").length }));
"""


def seen_without_grasp(rigid_object: RigidObject, grasp: Grasp, folder: Path) -> dict[str, Any]:
    """What a browser shows of a search that has found nothing."""
    assert not grasp.found
    page = folder / "none.html"
    write_report(page, rigid_object, grasp, "none.grasp.json")
    told = visit(with_script(page, PIXELS + BARE), profile=folder / "profile")
    assert told.console == ()
    seen: dict[str, Any] = json.loads(told.told)
    assert (seen["error"], seen["requests"], seen["slider"]) == (0, 0, False)
    assert seen["dots"] > 50
    return seen


@pytest.mark.slow
def test_a_task_proven_impossible_is_shown_with_its_proof_and_the_load_nothing_balances(
    prism: RigidObject, tmp_path: Path
) -> None:
    top = np.array([(-0.01, -0.01, 0.01), (0, -0.01, 0.01), (-0.01, 0, 0.01), (-0.005, -0.005, 0.01)])
    grasp = plan(GraspProblem(prism, make_task("gravity", prism), listed_candidates(prism, top, 0.3), fingers=3))
    wrench = hopeless_wrench(grasp)
    assert wrench is not None
    assert grasp.task.wrenches[wrench, 2] < 0  # fingers on top cannot hold up
    seen = seen_without_grasp(prism, grasp, tmp_path)
    assert seen["load"] > 500
    assert says(seen["words"], "No grasp exists.*No 3 of the 4 candidates .4 subsets. resist “gravity” with less than")
    assert says(seen["words"], f"One direction proves it.*wrench {wrench} of the task.*choice not recorded")


@pytest.mark.slow
def test_a_search_stopped_before_its_first_grasp_says_what_is_open(prism: RigidObject, tmp_path: Path) -> None:
    candidates = make_candidates(prism, "case3", 0.3, seed=0)
    grasp = plan(GraspProblem(prism, make_task("paper", prism), candidates, 3), CertifiedSearch(time_limit=0))
    seen = seen_without_grasp(prism, grasp, tmp_path)
    assert seen["load"] == 0
    assert seen["curve"] >= len(grasp.search.trace)
    assert says(seen["words"], "No grasp was found.*one may exist .time limit.*stopped at its time limit")
    assert "No grasp exists" not in seen["words"]


def test_a_planar_object_without_a_grasp_has_a_page() -> None:
    plate = read_object_file(ASSETS / "planar" / "convex.toml")
    grasp = plan(GraspProblem(plate, make_task("paper", plate), make_candidates(plate, "20", 0.3, seed=0), fingers=1))
    assert grasp.status is Status.INFEASIBLE
    assert "<title>plate: no grasp (infeasible)</title>" in report_page(plate, grasp, "plate.grasp.json")
