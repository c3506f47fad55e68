"""Candidates that MuJoCo confirms: where it collides, with the normal it will report, and clear of other parts."""

from dataclasses import dataclass

import numpy as np

from planner.candidates.candidates import Candidates
from planner.errors import CandidateError
from planner.millimetres import in_mm
from planner.objects.mjcf.collision import measure_collision
from planner.objects.rigid_object import RigidObject


@dataclass(frozen=True, eq=False, kw_only=True)
class Confirmed:
    """The confirmed candidates, and how the others failed."""

    candidates: Candidates

    asked: Candidates
    """All that were to be confirmed."""

    off_surface: int
    """How many were left out because MuJoCo's surface is elsewhere."""

    turned: int
    """How many were left out because MuJoCo's normal is another."""

    crowded: int
    """How many were left out because even a tiny ball there touches another part."""

    largest_height: float
    """Largest distance of a confirmed candidate from MuJoCo's surface [m]."""

    largest_turn: float
    """Largest angle of a confirmed candidate's normal to MuJoCo's [rad]."""

    @property
    def dropped(self) -> int:
        """How many were left out."""
        return self.off_surface + self.turned + self.crowded


def confirmed_candidates(rigid_object: RigidObject, candidates: Candidates) -> Confirmed:
    """Leave out the candidates that MuJoCo does not confirm; each counts for its first failure.

    Args:
        rigid_object: The object; its file is compiled again.
        candidates: On its surface.

    Raises:
        CandidateError: If none is confirmed.
        ObjectError: If the object's file cannot be compiled any more.
    """
    contacts = candidates.contacts
    touch = measure_collision(rigid_object, contacts.points, contacts.normals, candidates.part)
    own = (np.arange(len(candidates)), candidates.part)
    off, heights, turns = ~touch.on_surface[own], touch.gaps[own], touch.turns[own]
    turned = ~off & ~touch.aligned[own]
    crowded = ~off & ~turned & touch.walls.any(axis=1)
    kept = np.flatnonzero(~(off | turned | crowded))
    if not len(kept):
        raise CandidateError(
            f"MuJoCo confirms none of the {len(candidates)} candidates: {off.sum()} are off its surface (the first by "
            f"{in_mm(heights[0], 2)} mm), {turned.sum()} have another normal, {crowded.sum()} touch another part; "
            "grasp-inspect shows the object as MuJoCo collides it"
        )
    return Confirmed(
        candidates=candidates.kept(kept, confirmed=True),
        asked=candidates,
        off_surface=int(off.sum()),
        turned=int(turned.sum()),
        crowded=int(crowded.sum()),
        largest_height=float(np.abs(heights[kept]).max()),
        largest_turn=float(turns[kept].max()),
    )
