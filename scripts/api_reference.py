"""The API reference: every module, from its docstrings, as pages to look at offline.

python scripts/api_reference.py --out api
"""

from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules

from planner.errors import OutputError, RhograspError
from planner.terminal.command_line import ExitCode, parse, run


@dataclass(frozen=True, kw_only=True)
class Options:
    """Build the API reference from docstrings; its first page is index.html."""

    out: Path = Path("api")
    """Folder for the pages; made if missing."""

    modules: tuple[str, ...] = ("planner", "sim")
    """What to show, with everything inside."""


def inside(name: str) -> list[str]:
    """A module, and the rooms behind a front door, which shows by itself only what it names."""
    module = import_module(name)
    if not hasattr(module, "__all__"):
        return [name]
    for public in module.__all__:  # imported only when asked for: now
        setattr(module, public, getattr(module, public))
    return [name, *(room.name for room in iter_modules(module.__path__, f"{name}."))]


def api_reference(options: Options) -> ExitCode:
    """Write the pages and say where they are."""
    try:
        import pdoc
        import pdoc.render
    except ImportError as error:
        raise RhograspError("the API reference needs pdoc: pip install 'rhograsp[docs]'") from error
    pdoc.render.configure(docformat="google", math=False, show_source=False)
    try:
        options.out.mkdir(parents=True, exist_ok=True)
        pdoc.pdoc(*(each for name in options.modules for each in inside(name)), output_directory=options.out)
    except OSError as error:
        raise OutputError(f"cannot write the folder {options.out}: {error.strerror}") from error
    print(f"wrote       {options.out / 'index.html'}")
    return ExitCode.DONE


if __name__ == "__main__":
    options = parse(Options, "api_reference.py")
    run(lambda: api_reference(options))
