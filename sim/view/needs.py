"""What the live view needs, viser, and one clear sentence where it is missing."""

from importlib import import_module

from planner.errors import RenderingError


def require_viser(package: str = "viser") -> None:
    """Import what serves the view.

    Raises:
        RenderingError: When it is not installed.
    """
    try:
        import_module(package)
    except ImportError as error:
        raise RenderingError(f"the live view needs {package}; install it with: pip install 'rhograsp[viz]'") from error
