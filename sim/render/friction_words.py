"""The friction of a grasp in words, as pictures and the live view show it."""

from planner.contacts import Contacts
from planner.millimetres import in_mm


def friction_words(contacts: Contacts) -> str:
    """For example "friction 0.3 to 0.5", with soft fingers "friction 0.5 · torsion 1.33 mm"."""
    friction = _spread([f"{mu:g}" for mu in sorted(contacts.friction.tolist())])
    if not contacts.torsions.any():
        return f"friction {friction}"
    torsion = _spread([in_mm(gamma, 3) for gamma in sorted(contacts.torsions.tolist())])
    return f"friction {friction} · torsion {torsion} mm"


def _spread(values: list[str]) -> str:
    """The first and the last; one where they are the same."""
    return " to ".join(dict.fromkeys((values[0], values[-1])))
