"""The paper's numerical section, reproduced in one run: tables and figures in a folder.

    python scripts/reproduce_paper.py --out paper            # about an hour on two cores
    python scripts/reproduce_paper.py --out paper --quick    # a minute, on reduced candidates

Case III is the paper's own. The outlines of Cases I and II appear only in its figures, so the planar cases here are
ours, of the same size (56 and 86 candidates) under the same rules; their numbers are not the paper's.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated

import numpy as np
import tyro

from planner.candidates.choice import make_candidates
from planner.contacts import Contacts
from planner.files.atomic_write import require_writable, write_atomically
from planner.objects.graspable import Graspable
from planner.objects.mjcf.reader import read_object
from planner.objects.planar.planar_object import PlanarObject
from planner.objects.planar.reader import read_planar
from planner.objects.rigid_object import RigidObject
from planner.pictures.figures import draw_outline, new_figure, object_figure, save_figure
from planner.search.certified import CertifiedSearch
from planner.search.evaluation import Evaluation, Evaluator
from planner.search.exhaustive import exhaustive_search
from planner.search.paper import PaperSearch
from planner.search.problem import SearchProblem
from planner.search.result import Progress, SearchResult
from planner.search.tie_break import tie_break
from planner.task import make_task
from planner.terminal.command_line import ExitCode, parse, run
from planner.terminal.console import Console

ASSETS = Path(__file__).resolve().parents[1] / "assets"
PLANAR = {"convex": 56, "concave": 86}
"""Our planar objects and how many candidates they get."""

FRICTIONS = (0.1, 0.3, 0.5)
FINGERS = (2, 3)
SEARCHES: dict[str, PaperSearch | CertifiedSearch] = {
    "relaxation": PaperSearch(),
    "Subproblem 2": PaperSearch(bound="subproblem 2"),
    "certified": CertifiedSearch(),
}
"""The paper's algorithm, its variant, and ours, all to a relative gap of 1e-3."""

FEET = np.array([[0, -4 / 3, 0], [2 / 3, 2 / 3, 0], [-4 / 3, 0, 0]]) / 100
"""Feet of the perpendiculars from the prism's centroid to its three sides [m]."""


@dataclass(frozen=True, kw_only=True)
class Options:
    """Reproduce the numerical section of Watanabe and Yoshikawa: tables, running times and figures."""

    out: Path = Path("paper")
    """Folder for `paper.md` and the figures; made if missing."""

    quick: bool = False
    """Reduced candidates: every table and figure in about a minute."""

    quiet: Annotated[bool, tyro.conf.arg(aliases=["-q"])] = False
    """Print nothing but errors."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Case:
    """One object with one number of fingers and one friction coefficient."""

    name: str
    problem: SearchProblem


class Examined:
    """Combinations examined so far, of all that the tables need: where the time goes."""

    def __init__(self, console: Console, total: int) -> None:
        self._console, self._done, self._total = console, 0, total

    def begin(self, what: str, combinations: int) -> Callable[[Progress], None]:
        """So many more begin to be examined; returns what hears the search."""
        name, begun = f"combinations ({what})", self._done
        self._done += combinations

        def hear(line: Progress) -> None:
            self._console.count(name, begun + max(combinations - line.open, 0), self._total)

        self._console.count(name, begun, self._total)
        return hear


def planar_object(name: str) -> PlanarObject:
    """One of our planar objects."""
    return read_planar(ASSETS / "planar" / f"{name}.toml")


def prism() -> RigidObject:
    """The paper's triangular prism."""
    return read_object(ASSETS / "prism" / "prism.xml")


def planar_case(name: str, fingers: int, friction: float, *, quick: bool) -> Case:
    """One of our planar objects under the paper's rules."""
    target = planar_object(name)
    count = PLANAR[name] // 3 if quick else PLANAR[name]
    return make_case(f"{name}, {fingers} fingers", target, str(count), fingers, friction)


