"""Pictures and films as files: PNG and GIF by Pillow, MP4 by ffmpeg. Written completely or not at all."""

import io
import tempfile
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path

import numpy as np
from PIL import Image

from planner.errors import OutputError, RenderingError
from planner.files.atomic_write import write_atomically
from planner.progress import Observe
from sim.render.needs import INSTALL
from sim.render.palette import BACKGROUND, CONE, FORCE, HELD, LOAD, SLIPPED, rgb
from sim.render.picture import Picture

SLOWER = 10
"""Seconds of film per second of simulation."""
REST = 2.0
"""How long the last picture stays [s]."""
EXACT = [
    tuple(round(shade * part) for part in rgb(color))
    for color in (FORCE, LOAD, CONE, HELD, SLIPPED, BACKGROUND)
    for shade in ((0.6, 0.8, 1.0) if color != BACKGROUND else (1.0,))
]
"""Colours that a GIF has for certain; most of its 256 are those of the objects and shadows."""
SAMPLES = 3
"""Pictures from which a GIF takes its colours."""
QUALITY = 8
"""Of an MP4, from 0 to 10."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Frames:
    """Pictures that are drawn when they are asked for: a film need not fit into memory."""

    picture: Picture

    steps: Sequence[int]
    """Which steps of the recording are shown."""

    rate: int
    """Pictures per second of film."""

    observe: Callable[[int, int], None]
    """Told how many are drawn, and of how many."""

    def __iter__(self) -> Iterator[Image.Image]:
        for number, step in enumerate(self.steps, start=1):
            yield self.picture.draw(step)
            self.observe(number, len(self.steps))


@dataclass(frozen=True, kw_only=True)
class Format:
    """A kind of file."""

    rate: int
    """Pictures per second of film; zero for a still."""

    encode: Callable[[Frames], bytes]

    package: str = "PIL"
    """What encodes it."""

    def require(self) -> None:
        """Import what encodes it.

        Raises:
            RenderingError: When it is not installed.
        """
        try:
            import_module(self.package)
        except ImportError as error:
            raise RenderingError(f"this kind of file needs {self.package}; {INSTALL}") from error


def format_of(path: Path) -> Format:
    """The kind of file that an ending means.

    Raises:
        OutputError: When it means none.
    """
    if path.suffix.lower() not in FORMATS:
        raise OutputError(f"cannot draw {path}: its ending must be one of {', '.join(FORMATS)}")
    return FORMATS[path.suffix.lower()]


def film_steps(steps: int, timestep: float, rate: int) -> list[int]:
    """The steps that a film shows, the first and the last among them; only the last for a still, whose rate is zero.

    Args:
        steps: Of the recording.
        timestep: [s]
        rate: Pictures per second of film.
    """
    if not rate:
        return [steps - 1]
    count = round(steps * timestep * SLOWER * rate) + 1
    return [round(step) for step in np.linspace(0, steps - 1, count).tolist()]


def write_pictures(path: Path, picture: Picture, observe: Observe = lambda *_: None) -> None:
    """Draw a recording as a still of its end, or as a film of its whole.

    Args:
        path: Its ending chooses: .png, .gif or .mp4.
        picture: Draws the recording.
        observe: Told after every picture what is drawn, how many of them, and of how many.

    Raises:
        OutputError: When the ending is none of these, or the file cannot be written.
        RenderingError: When a package is missing.
    """
    format, recording = format_of(path), picture.recording
    steps = film_steps(recording.steps, recording.experiment.protocol.timestep, format.rate)

    def tell(done: int, total: int) -> None:
        observe(f"pictures ({path.name})", done, total)

    frames = Frames(picture=picture, steps=steps, rate=format.rate, observe=tell)
    format.require()
    write_atomically(path, format.encode(frames))


def _png(frames: Frames) -> bytes:
    content = io.BytesIO()
    (still,) = frames
    still.save(content, format="PNG", optimize=True)
    return content.getvalue()


def _gif(frames: Frames) -> bytes:
    samples = [frames.steps[index] for index in np.linspace(0, len(frames.steps) - 1, SAMPLES).round().astype(int)]
    together = Image.fromarray(np.vstack([np.asarray(frames.picture.draw(step)) for step in samples]))
    palette = together.quantize(256 - len(EXACT), dither=Image.Dither.NONE)
    palette.putpalette(
        (palette.getpalette() or [])[: 3 * (256 - len(EXACT))] + [part for color in EXACT for part in color]
    )
    first, *others = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    durations = [round(1000 / frames.rate)] * len(others) + [round(1000 * REST)]
    content = io.BytesIO()
    first.save(content, format="GIF", save_all=True, append_images=others, duration=durations, loop=0)
    return content.getvalue()


def _mp4(frames: Frames) -> bytes:
    import imageio_ffmpeg  # here: an extra

    width, height = (length - length % 2 for length in frames.picture.size)  # the encoder halves the colours
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "film.mp4")
        stream = imageio_ffmpeg.write_frames(
            str(file), (width, height), fps=frames.rate, quality=QUALITY, macro_block_size=2, ffmpeg_log_level="error"
        )
        stream.send(None)
        for frame in frames:
            pixels = np.ascontiguousarray(np.asarray(frame)[:height, :width])
            stream.send(pixels)
        for _ in range(round(REST * frames.rate)):
            stream.send(pixels)
        stream.close()
        return file.read_bytes()


FORMATS = {
    ".png": Format(rate=0, encode=_png),
    ".gif": Format(rate=10, encode=_gif),
    ".mp4": Format(rate=25, encode=_mp4, package="imageio_ffmpeg"),
}
"""Endings, and what is written."""
