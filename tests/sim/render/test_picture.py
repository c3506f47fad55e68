"""Pictures show what they say: the object, its fingers, their forces, and a loss that can be seen."""

import colorsys
import io
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from planner.arrays import Mask, Pixels
from planner.errors import OutputError, RenderingError, SettingError
from planner.grasps.grasp import Grasp
from planner.objects.rigid_object import RigidObject
from sim.render import film
from sim.render.drawn_motion import drawn_pose
from sim.render.extent import extent
from sim.render.film import FORMATS, Format, Frames, film_steps, format_of
from sim.render.palette import BACKGROUND, FORCE, HELD, LOAD, OBJECT, SLIPPED, rgb
from sim.render.picture import Picture, heading_of
from sim.render.proportions import ARC_ROD, BEYOND, TWIST, arc, arc_head
from sim.render.recording import Recording
from sim.scene.fingertips import TORQUE

LAST = 549


def like(pixels: Pixels, color: str, hue: float = 0.04) -> Mask:
    """Which pixels, shape (height, width, 3), have the hue of a strong colour, shape (height, width)."""
    wanted = colorsys.rgb_to_hsv(*(part / 255 for part in rgb(color)))[0]
    found = np.asarray(Image.fromarray(pixels).convert("HSV")) / 255
    away = np.abs(found[..., 0] - wanted)
    return (np.minimum(away, 1 - away) < hue) & (found[..., 1] > 0.6) & (found[..., 2] > 0.25)


def warm_grey(pixels: Pixels) -> Mask:
    """Which pixels are of the object: as much warmer than grey as its colour, in light or in shadow."""
    red, green, blue = np.moveaxis(pixels.astype(float), -1, 0)
    r, g, b = rgb(OBJECT)
    return (np.abs(blue / (red + 1) - b / r) < 0.04) & (np.abs(green / (red + 1) - g / r) < 0.03)


def test_the_object_its_forces_and_the_load_are_in_the_picture(picture: Picture) -> None:
    pixels, labels = picture.panel.draw(LAST, 0)
    assert pixels.shape == (picture.panel.height, picture.panel.width, 3)
    assert warm_grey(pixels).mean() > 0.08
    assert like(pixels, LOAD).sum() > 50
    assert len(labels) == 3
    seen = [label for label in labels if not label.hidden]
    assert len(seen) >= 2
    force = np.argwhere(like(pixels, FORCE))
    for label in seen:
        away = np.linalg.norm(force - [label.row, label.column], axis=1)
        assert away.min() < 0.12 * picture.panel.width, "no force beside a contact that is seen"


def test_before_the_load_comes_there_is_none(picture: Picture) -> None:
    pixels, _ = picture.panel.draw(30, 0)
    assert like(pixels, LOAD).sum() == 0
    assert like(pixels, FORCE).sum() > 50


def test_the_lost_object_is_seen_to_move_and_the_held_one_is_not(picture: Picture) -> None:
    """Share of the object's pixels that are not the object's any more."""
    changed = []
    for simulation in (0, 1):
        before, after = (warm_grey(picture.panel.draw(step, simulation)[0]) for step in (150, LAST))
        changed.append((before != after).sum() / before.sum())
    assert changed[0] < 0.02 < 0.04 < changed[1]


def test_the_picture_has_its_size_and_says_how_it_ended(picture: Picture) -> None:
    still = picture.draw(LAST)
    assert still.size == (640, 360)
    pixels = np.asarray(still)
    assert tuple(pixels[0, 0]) == rgb(BACKGROUND)
    left, right = pixels[30:55, :320], pixels[30:55, 320:]
    assert like(left, HELD).sum() > 100 and like(left, SLIPPED, 0.02).sum() == 0
    assert like(right, SLIPPED, 0.02).sum() > 100 and like(right, HELD).sum() == 0
    early = np.asarray(picture.draw(100))[30:55]
    assert like(early, HELD).sum() == like(early, SLIPPED, 0.02).sum() == 0


def test_the_arcs_of_torques_are_in_the_picture(soft_picture: Picture, picture: Picture) -> None:
    """Without them, the same picture has fewer pixels of their colour; a hard grasp's is the same."""
    for shown, fewer in ((soft_picture, True), (picture, False)):
        panel, last = shown.panel, shown.recording.steps - 1
        with_arcs = panel.draw(last, 0)[0]
        readings = shown.recording.readings.copy()
        readings[..., TORQUE] = 0.0
        panel._recording = replace(shown.recording, readings=readings)
        without = panel.draw(last, 0)[0]
        panel._recording = shown.recording
        assert ((like(with_arcs, FORCE) & ~like(without, FORCE)).sum() > 40) == fewer
        assert (with_arcs == without).all() != fewer


