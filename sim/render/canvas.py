"""An offscreen OpenGL framebuffer that draws MuJoCo scenes."""

import os
import platform
import warnings
from types import TracebackType
from typing import Any, Self

import mujoco
import numpy as np

from planner.arrays import Pixels
from sim.render.needs import MISSING, no_opengl

FONT = mujoco.mjtFontScale.mjFONTSCALE_100.value
"""Of MuJoCo's own labels, which are not used."""


class Canvas:
    """A framebuffer of one size, with the meshes and textures of one model on the graphics card.

    Close it, or use it in a `with` block.
    """

    def __init__(self, model: mujoco.MjModel, width: int, height: int) -> None:
        """
        Args:
            model: Whose scenes are drawn; its offscreen buffer must be as large as the canvas.
            width: [pixels]
            height: [pixels]

        Raises:
            RenderingError: When there is no OpenGL to draw with.
        """
        self._area = mujoco.MjrRect(0, 0, width, height)
        try:
            window_class, window_error = _window()
        except MISSING as error:
            raise no_opengl(error) from error
        try:
            with warnings.catch_warnings():
                warnings.filterwarnings("ignore", module="glfw")  # what it says without a display is told below
                self._window = window_class(width, height)
            self._window.make_current()
            self._context = mujoco.MjrContext(model, FONT)
        except (*MISSING, mujoco.FatalError, window_error) as error:
            raise no_opengl(error) from error
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN.value, self._context)

    def draw(self, scene: mujoco.MjvScene) -> Pixels:
        """Draw a scene: red, green and blue from 0 to 255, shape (height, width, 3)."""
        self._window.make_current()
        pixels = np.empty((self._area.height, self._area.width, 3), dtype=np.uint8)
        mujoco.mjr_render(self._area, scene, self._context)
        mujoco.mjr_readPixels(pixels, None, self._area, self._context)
        return pixels[::-1]  # OpenGL counts rows from the bottom

    def upload(self, model: mujoco.MjModel, texture: int, pixels: Pixels) -> None:
        """Give a texture of the model new colours, shape (height, width, 3), uint8."""
        start = int(model.tex_adr[texture])
        model.tex_data[start : start + pixels.size] = pixels.ravel()
        self._window.make_current()
        mujoco.mjr_uploadTexture(model, self._context, texture)

    def close(self) -> None:
        """Free the graphics card."""
        self._window.make_current()
        self._context.free()
        self._window.free()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self.close()


def _window() -> tuple[Any, type[Exception]]:
    """The class of windows that nobody sees, and what they raise beside MISSING."""
    if platform.system() == "Linux" and os.environ.get("MUJOCO_GL", "") in ("", "egl"):
        from mujoco.egl import GLContext  # here: it loads OpenGL
        from OpenGL.error import Error

        return GLContext, Error
    return mujoco.GLContext, mujoco.FatalError
