"""Where the planner's commands begin: signals are watched before anything else is imported, and that without OpenGL."""

import os
import sys
from collections.abc import Callable
from contextlib import suppress
from importlib import import_module

from planner.terminal.interruption import ignore_signals, watch_signals


def starting(module: str, draws: bool = False) -> Callable[[], None]:
    """The entry point that calls `main` of a module, which always leaves through `SystemExit`.

    Args:
        module: Its dotted name.
        draws: Whether it draws with MuJoCo, which otherwise need not load OpenGL.
    """

    def start() -> None:
        watch_signals()
        if not draws:
            os.environ.setdefault("MUJOCO_GL", "disable")
        try:
            import_module(module).main()
        except SystemExit as leaving:
            ignore_signals()
            _leave(leaving)

    return start


def _leave(leaving: SystemExit) -> None:
    """End now: taking down all that the solvers have loaded takes up to a second, and everything is written."""
    if not isinstance(leaving.code, int):
        raise leaving
    with suppress(OSError):  # nobody reads it any more
        sys.stdout.flush()
        sys.stderr.flush()
    os._exit(leaving.code)


plan = starting("planner.commands.plan")
verify = starting("planner.commands.verify")
convert = starting("planner.commands.convert")
inspect = starting("planner.commands.inspect")
