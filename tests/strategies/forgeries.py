"""Every field of a grasp file altered on purpose, and who notices: the table that the tests run.

Whoever forges a file knows the format: numbers that the file states twice are altered consistently where that is
possible at all.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

Document = dict[str, Any]

READING = "reading"
"""The file disagrees with itself: every command refuses it, exit 1."""

OBJECT = "object"
"""It does not belong to its object: grasp-verify says FAIL, grasp-validate refuses it."""

PROOF = "proof"
"""Forces, rho, bound or status are wrong: grasp-verify says FAIL. Where the forces are, MuJoCo measures it too."""

UNCHECKED = "unchecked"
"""It can no longer be checked, and grasp-verify has a line that says so."""

NOBODY = "nobody"
"""Nothing false has been said."""


@dataclass(frozen=True, kw_only=True)
class Forgery:
    """One lie."""

    name: str
    alter: Callable[[Document], None]
    noticed: str
    why: str = ""
    """Where nobody notices: why it does no harm."""


def put(path: str, value: Any) -> Callable[[Document], None]:
    """Sets a field, `a/b/0/c`; a function of the old value, or a value."""

    def alter(document: Document) -> None:
        *folders, last = [int(key) if key.isdigit() else key for key in path.split("/")]
        at: Any = document
        for key in folders:
            at = at[key]
        at[last] = value(at[last]) if callable(value) else value

    return alter


def drop(path: str) -> Callable[[Document], None]:
    """Deletes a field."""

    def alter(document: Document) -> None:
        *folders, last = path.split("/")
        at: Any = document
        for key in folders:
            at = at[key]
        del at[last]

    return alter


def both(*alterations: Callable[[Document], None]) -> Callable[[Document], None]:
    """One after the other."""

    def alter(document: Document) -> None:
        for each in alterations:
            each(document)

    return alter


def times(factor: float) -> Callable[[Any], Any]:
    """A number, or a list of them in lists, multiplied."""

    def scaled(value: Any) -> Any:
        return [scaled(each) for each in value] if isinstance(value, list) else factor * value

    return scaled


def plus(amount: float) -> Callable[[float], float]:
    return lambda value: value + amount


def loads(factor: float) -> Callable[[Document], None]:
    """Wrenches and everything that is proportional to them."""
    levels = [put(name, times(factor)) for name in ("forces", "phi", "rho", "lower_bound", "task/wrenches")]

    def alter_log(document: Document) -> None:
        for line in document["search"]["trace"]:
            line["lower_bound"] *= factor
            line["incumbent"] *= factor

    return both(*levels, alter_log)


def bound(factor: float) -> Callable[[Document], None]:
    """The bound, and the gap with it."""

    def alter(document: Document) -> None:
        document["lower_bound"] *= factor
        document["gap"] = document["rho"] / document["lower_bound"] - 1

    return alter


def close_gap(document: Document) -> None:
    document["lower_bound"], document["gap"] = document["rho"], 0.0


def chosen(document: Document) -> list[int]:
    return [contact["candidate"] for contact in document["contacts"]]


def others(document: Document) -> list[int]:
    """Numbers of the candidates that were not chosen."""
    return sorted(set(range(len(document["certificate"]["candidates"]["friction"]))) - set(chosen(document)))


def keep(document: Document, kept: list[int]) -> None:
    """Only these candidates, and every count to match."""
    candidates = document["certificate"]["candidates"]
    for name in candidates:
        candidates[name] = [candidates[name][index] for index in kept]
    for contact in document["contacts"]:
        contact["candidate"] = kept.index(contact["candidate"])
    count(document, len(kept))


def count(document: Document, number: int) -> None:
    document["search"]["candidates"] = number
    document["search"]["subsets"] = number * (number - 1) * (number - 2) // 6


def thin_quietly(document: Document) -> None:
    number = document["search"]["candidates"]
    thin_consistently(document)
    document["search"]["candidates"] = number


def thin_consistently(document: Document) -> None:
    keep(document, sorted(chosen(document) + others(document)[::3]))


def thin_and_say_so(document: Document) -> None:
    thin_consistently(document)
    document["candidate_choice"]["candidates"] = str(document["search"]["candidates"])


def thin_in_another_version(document: Document) -> None:
    thin_consistently(document)
    document["planner"]["version"] = document["planner"]["packages"]["rhograsp"] = "9.9"


def weaken(document: Document) -> None:
    for index in others(document):
        document["certificate"]["candidates"]["friction"][index] = 0.05


def weaken_and_say_so(document: Document) -> None:
    """The chosen ones too, and the choice says so; the forces stay."""
    weaken(document)
    document["candidate_choice"]["friction"] = 0.05


def strengthen(document: Document) -> None:
    """The friction of the contacts, of their candidates with them."""
    for contact in document["contacts"]:
        contact["friction"] *= 1.5
        document["certificate"]["candidates"]["friction"][contact["candidate"]] *= 1.5


def turn_normals(document: Document) -> None:
    for index in others(document):
        document["certificate"]["candidates"]["normals"][index] = [0.6, 0.0, 0.8]


def repeat_candidate(document: Document) -> None:
    """One that was not chosen becomes a copy of another such."""
    candidates, (first, second, *_) = document["certificate"]["candidates"], others(document)
    for values in candidates.values():
        values[first] = values[second]


def add_candidate(document: Document) -> None:
    """A copy of the last one that was not chosen, at the end."""
    for values in document["certificate"]["candidates"].values():
        values.append(values[others(document)[-1]])
    count(document, len(document["certificate"]["candidates"]["friction"]))


def shift(document: Document) -> None:
    """Contacts, candidates and the reference point by 1 cm: wrenches, forces and proof stay true of each other."""
    points = [contact["position"] for contact in document["contacts"]]
    points += [*document["certificate"]["candidates"]["positions"], document["task"]["reference_point"]]
    for point in points:
        point[0] += 0.01


def shift_with_the_object(document: Document) -> None:
    shift(document)
    document["object"]["center_of_mass"][0] += 0.01


def shift_others(document: Document) -> None:
    for index in others(document):
        document["certificate"]["candidates"]["positions"][index][2] += 1e-3


def swap_contacts(document: Document) -> None:
    first, second, *rest = document["contacts"]
    document["contacts"] = [second, first, *rest]


def swap_geoms(document: Document) -> None:
    for contact in document["contacts"]:
        contact["geom"] = "head" if contact["geom"] == "handle" else "handle"


def lose_wrench(document: Document) -> None:
    """The one with the largest phi is the critical one; another goes, with its forces."""
    last = next(row for row in range(len(document["phi"]) - 1, -1, -1) if row != document["critical_wrench"])
    for rows in (document["phi"], document["forces"], document["task"]["wrenches"]):
        del rows[last]
    document["critical_wrench"] -= last < document["critical_wrench"]


def repeat_wrench(document: Document) -> None:
    for rows in (document["phi"], document["forces"], document["task"]["wrenches"]):
        rows.append(rows[0 if document["critical_wrench"] else 1])


def push_harder(document: Document) -> None:
    """All forces, phi, rho and the bound, but not the wrenches."""
    for name in ("forces", "phi", "rho", "lower_bound"):
        put(name, times(1.2))(document)


def own_task(document: Document) -> None:
    document["task"] |= {"name": "mine", "preset": None}


KIND = {"fingers": 3, "candidates": 24, "strength": 1.0}

FORGERIES = (
    Forgery(name="format", alter=put("format", "other"), noticed=READING),
    Forgery(name="format version", alter=put("format_version", 99), noticed=READING),
    # The object.
    Forgery(name="object: another path", alter=put("object/mjcf", "nowhere.xml"), noticed=UNCHECKED),
    Forgery(name="object: sha256", alter=put("object/sha256", 64 * "0"), noticed=OBJECT),
    Forgery(name="object: another body", alter=put("object/body", "peg"), noticed=OBJECT),
    Forgery(name="object: no such body", alter=put("object/body", "anvil"), noticed=OBJECT),
    Forgery(name="object: a keyframe", alter=put("object/keyframe", "home"), noticed=READING),
    Forgery(name="object: a locked joint", alter=put("object/locked_joints", ["hinge"]), noticed=OBJECT),
    Forgery(name="object: mass doubled", alter=put("object/mass", times(2)), noticed=OBJECT),
    Forgery(name="object: centre of mass moved", alter=put("object/center_of_mass/0", plus(0.01)), noticed=OBJECT),
    Forgery(name="object: centre in the plane", alter=put("object/center_of_mass", [0.0, 0.0]), noticed=READING),
    Forgery(
        name="object: centre of mass forgotten",
        alter=drop("object/center_of_mass"),
        noticed=NOBODY,
        why="it follows from the object, whose files are the same, and the task is made from that one",
    ),
    Forgery(name="object: a mass given", alter=put("object/given_mass", 0.6), noticed=OBJECT),
    Forgery(
        name="object: a mass given, and stated",
        alter=both(put("object/given_mass", 0.6), put("object/mass", 0.6)),
        noticed=OBJECT,
    ),
    Forgery(
        name="object: a mass given, stated, and all loads with it",
        alter=both(put("object/given_mass", 0.6), put("object/mass", 0.6), loads(2)),
        noticed=NOBODY,
        why="it is what grasp-plan --mass 0.6 plans, and grasp-verify says that the mass was given",
    ),
    Forgery(
        name="object: a centre of mass given",
        alter=put("object/given_center_of_mass", [0.0, 0.0, 0.0]),
        noticed=OBJECT,
    ),
    Forgery(
        name="object: a centre of mass given, and stated",
        alter=both(put("object/given_center_of_mass", [0.0, 0.0, 0.0]), put("object/center_of_mass", [0.0, 0.0, 0.0])),
        noticed=OBJECT,
    ),
    # The task.
    Forgery(name="task: another name", alter=put("task/name", "gravity"), noticed=OBJECT),
    Forgery(name="task: another preset", alter=put("task/preset", "gravity"), noticed=OBJECT),
    Forgery(
        name="task: another preset and its name",
        alter=both(put("task/preset", "paper"), put("task/name", "paper")),
        noticed=OBJECT,
    ),
    Forgery(name="task: no such preset", alter=put("task/preset", "axes7"), noticed=OBJECT),
    Forgery(
        name="task: preset forgotten",
        alter=drop("task/preset"),
        noticed=NOBODY,
        why="the name of a preset is taken at its word",
    ),
    Forgery(
        name="task: preset forgotten, loads a tenth",
        alter=both(drop("task/preset"), loads(0.1)),
        noticed=OBJECT,
    ),
    Forgery(name="task: preset forgotten, another name", alter=own_task, noticed=UNCHECKED),
    Forgery(
        name="task: preset forgotten, another name, loads a tenth",
        alter=both(own_task, loads(0.1)),
        noticed=UNCHECKED,
    ),
    Forgery(
        name="task: also of a file that is not there",
        alter=put("task/file", {"path": "nowhere.toml", "sha256": 64 * "0"}),
        noticed=NOBODY,
        why="the preset is what is made again",
    ),
    Forgery(name="task: reference point moved", alter=put("task/reference_point/2", plus(0.01)), noticed=OBJECT),
    Forgery(name="task: wrenches a tenth", alter=put("task/wrenches", times(0.1)), noticed=OBJECT),
    Forgery(name="task: all loads a tenth", alter=loads(0.1), noticed=OBJECT),
    Forgery(name="task: all loads halved", alter=loads(0.5), noticed=OBJECT),
    Forgery(name="task: all loads 0.001 % less", alter=loads(1 - 1e-5), noticed=OBJECT),
    Forgery(name="task: a moment added", alter=put("task/wrenches/0/3", 0.01), noticed=OBJECT),
    Forgery(name="task: a wrench lost", alter=lose_wrench, noticed=OBJECT),
    Forgery(name="task: a wrench repeated", alter=repeat_wrench, noticed=OBJECT),
    # The contacts.
    Forgery(name="contact: position", alter=put("contacts/0/position/1", plus(1e-3)), noticed=READING),
    Forgery(name="contact: normal", alter=put("contacts/0/normal", [0.6, 0.0, 0.8]), noticed=READING),
    Forgery(name="contact: no unit normal", alter=put("contacts/0/normal", [0.5, 0.5, 0.5]), noticed=READING),
    Forgery(name="contact: friction", alter=put("contacts/0/friction", 1.2), noticed=READING),
    Forgery(name="contact: geom", alter=put("contacts/0/geom", "peg"), noticed=OBJECT),
    Forgery(name="contact: geoms swapped", alter=swap_geoms, noticed=OBJECT),
    Forgery(name="contact: candidate", alter=put("contacts/0/candidate", times(0)), noticed=READING),
    Forgery(name="contact: strength", alter=put("contacts/0/strength", 2.0), noticed=READING),
    Forgery(name="contact: friction of its candidate too", alter=strengthen, noticed=OBJECT),
    Forgery(name="contacts swapped, forces not", alter=swap_contacts, noticed=PROOF),
    Forgery(name="a contact lost", alter=lambda document: document["contacts"].pop(), noticed=READING),
    # Levels and forces.
    Forgery(name="rho halved", alter=put("rho", times(0.5)), noticed=READING),
    Forgery(name="gap", alter=put("gap", 1e-9), noticed=READING),
    Forgery(name="critical wrench", alter=put("critical_wrench", lambda row: (row + 1) % 6), noticed=READING),
    Forgery(name="a phi", alter=put("phi/0", times(0.5)), noticed=READING),
    Forgery(name="phi and rho halved", alter=both(put("phi", times(0.5)), put("rho", times(0.5))), noticed=READING),
    Forgery(name="forces, phi, rho and bound 20 % more", alter=push_harder, noticed=PROOF),
    Forgery(name="a force turned round", alter=put("forces/0/0", times(-1)), noticed=PROOF),
    Forgery(name="forces of a wrench turned round", alter=put("forces/0", times(-1)), noticed=PROOF),
    Forgery(name="bound above rho", alter=bound(1.01), noticed=READING),
    Forgery(name="bound as large as rho", alter=close_gap, noticed=PROOF),
    Forgery(
        name="bound 0.01 % less",
        alter=bound(0.9999),
        noticed=NOBODY,
        why="a smaller bound is true too, and the gap says so",
    ),
    Forgery(name="bound 1 % less, and still optimal", alter=bound(0.99), noticed=PROOF),
    Forgery(name="no bound, and still optimal", alter=bound(1e-9), noticed=PROOF),
    Forgery(name="status infeasible", alter=put("status", "infeasible"), noticed=PROOF),
    Forgery(
        name="status time limit",
        alter=put("status", "time_limit"),
        noticed=NOBODY,
        why="it says less than the bound proves",
    ),
    # How the candidates were chosen.
    Forgery(name="choice: forgotten", alter=drop("candidate_choice"), noticed=UNCHECKED),
    Forgery(name="choice: one more", alter=put("candidate_choice/candidates", "25"), noticed=OBJECT),
    Forgery(name="choice: a grid", alter=put("candidate_choice/candidates", "grid:0.01"), noticed=OBJECT),
    Forgery(name="choice: the paper's", alter=put("candidate_choice/candidates", "case3"), noticed=OBJECT),
    Forgery(name="choice: a file", alter=put("candidate_choice/candidates", "points.csv"), noticed=UNCHECKED),
    Forgery(
        name="choice: a file that is not there",
        alter=put("candidate_choice/file", {"path": "nowhere.csv", "sha256": 64 * "0"}),
        noticed=NOBODY,
        why="a number of points needs no file, and is what is chosen again",
    ),
    Forgery(name="choice: friction given", alter=put("candidate_choice/friction", 0.5), noticed=OBJECT),
    Forgery(name="choice: friction error", alter=put("candidate_choice/friction_error", 0.1), noticed=OBJECT),
    Forgery(name="choice: error out of range", alter=put("candidate_choice/friction_error", 2.0), noticed=OBJECT),
    Forgery(name="choice: fingertip", alter=put("candidate_choice/fingertip", 0.02), noticed=OBJECT),
    Forgery(name="choice: seed", alter=put("candidate_choice/seed", 1), noticed=OBJECT),
    Forgery(
        name="choice: not confirmed",
        alter=put("candidate_choice/confirmed", False),
        noticed=NOBODY,
        why="MuJoCo confirms them all: the same candidates come out",
    ),
    Forgery(
        name="choice: confirmed or not forgotten",
        alter=drop("candidate_choice/confirmed"),
        noticed=NOBODY,
        why="none is missing of all the candidates that there could be",
    ),
    Forgery(name="choice: within limits of one's own", alter=put("candidate_choice/limited", True), noticed=UNCHECKED),
    Forgery(
        name="choice: within limits of a file that is not there",
        alter=put("candidate_choice/limits", {"path": "nowhere.toml", "sha256": 64 * "0"}),
        noticed=UNCHECKED,
    ),
    # The candidates.
    Forgery(name="candidates: others weakened", alter=weaken, noticed=OBJECT),
    Forgery(name="candidates: others weakened, choice too", alter=weaken_and_say_so, noticed=OBJECT),
    Forgery(name="candidates: two thirds deleted, count not", alter=thin_quietly, noticed=READING),
    Forgery(name="candidates: two thirds deleted", alter=thin_consistently, noticed=OBJECT),
    Forgery(name="candidates: two thirds deleted, choice too", alter=thin_and_say_so, noticed=OBJECT),
    Forgery(name="candidates: two thirds deleted, another version", alter=thin_in_another_version, noticed=UNCHECKED),
    Forgery(name="candidates: one repeated for another", alter=repeat_candidate, noticed=OBJECT),
    Forgery(name="candidates: one added", alter=add_candidate, noticed=OBJECT),
    Forgery(name="candidates: others' normals turned", alter=turn_normals, noticed=OBJECT),
    Forgery(name="candidates: others moved 1 mm", alter=shift_others, noticed=OBJECT),
    Forgery(name="candidates, contacts and reference point moved 1 cm", alter=shift, noticed=OBJECT),
    Forgery(name="and the centre of mass with them", alter=shift_with_the_object, noticed=OBJECT),
    # The proof.
    Forgery(name="cuts: half of them lost", alter=put("certificate/cuts", lambda cuts: cuts[::2]), noticed=PROOF),
    Forgery(name="cuts: turned round", alter=put("certificate/cuts", times(-1)), noticed=PROOF),
    Forgery(
        name="cuts: scaled",
        alter=put("certificate/cuts", times(3)),
        noticed=NOBODY,
        why="a direction of any length proves the same",
    ),
    Forgery(name="cuts: none", alter=put("certificate/cuts", []), noticed=PROOF),
    Forgery(name="proof check: more than all", alter=put("proof_check/share", 1.5), noticed=READING),
    Forgery(name="proof check: less than nothing", alter=put("proof_check/share", -0.1), noticed=READING),
    Forgery(name="proof check: in no time", alter=put("proof_check/seconds", -1.0), noticed=READING),
    Forgery(
        name="proof check: halved",
        alter=put("proof_check/share", 0.5),
        noticed=NOBODY,
        why="history; grasp-verify checks the whole proof, whatever was checked before",
    ),
    Forgery(name="proof check: forgotten", alter=put("proof_check", None), noticed=NOBODY, why="history, no claim"),
    Forgery(
        name="proof check: all of a proof that lost its cuts",
        alter=both(put("certificate/cuts", lambda cuts: cuts[::2]), put("proof_check/share", 1.0)),
        noticed=PROOF,
    ),
    Forgery(name="kinds: one that says nothing new", alter=put("certificate/kinds", [KIND]), noticed=OBJECT),
    Forgery(name="kinds: strong", alter=put("certificate/kinds", [KIND | {"strength": 2.0}]), noticed=READING),
    Forgery(name="spacing", alter=put("certificate/spacing", 0.005), noticed=OBJECT),
    Forgery(name="span", alter=put("certificate/span", 0.1), noticed=OBJECT),
    # The search and what made the file.
    Forgery(name="search: method", alter=put("search/method", "luck"), noticed=NOBODY, why="nothing follows from it"),
    Forgery(name="search: fingers", alter=put("search/fingers", 4), noticed=READING),
    Forgery(name="search: candidates", alter=put("search/candidates", 300), noticed=READING),
    Forgery(name="search: subsets", alter=put("search/subsets", 3000), noticed=READING),
    Forgery(name="search: nodes", alter=put("search/nodes", plus(1)), noticed=READING),
    Forgery(name="search: cone programs", alter=put("search/socp_solves", plus(1)), noticed=READING),
    Forgery(name="search: cuts", alter=put("search/cuts", plus(1)), noticed=READING),
    Forgery(name="search: seconds", alter=put("search/seconds", times(0.5)), noticed=READING),
    Forgery(name="search: seed", alter=put("search/seed", 7), noticed=NOBODY, why="another seed, the same proof"),
    Forgery(name="search: gap asked for", alter=put("search/gap", 0.5), noticed=NOBODY, why="the gap itself stays"),
    Forgery(
        name="search: gap asked for, smaller than the gap",
        alter=both(put("search/gap", 1e-9), bound(0.9999)),
        noticed=PROOF,
    ),
    Forgery(name="search: log forgotten", alter=put("search/trace", []), noticed=NOBODY, why="history, no claim"),
    Forgery(
        name="search: log embellished",
        alter=put("search/trace/0/incumbent", times(2)),
        noticed=NOBODY,
        why="history, no claim",
    ),
    Forgery(name="version", alter=put("planner/version", "9.9"), noticed=READING),
    Forgery(
        name="versions of packages",
        alter=put("planner/packages/mujoco", "3.0"),
        noticed=NOBODY,
        why="whatever made it, the same candidates come out and the same claims are checked",
    ),
    Forgery(name="command", alter=put("planner/command", "rm"), noticed=NOBODY, why="nobody runs it"),
)