def prism_case(*, quick: bool) -> Case:
    """The paper's Case III; the quick one keeps every sixth candidate and the three optimal ones."""
    case = make_case("Case III, 3 fingers", prism(), "case3", 3, 0.3)
    if not quick:
        return case
    contacts = case.problem.contacts
    optimal = CertifiedSearch().run(case.problem).grasps[0].subset
    kept = np.union1d(np.arange(0, len(contacts), 6), optimal)
    return replace(case, problem=replace(case.problem, contacts=contacts.subset(kept)))


def make_case(name: str, target: Graspable, candidates: str, fingers: int, friction: float) -> Case:
    """The task is the paper's: weight in a box or disc, moment of 0.8 gamma times the weight."""
    task = make_task("paper", target)
    contacts = make_candidates(target, candidates, friction, seed=0).contacts
    problem = SearchProblem(
        contacts=contacts, fingers=fingers, reference_point=task.reference_point, wrenches=task.wrenches
    )
    return Case(name=name, problem=problem)


def best_of_ties(problem: SearchProblem) -> Evaluation:
    """The paper's optimal grasp: of all within 1e-6 of the optimum, the one that its tie-break prefers."""
    ties = CertifiedSearch(within=1e-6, keep=200).run(problem).grasps
    return tie_break(problem, ties)[0]


def prism_table(problem: SearchProblem, best: Evaluation, solved: int) -> Iterator[str]:
    """Case III beside the paper's figures."""
    contacts = problem.contacts.subset(best.subset)
    feet = Contacts(
        points=FEET, normals=np.array([[0, 1, 0], [-(0.5**0.5), -(0.5**0.5), 0], [1, 0, 0]]), friction=np.full(3, 0.3)
    )
    at_feet = Evaluator(replace(problem, contacts=feet)).evaluate(np.arange(3)).rho
    points = ", ".join("(" + ", ".join(f"{x:.4g}" for x in np.round(100 * point, 9)) + ")" for point in contacts.points)
    yield "## Case III\n"
    yield "| | paper | here |"
    yield "|---|---|---|"
    yield f"| rho* [N] | 0.669 | {best.rho:.5f} |"
    yield f"| optimal points [cm] | (2/9, -4/3, 0), (2/3, 2/3, 0), (-4/3, 2/9, 0) | {points} |"
    yield f"| rho at the feet of the perpendiculars [N] | 0.718 | {at_feet:.5f} |"
    yield f"| combinations | 1,679,580 | {problem.subsets:,} |"
    yield f"| of these solved exactly by the paper's algorithm | 21 | {solved} |\n"


def planar_tables(examined: Examined, *, quick: bool) -> Iterator[str]:
    """rho in the layout of the paper's Table 1, each value confirmed by enumeration."""
    yield "## Our planar cases (not the paper's: its outlines are only in its figures)\n"
    for name, count in PLANAR.items():
        yield f"### {name}: rho [N], {count // 3 if quick else count} candidates\n"
        yield "| µ | " + " | ".join(map(str, FRICTIONS)) + " |"
        yield "|---" * (1 + len(FRICTIONS)) + "|"
        for fingers in FINGERS:
            cases = [planar_case(name, fingers, friction, quick=quick) for friction in FRICTIONS]
            values = [agreed_rho(case, examined) for case in cases]
            yield f"| {fingers} fingers | " + " | ".join(f"{rho:.4g}" for rho in values) + " |"
        yield ""


def agreed_rho(case: Case, examined: Examined) -> float:
    """rho by the certified search and by enumeration of all combinations, which must agree."""
    examined.begin(f"{case.name}: enumeration", case.problem.subsets)
    rho = CertifiedSearch(gap=1e-4).run(case.problem).rho
    best = exhaustive_search(case.problem)
    if best is None or abs(best.rho / rho - 1) > 2e-4:
        raise SystemExit(f"{case.name}: enumeration disagrees about rho: {rho}, {best and best.rho}")
    return rho