def test_what_must_be_in_the_picture_bounds_the_arcs_of_soft_fingers_alone(soft_picture: Picture) -> None:
    """Where hardly any force is drawn and the cones are narrow: seen from anywhere, nothing lies outside."""
    panel, recording = soft_picture.panel, soft_picture.recording
    contacts, corners = recording.experiment.scene.contacts, panel._triangles.reshape(-1, 3)
    pose = drawn_pose(recording, 0, 0, 1.0)
    pose = replace(pose, forces=0 * pose.forces)
    narrow = replace(contacts, friction=np.full(len(contacts), 0.05))
    soft, hard = (extent(corners, each, pose, panel._load) for each in (narrow, replace(narrow, torsion=None)))
    arcs = []
    for contact, normal in zip(pose.contacts, pose.normals, strict=True):
        points, heading = arc(normal, 1.0, TWIST)
        tip = points[-1] + arc_head(1.0, ARC_ROD)[0] * heading
        arcs.append(contact + panel._size * (np.vstack([points, tip]) - BEYOND * normal))
    seen = np.random.default_rng(0).normal(size=(3, 500))
    farthest = (np.concatenate(arcs) @ seen).max(axis=0)
    assert (farthest <= (soft @ seen).max(axis=0)).all()
    assert (farthest > (hard @ seen).max(axis=0)).any()


@pytest.mark.slow
def test_a_gif_has_every_picture_and_stays_on_the_last(picture: Picture) -> None:
    told: list[tuple[int, int]] = []
    frames = Frames(picture=picture, steps=[0, 300, LAST], rate=10, observe=lambda *count: told.append(count))
    with Image.open(io.BytesIO(FORMATS[".gif"].encode(frames))) as gif:
        assert isinstance(gif, Image.Image) and gif.size == (640, 360)
        durations = []
        for frame in range(3):
            gif.seek(frame)
            durations.append(gif.info["duration"])
        assert durations == [100, 100, 2000]
        with pytest.raises(EOFError):
            gif.seek(3)
        gif.seek(2)
        difference = np.asarray(gif.convert("RGB")).astype(int) - np.asarray(picture.draw(LAST))
    assert np.abs(difference).max(axis=2).mean() < 3
    assert told == [(1, 3), (2, 3), (3, 3)]


@pytest.mark.slow
def test_an_mp4_has_every_picture_and_stays_on_the_last(picture: Picture, tmp_path: Path) -> None:
    ffmpeg = pytest.importorskip("imageio_ffmpeg", reason="MP4 needs imageio-ffmpeg")
    file = tmp_path / "film.mp4"
    frames = Frames(picture=picture, steps=[0, LAST], rate=25, observe=lambda *_: None)
    file.write_bytes(FORMATS[".mp4"].encode(frames))
    count, seconds = ffmpeg.count_frames_and_secs(str(file))
    assert count == 2 + 50
    assert seconds == pytest.approx(52 / 25, abs=0.05)


def test_films_run_ten_times_slower_and_show_beginning_and_end() -> None:
    assert film_steps(550, 1e-3, 0) == [549]
    steps = film_steps(550, 1e-3, 10)
    assert len(steps) == 56 and steps[0] == 0 and steps[-1] == 549
    assert len(film_steps(550, 1e-3, 25)) == 139


def test_kinds_of_files_and_their_packages_are_named() -> None:
    with pytest.raises(OutputError, match=r"cannot draw x\.jpg: .* \.png, \.gif, \.mp4"):
        format_of(Path("x.jpg"))
    missing = Format(rate=1, encode=film._png, package="no_such_package")
    with pytest.raises(RenderingError, match=r"needs no_such_package; .*rhograsp\[render\]"):
        missing.require()


@pytest.mark.parametrize(
    ("size", "direction", "message"),
    [
        ((639, 360), None, "639 x 360 pixels; allowed: 640 x 360 to 3840 x 2160"),
        ((3841, 2160), None, "3841 x 2160"),
        ((640, 600), None, "too narrow"),
        ((640, 360), (0.0, 90.0), "0.0, 90.0 degrees"),
        ((640, 360), (float("nan"), 0.0), "nan"),
    ],
)
def test_pictures_that_cannot_be_read_are_refused(
    prism: RigidObject,
    golden_grasp: Grasp,
    recording: Recording,
    size: tuple[int, int],
    direction: tuple[float, float] | None,
    message: str,
) -> None:
    with pytest.raises(SettingError, match=message):
        Picture(prism, recording, heading_of("x", golden_grasp, recording), size, direction)


def test_a_soft_grasp_says_its_torsion(soft_grasp: Grasp, soft_recording: Recording) -> None:
    heading = heading_of("box", soft_grasp, soft_recording)
    assert heading.details.startswith("2 fingers · friction 0.5 · torsion 1.33 mm · critical wrench")


def test_a_long_name_is_shortened_and_another_wrench_is_not_called_critical(
    golden_grasp: Grasp, recording: Recording
) -> None:
    heading = heading_of("a" * 30, golden_grasp, recording)
    assert len(heading.name) == 20
    assert heading.details == "3 fingers · friction 0.3 · critical wrench 49 of 64 · rho = 0.669 N"
    assert heading.need == "rho"
