"""What every candidate can do along one direction of wrench space, by the loop of its contact model."""

from collections.abc import Callable
from functools import cache
from typing import Any

from planner.contact_models.contact_model import ContactModel
from planner.search.compiled.compile import compiled


@cache
def compiled_capacities(model: ContactModel) -> Callable[..., Any]:
    """`ContactModel.capacities`, compiled."""
    return compiled("(f8[:, :, ::1], f8[::1], f8[::1], f8[::1])")(model.capacities)