def timed(case: Case, examined: Examined) -> dict[str, SearchResult]:
    """Every search on one case; the certified one examines too few combinations to count."""
    results = {}
    for name, search in SEARCHES.items():
        combinations = case.problem.subsets if isinstance(search, PaperSearch) else 0
        results[name] = search.run(case.problem, examined.begin(f"{case.name}: {name}", combinations))
    rho = [result.rho for result in results.values()]
    if max(rho) > min(rho) * (1 + 1e-3):
        raise SystemExit(f"{case.name}: the searches disagree about rho: {rho}")
    return results


def time_table(results: dict[str, dict[str, SearchResult]]) -> Iterator[str]:
    """Running times in one run, and their ratios to the certified search."""
    yield "## Running times [s], µ = 0.3, and combinations solved exactly\n"
    yield "| case | combinations | relaxation | solved | Subproblem 2 | solved | certified | ratios |"
    yield "|---" * 8 + "|"
    for name, runs in results.items():
        relaxed, exact, ours = (runs[search].trace[-1] for search in SEARCHES)
        yield (
            f"| {name} | {runs['certified'].problem.subsets:,} | {relaxed.seconds:.2f} | {relaxed.nodes} | "
            f"{exact.seconds:.2f} | {exact.nodes} | {ours.seconds:.3f} | "
            f"{relaxed.seconds / ours.seconds:.0f}, {exact.seconds / ours.seconds:.0f} |"
        )
    yield ""


def draw(out: Path, *, quick: bool) -> None:
    """Candidates (Fig. 2) and optimal grasps (Fig. 4 and 5) of the planar objects."""
    for name in PLANAR:
        cases = [planar_case(name, fingers, 0.3, quick=quick) for fingers in FINGERS]
        corners = planar_object(name).outline.corners
        figure = new_figure(10, 4)
        axes = figure.subplots(1, 1 + len(cases))
        draw_outline(axes[0], corners, cases[0].problem.contacts, None, "candidates")
        for panel, case in zip(axes[1:], cases, strict=True):
            best = best_of_ties(case.problem)
            contacts = case.problem.contacts
            title = f"{case.problem.fingers} fingers: rho = {best.rho:.3g} N"
            draw_outline(panel, corners, contacts, contacts.subset(best.subset), title)
        save_figure(out / f"{name}.png", figure)


def reproduce(options: Options, console: Console) -> ExitCode:
    """Everything, printed as it is done and saved at the end."""
    options.out.mkdir(parents=True, exist_ok=True)
    require_writable(options.out / "paper.md")
    quick = options.quick
    cases = [planar_case(name, fingers, 0.3, quick=quick) for name in PLANAR for fingers in FINGERS]
    case3 = prism_case(quick=quick)
    planar = sum(case.problem.subsets for case in cases)
    examined = Examined(console, 2 * (planar + case3.problem.subsets) + len(FRICTIONS) * planar)
    results = {case.name: timed(case, examined) for case in [*cases, case3]}
    best = best_of_ties(case3.problem)
    lines = ["# The paper, reproduced\n"]
    lines += ["Quick run on reduced candidates.\n"] if quick else []
    lines += prism_table(case3.problem, best, results[case3.name]["relaxation"].trace[-1].nodes)
    lines += [*planar_tables(examined, quick=quick), *time_table(results)]
    console.say("\n".join(lines))
    write_atomically(options.out / "paper.md", "\n".join(lines).encode())
    draw(options.out, quick=quick)
    contacts = case3.problem.contacts
    title = f"Case III: rho = {best.rho:.3f} N"
    save_figure(options.out / "prism.png", object_figure(prism(), contacts, contacts.subset(best.subset), title))
    return ExitCode.DONE


if __name__ == "__main__":
    options = parse(Options, "reproduce_paper.py")
    console = Console(quiet=options.quiet)
    run(lambda: reproduce(options, console), console)
