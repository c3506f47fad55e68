"""Where the planner's commands begin: signals are watched before anything else is imported."""

from collections.abc import Callable
from importlib import import_module

from planner.commands.interruption import ignore_signals, watch_signals


def starting(module: str) -> Callable[[], None]:
    """The entry point that calls `main` of a module, which always leaves through `SystemExit`."""

    def start() -> None:
        watch_signals()
        try:
            import_module(module).main()
        finally:
            ignore_signals()

    return start


plan = starting("planner.commands.plan")
verify = starting("planner.commands.verify")
convert = starting("planner.commands.convert")
inspect = starting("planner.commands.inspect")
