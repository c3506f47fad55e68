"""The report shows the grasp in a real browser, asks for nothing from the network, and trusts no name."""

import json
import re
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest

from planner.errors import GraspFileError
from planner.exports.report_page import report_page, write_report
from planner.grasp import Grasp
from planner.objects.rigid_object import RigidObject
from planner.search.result import Status
from tests.commands import says
from tests.planner.exports.browser import visit, with_script

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
    evil = replace(golden_grasp, body=EVIL, geoms=(EVIL,) * 3, task=task, packages={EVIL: EVIL})
    page = Scripts(report_page(prism, evil, EVIL))
    assert page.tags == plain.tags
    assert page.scripts[1:] == plain.scripts[1:]
    data = json.loads(page.scripts[0])
    assert data["object"]["body"] == data["task"] == data["file"] == data["contacts"][2]["geom"] == EVIL


def test_the_page_names_no_address(prism: RigidObject, golden_grasp: Grasp) -> None:
    page = report_page(prism, golden_grasp, "prism.grasp.json")
    assert set(re.findall(r"https?://[^\s\"')]*", page)) == {"http://www.w3.org/2000/svg"}  # a name, never fetched
    assert not re.search(r"\b(src|href)=|@import|url\(|fetch\(|XMLHttpRequest|innerHTML|eval\(", page)
    assert "default-src 'none'" in page


def test_a_grasp_that_was_not_found_is_refused(prism: RigidObject, golden_grasp: Grasp) -> None:
    none = replace(
        golden_grasp,
        contacts=golden_grasp.contacts.subset(np.empty(0, dtype=int)),
        phi=np.empty(0),
        forces=np.empty((0, 0, 3)),
    )
    with pytest.raises(GraspFileError, match="nothing to show"):
        report_page(prism, none, "x.grasp.json")


def test_an_open_bound_is_shown_as_open(prism: RigidObject, golden_grasp: Grasp, tmp_path: Path) -> None:
    page = tmp_path / "open.html"
    write_report(page, prism, replace(golden_grasp, lower_bound=0.0, status=Status.TIME_LIMIT), "x.grasp.json")
    assert says(visit(page, profile=tmp_path / "profile").dom, "nothing is proven yet .time limit.")


MEASURE = """
const pixels = () => {
  scene.draw();
  const { gl } = scene, all = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
  gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, all);
  return all;
};
const differ = (a, b) => a.reduce((count, value, i) => count + (value !== b[i]), 0);
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
    told = visit(with_script(page, MEASURE), profile=tmp_path / "profile")
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
