"""What drawing needs, OpenGL and Pillow, and one clear sentence where they are missing.

MuJoCo loads OpenGL when it is imported: whatever MUJOCO_GL names, or GLFW, which needs a display. So that servers need
no setting, pictures are drawn through EGL on Linux unless MUJOCO_GL says otherwise (sim/render/canvas.py).
"""

import os
from importlib import import_module

from planner.errors import RenderingError

INSTALL = "install it with: pip install 'rhograsp[render]'"
"""What to do about a missing package."""

MISSING = (ImportError, AttributeError, OSError, RuntimeError, ValueError)
"""What MuJoCo and PyOpenGL raise where OpenGL is missing: they look up functions of libraries that are not there."""


def require_drawing() -> None:
    """Import Pillow, and MuJoCo with its OpenGL; to be called before anything else imports MuJoCo.

    Raises:
        RenderingError: When that fails.
    """
    try:
        import_module("PIL.Image")
    except ImportError as error:
        raise RenderingError(f"pictures need Pillow; {INSTALL}") from error
    try:
        import_module("mujoco")
    except MISSING as error:
        raise no_opengl(error) from error


def no_opengl(error: Exception) -> RenderingError:
    """What is wrong and what to do, in one line."""
    reason = " ".join(str(error).split()) or type(error).__name__
    return RenderingError(
        f"OpenGL does not work: {reason} (MUJOCO_GL is {os.environ.get('MUJOCO_GL') or 'not set'}); set MUJOCO_GL=egl "
        "and install EGL (Debian, Ubuntu: apt-get install libegl1 libgl1), or draw on a machine with a display; "
        "grasp-validate measures without OpenGL"
    )
