"""Which contact model a set of contacts is of, and what follows from that."""

from planner.contact_models.contact_model import ContactModel
from planner.contact_models.hard_finger import HARD_FINGER
from planner.contacts import Contacts


def model_of(contacts: Contacts) -> ContactModel:
    """The simplest model that all the contacts are of; what has no torsional friction is a hard finger."""
    return HARD_FINGER


def free_to_turn(contacts: Contacts, fingers: int) -> bool:
    """Whether so many of the contacts always leave the object free to turn about a line.

    Two in space do, about the line through them, unless a finger can twist: then it has more components than space.
    """
    in_space = contacts.dimension == 3
    return fingers == 2 and in_space and model_of(contacts).components(contacts.dimension) == contacts.dimension
