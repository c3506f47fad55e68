"""The contact models by name, and which one a set of contacts is of."""

from planner.contact_models.contact_model import ContactModel
from planner.contact_models.hard_finger import HARD_FINGER
from planner.contacts import Contacts

MODELS: dict[str, ContactModel] = {model.name: model for model in (HARD_FINGER,)}
"""To add one: write its file and name it here."""


def model_of(contacts: Contacts) -> ContactModel:
    """The simplest model that all the contacts are of; what has no torsional friction is a hard finger."""
    return HARD_FINGER
