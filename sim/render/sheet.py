"""Words, lines and dots over a picture; drawn twice as large and reduced, so that nothing is jagged.

Positions and sizes are in points, of which the picture is HIGH high: they need no change when the picture grows.
"""

from collections.abc import Sequence
from typing import Literal

from PIL import Image, ImageDraw, ImageFont

from sim.render.palette import rgb

HIGH = 540
"""Height of a picture [points]."""
FINER = 2
"""How much larger everything is drawn."""

Anchor = Literal["lm", "mm", "rm"]
"""Where a text's position is: the middle of its left end, its middle, or the middle of its right end."""


class Sheet:
    """A transparent layer over a picture of a size in pixels."""

    def __init__(self, width: int, height: int) -> None:
        self.point = height / HIGH
        """Pixels per point."""
        self.wide = width / self.point
        """Width of the picture [points]."""
        self._scale = FINER * self.point
        self._layer = Image.new("RGBA", (FINER * width, FINER * height))
        self._draw = ImageDraw.Draw(self._layer)

    def over(self, picture: Image.Image) -> Image.Image:
        """The picture with this layer on it."""
        return Image.alpha_composite(picture.convert("RGBA"), self._layer.reduce(FINER)).convert("RGB")

    def text(self, x: float, y: float, words: str, size: float, color: str, anchor: Anchor = "lm") -> float:
        """One line of text; returns its width."""
        font = ImageFont.load_default(self._scale * size)
        self._draw.text((self._scale * x, self._scale * y), words, fill=rgb(color), font=font, anchor=anchor)
        return float(font.getlength(words)) / self._scale

    def line(self, points: Sequence[tuple[float, float]], width: float, color: str) -> None:
        """A line through points."""
        scaled = [(self._scale * x, self._scale * y) for x, y in points]
        self._draw.line(scaled, fill=rgb(color), width=max(1, round(self._scale * width)), joint="curve")

    def dot(self, x: float, y: float, radius: float, color: str, opacity: float = 1.0) -> None:
        """A filled circle."""
        box = [self._scale * edge for edge in (x - radius, y - radius, x + radius, y + radius)]
        self._draw.ellipse(box, fill=(*rgb(color), round(255 * opacity)))

    def pill(self, x: float, y: float, words: str, size: float, color: str) -> None:
        """White words on a rounded ground that begins at x, its middle at y."""
        half = 0.85 * size
        width = float(ImageFont.load_default(self._scale * size).getlength(words)) / self._scale + 1.6 * size
        box = [self._scale * edge for edge in (x, y - half, x + width, y + half)]
        self._draw.rounded_rectangle(box, radius=self._scale * half, fill=rgb(color))
        self.text(x + width / 2, y, words, size, "#ffffff", "mm")
