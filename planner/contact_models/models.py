"""Which contact model a set of contacts is of, and what follows from that."""

from planner.contact_models.contact_model import ContactModel
from planner.contact_models.hard_finger import HARD_FINGER
from planner.contact_models.soft_finger import SOFT_FINGER
from planner.contacts import Contacts


def model_of(contacts: Contacts) -> ContactModel:
    """The simplest model that all the contacts are of; without torsional friction a finger is hard."""
    return SOFT_FINGER if contacts.torsions.any() else HARD_FINGER


def free_to_turn(contacts: Contacts, fingers: int) -> bool:
    """Whether some so many of the contacts leave the object free to turn about a line.

    Two hard ones in space do, about the line through them.
    """
    return fingers == 2 and contacts.dimension == 3 and int((contacts.torsions == 0).sum()) >= 2
