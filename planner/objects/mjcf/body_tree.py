"""Which bodies of a compiled model are one object, and whether they are one rigid thing.

Bodies are tied to each other by the kinematic tree and by equality constraints. What is tied to nothing but the world
is an object; what is tied without a joint, or by joints that are locked, is rigid.
"""

import shlex
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from planner.arrays import Floats, Indices, Mask
from planner.errors import ObjectError
from planner.objects.object_source import ALL_JOINTS

WORLD = 0

FREE = 6
"""Degrees of freedom of a body that moves freely."""


class Tie(NamedTuple):
    """Two bodies and the joints by which they move relative to each other; none where they are fixed."""

    one: int
    other: int
    joints: tuple[str, ...]


@dataclass(frozen=True, eq=False, kw_only=True)
class BodyTree:
    """The bodies of a model; body 0 is the world, and a parent always comes before its children."""

    names: tuple[str, ...]
    """Name of each body, `body<id>` where it has none."""

    parents: Indices
    """Parent of each body, shape (bodies,)."""

    joints: tuple[tuple[str, ...], ...]
    """Names of the joints between each body and its parent."""

    freedoms: Indices
    """Degrees of freedom of each body relative to its parent, shape (bodies,)."""

    constraints: tuple[Tie, ...]
    """Equality constraints that tie bodies to each other."""

    masses: Floats
    """Mass of each body without its children, shape (bodies,) [kg]."""

    colliding_geoms: Indices
    """Number of geoms, planes left out, with which each body collides, shape (bodies,)."""

    def choose(self, name: str | None) -> int:
        """The body to plan on: the one named, or the outermost of the only candidate.

        A candidate is a group of tied bodies that collides, so that wrapper bodies are floated together with what
        they hold. Among several candidates, the only one with joints is the object.

        Raises:
            ObjectError: If there is no such body, none that collides, or several candidates.
        """
        root = self._only_candidate() if name is None else self._named(name)
        if not self.colliding_geoms[self.tied(root)].any():
            raise ObjectError(
                f"nothing of body '{self.names[root]}' collides: contype and conaffinity of all its geoms are 0 "
                "(or they are planes); give it collision geoms"
            )
        return root

    def rigid(self, root: int, locked: tuple[str, ...]) -> list[int]:
        """The bodies of the object: all that are tied to `root`, in the order of their numbers.

        Args:
            root: The body chosen.
            locked: Joints that are frozen, by name, or ALL_JOINTS.

        Raises:
            ObjectError: If some of them, by geoms or by mass, move relative to each other, or a joint is not there.
        """
        tied = self.tied(root)
        self._require_joints(tied, locked)
        solid = [body for body in tied if self._solid[body]]
        anchor = root if self._solid[root] else solid[0]
        together = self._reached(anchor, [tie for tie in self._ties if not _moving(tie, locked)])
        loose = [body for body in solid if body not in together]
        if loose:
            raise ObjectError(self._articulated(anchor, tied, loose, locked))
        return tied

    def below(self, root: int) -> list[int]:
        """`root` and what is tied to it other than by its parent, in the order of their numbers."""
        up = {root, int(self.parents[root])}
        return sorted(self._reached(root, [tie for tie in self._ties if {tie.one, tie.other} != up]))

    def tied(self, body: int) -> list[int]:
        """All bodies that are tied to a body, directly or not, fixed or by joints, in the order of their numbers."""
        return sorted(self._reached(body, self._ties))

    @cached_property
    def _solid(self) -> Mask:
        """Which bodies have mass or collide, shape (bodies,)."""
        return (self.colliding_geoms > 0) | (self.masses > 0)

    @cached_property
    def _ties(self) -> tuple[Tie, ...]:
        children = [body for body in range(1, len(self.parents)) if self.parents[body] != WORLD]
        kept = [Tie(int(self.parents[body]), body, self.joints[body]) for body in children if not self._is_free(body)]
        return *kept, *self.constraints

    def _is_free(self, body: int) -> bool:
        """Whether a body moves freely beside something solid; wrappers around it are no more than its name."""
        if self.freedoms[body] < FREE:
            return False
        top = body
        while self.parents[top] != WORLD:
            top = int(self.parents[top])
        return bool(self._solid[sorted(self._subtree(top) - self._subtree(body))].any())

    def _subtree(self, root: int) -> set[int]:
        inside = {root}
        for body in range(root + 1, len(self.parents)):
            if int(self.parents[body]) in inside:
                inside.add(body)
        return inside

    def _reached(self, start: int, ties: Iterable[Tie]) -> set[int]:
        neighbours: dict[int, list[int]] = {}
        for one, other, _ in ties:
            neighbours.setdefault(one, []).append(other)
            neighbours.setdefault(other, []).append(one)
        reached, waiting = {start}, [start]
        while waiting:
            new = [body for body in neighbours.get(waiting.pop(), ()) if body not in reached]
            reached.update(new)
            waiting += new
        return reached

    def _listed(self, bodies: Iterable[int]) -> str:
        return ", ".join(f"'{self.names[body]}'" for body in bodies) or "none"

    def _only_candidate(self) -> int:
        groups: dict[int, list[int]] = {}
        seen: set[int] = set()
        for body in range(1, len(self.parents)):
            if body not in seen:
                groups[body] = self.tied(body)
                seen.update(groups[body])
        candidates = [body for body, group in groups.items() if self.colliding_geoms[group].any()]
        if not candidates and self.colliding_geoms[WORLD]:
            raise ObjectError(
                "the collision geoms lie straight in the worldbody, where they have neither mass nor a frame; "
                "wrap them in a <body>"
            )
        if not candidates:
            raise ObjectError("no body of the file collides: contype and conaffinity of all geoms are 0")
        movable = [body for body in candidates if self.freedoms[groups[body]].any()]
        chosen = movable if len(candidates) > 1 and len(movable) == 1 else candidates
        if len(chosen) > 1:
            raise ObjectError(
                f"the file holds several objects: bodies {self._listed(candidates)}; "
                "choose one of them with --body NAME"
            )
        return chosen[0]

    def _named(self, name: str) -> int:
        bodies = [body for body in range(len(self.names)) if self.names[body] == name and body != WORLD]
        if not bodies:
            everything = range(1, len(self.names))
            raise ObjectError(f"there is no body named '{name}' to plan on; the file has {self._listed(everything)}")
        return bodies[0]

    def _require_joints(self, bodies: list[int], locked: tuple[str, ...]) -> None:
        known = [joint for tie in self._ties if tie.one in bodies for joint in tie.joints]
        unknown = [joint for joint in locked if joint not in (*known, ALL_JOINTS)]
        if unknown:
            listed = ", ".join(f"'{joint}'" for joint in known) or "none"
            raise ObjectError(
                f"--lock-joints names '{unknown[0]}', which is no joint between the bodies of the object; "
                f"these are: {listed}"
            )

    def _articulated(self, anchor: int, tied: list[int], loose: list[int], locked: tuple[str, ...]) -> str:
        moving = [joint for tie in self._ties if tie.one in tied for joint in tie.joints]
        names = shlex.join(dict.fromkeys((*locked, *moving)))
        return (
            f"body '{self.names[anchor]}' is articulated: joints let {self._listed(loose)} move relative to it, with "
            f"{self.masses[loose].sum():.4g} kg and {self.colliding_geoms[loose].sum()} colliding geoms; freeze them "
            f"into one rigid object with --lock-joints {names} (or all; at qpos0, or where --keyframe NAME puts them), "
            "or remove these joints from the file"
        )


def _moving(tie: Tie, locked: tuple[str, ...]) -> bool:
    return ALL_JOINTS not in locked and any(joint not in locked for joint in tie.joints)
