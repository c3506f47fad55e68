"""How the loops are compiled: once per machine, without the interpreter's lock, with a word to whoever waits."""

import logging
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

from numba import njit

from planner.contact_models.contact_model import ContactModel

logger = logging.getLogger(__name__)


@cache
def _announce() -> None:
    """Said once, however many functions follow."""
    logger.info("compiling the search, once on this machine; a few seconds")


def compiled(signature: str, reorder: bool = False) -> Callable[[Callable[..., Any]], Any]:
    """Decorator: compile a function for one signature, and keep the result beside its file where that is possible.

    Args:
        signature: Types of the result and the arguments, as Numba writes them.
        reorder: Whether sums and minima may be taken in any order, which lets the processor do several at once; then
            all numbers must be finite.
    """

    def compile_(function: Callable[..., Any]) -> Any:
        kept = Path(function.__code__.co_filename).parent / "__pycache__"
        if not any(kept.glob(f"*{function.__name__}*.nbi")):
            _announce()
        try:
            return njit(signature, cache=True, nogil=True, fastmath=reorder)(function)
        except RuntimeError:  # neither the package's folder nor the user's cache can be written
            return njit(signature, nogil=True, fastmath=reorder)(function)

    return compile_


@cache
def compiled_capacities(model: ContactModel) -> Callable[..., Any]:
    """`ContactModel.capacities`, compiled."""
    return compiled("(f8[:, :, ::1], f8[::1], f8[::1], f8[::1])")(model.capacities)
