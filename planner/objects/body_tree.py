"""Which body of a compiled model is the object, and whether it is one rigid thing."""

from dataclasses import dataclass

import numpy as np

from planner.errors import ObjectError

WORLD = 0


@dataclass(frozen=True, eq=False, kw_only=True)
class BodyTree:
    """The bodies of a model; body 0 is the world, and a parent always comes before its children."""

    names: tuple[str, ...]
    """Name of each body, `body<id>` where it has none."""

    parents: np.ndarray
    """Parent of each body, shape (bodies,)."""

    joints: np.ndarray
    """Number of joints between each body and its parent, shape (bodies,)."""

    rigid_groups: np.ndarray
    """Bodies with equal entries cannot move relative to each other, shape (bodies,)."""

    masses: np.ndarray
    """Mass of each body without its children, shape (bodies,) [kg]."""

    colliding_geoms: np.ndarray
    """Number of geoms, planes left out, with which each body collides, shape (bodies,)."""

    def subtree(self, root: int) -> list[int]:
        """`root` and all its descendants, in the order of their numbers."""
        inside = {root}
        for body in range(root + 1, len(self.parents)):
            if int(self.parents[body]) in inside:
                inside.add(body)
        return sorted(inside)

    def choose(self, name: str | None) -> int:
        """The body to plan on: the one named, or the only candidate.

        A candidate is a child of the world whose subtree collides, so that wrapper bodies are floated together
        with what they hold. Among several candidates, the only one with joints is the object.

        Raises:
            ObjectError: If there is no such body, none that collides, several candidates, or an articulated one.
        """
        root = self._only_candidate() if name is None else self._named(name)
        if not self.colliding_geoms[self.subtree(root)].any():
            raise ObjectError(
                f"nothing of body '{self.names[root]}' collides: contype and conaffinity of all its geoms are 0 "
                "(or they are planes); give it collision geoms"
            )
        self._require_rigid(root)
        return root

    def _candidates(self) -> list[int]:
        children = [body for body in range(1, len(self.parents)) if self.parents[body] == WORLD]
        return [body for body in children if self.colliding_geoms[self.subtree(body)].any()]

    def _listed(self, bodies: list[int]) -> str:
        return ", ".join(f"'{self.names[body]}'" for body in bodies) or "none"

    def _only_candidate(self) -> int:
        candidates = self._candidates()
        if not candidates and self.colliding_geoms[WORLD]:
            raise ObjectError(
                "the collision geoms lie straight in the worldbody, where they have neither mass nor a frame; "
                "wrap them in a <body>"
            )
        if not candidates:
            raise ObjectError("no body of the file collides: contype and conaffinity of all geoms are 0")
        movable = [body for body in candidates if self.joints[self.subtree(body)].any()]
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
            everything = list(range(1, len(self.names)))
            raise ObjectError(f"there is no body named '{name}' to plan on; the file has {self._listed(everything)}")
        return bodies[0]

    def _require_rigid(self, root: int) -> None:
        """Refuse a subtree whose parts, by geoms or by mass, move relative to each other."""
        substantial = [body for body in self.subtree(root) if self.colliding_geoms[body] or self.masses[body] > 0]
        first = self.rigid_groups[substantial[0]]
        loose = [body for body in substantial if self.rigid_groups[body] != first]
        if loose:
            raise ObjectError(
                f"body '{self.names[root]}' is articulated: joints let {self._listed(loose)} move relative to "
                f"'{self.names[substantial[0]]}'; remove these joints, or choose one rigid part with --body NAME"
            )
