"""What MuJoCo measures of a planned grasp: `sim.validate(planner.read_object(file), grasp).verdict`."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from sim.validation.validation import Validation, validate

__all__ = ["Validation", "validate"]


def __getattr__(name: str) -> Any:
    if name not in __all__:
        raise AttributeError(f"module 'sim' has no attribute {name!r}; it has {', '.join(__all__)}")
    return getattr(import_module("sim.validation.validation"), name)
