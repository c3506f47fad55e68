"""The API reference: every module, from its docstrings, as pages to look at offline.

python scripts/api_reference.py --out api
"""

from dataclasses import dataclass
from pathlib import Path

from planner.errors import OutputError, RhograspError
from planner.terminal.command_line import ExitCode, parse, run


@dataclass(frozen=True, kw_only=True)
class Options:
    """Build the API reference from docstrings; its first page is index.html."""

    out: Path = Path("api")
    """Folder for the pages; made if missing."""

    modules: tuple[str, ...] = ("planner", "sim")
    """What to show, with everything inside."""


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
        pdoc.pdoc(*options.modules, output_directory=options.out)
    except OSError as error:
        raise OutputError(f"cannot write the folder {options.out}: {error.strerror}") from error
    print(f"wrote       {options.out / 'index.html'}")
    return ExitCode.DONE


if __name__ == "__main__":
    options = parse(Options, "api_reference.py")
    run(lambda: api_reference(options))
