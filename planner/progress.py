"""How far long work is: the two signatures with which it is told, everywhere."""

from collections.abc import Callable

Observe = Callable[[str, float, float], None]
"""Told what is counted, how much of it is done, and of how much; half-done work counts half."""

Done = Callable[[float], None]
"""Told how much is done, by work whose caller knows of how much."""
