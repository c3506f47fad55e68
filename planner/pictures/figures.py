"""Pictures of objects, candidates and grasps in the style of the paper's figures, drawn by Matplotlib.

Contacts are arrows that push along their inward normal. Lengths are in centimetres, as in the paper.
Matplotlib is an extra (`pip install rhograsp[plots]`), imported when the first figure is drawn.
"""

import io
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from planner.arrays import Floats
from planner.contacts import Contacts
from planner.errors import OutputError
from planner.files.atomic_write import write_atomically
from planner.objects.rigid_object import RigidObject
from planner.pictures.sharp_edges import sharp_edges

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

CENTIMETRES = 100.0
ARROW = 0.25
"""Length of an arrow, relative to the object's size."""

OBJECT, CANDIDATE, CONTACT, SHADOW = "#4a5568", "#9aa5b1", "#c0392b", "#d5d8dc"
"""Colours."""


def new_figure(width: float, height: float) -> "Figure":
    """An empty figure, in inches, that belongs to no window.

    Raises:
        OutputError: When Matplotlib is not installed.
    """
    try:
        from matplotlib.figure import Figure
    except ImportError as error:
        raise OutputError("pictures need Matplotlib; install it with: pip install 'rhograsp[plots]'") from error
    return Figure(figsize=(width, height), layout="constrained")


def save_figure(path: Path, figure: "Figure") -> None:
    """Write a figure as PNG.

    Raises:
        OutputError: When the file cannot be written.
    """
    content = io.BytesIO()
    figure.savefig(content, format="png", dpi=150)
    write_atomically(path, content.getvalue())


def draw_outline(axes: "Axes", outline: Floats, candidates: Contacts, grasp: Contacts | None, title: str) -> None:
    """A planar object with its candidates and, as arrows, the contacts of a grasp (Fig. 2, 4 and 5).

    Args:
        axes: Where to draw.
        outline: Corners of the polygon in order, shape (corners, 2) [m].
        candidates: All candidate contacts.
        grasp: The chosen ones, or None to show the candidates alone.
        title: Of the axes.
    """
    corners = CENTIMETRES * np.vstack([outline, outline[:1]])
    length = ARROW * float(np.linalg.norm(np.ptp(corners, axis=0)))
    axes.plot(*corners.T, color=OBJECT, linewidth=1.5)
    axes.plot(*(CENTIMETRES * candidates.points).T, ".", color=CANDIDATE, markersize=4)
    axes.plot(0, 0, "x", color=OBJECT)
    if grasp is not None:
        for point, normal in zip(CENTIMETRES * grasp.points, grasp.normals, strict=True):
            axes.annotate(
                "",
                xy=tuple(point),
                xytext=tuple(point - length * normal),
                arrowprops={"arrowstyle": "-|>", "color": CONTACT, "linewidth": 2},
            )
    (left, bottom), (right, top) = corners.min(axis=0) - length, corners.max(axis=0) + length
    axes.set(xlim=(left, right), ylim=(bottom, top))  # room for an arrow on every side
    axes.set(aspect="equal", title=title, xlabel="x [cm]", ylabel="y [cm]")


def object_figure(rigid_object: RigidObject, candidates: Contacts, grasp: Contacts, title: str) -> "Figure":
    """An object in space, its candidates, its grasp as arrows, and the contacts' triangle on its base (Fig. 6).

    Args:
        rigid_object: The object; its facets' edges are drawn.
        candidates: All candidate contacts.
        grasp: The chosen ones.
        title: Of the figure.
    """
    figure = new_figure(6.4, 5.6)
    axes = figure.add_subplot(projection="3d")
    for part in rigid_object.parts:
        triangles, _ = part.triangles()
        for start, stop in CENTIMETRES * sharp_edges(triangles):
            axes.plot(*np.stack([start, stop]).T, color=OBJECT, linewidth=1.2)
        base = CENTIMETRES * triangles[..., 2].min()
    axes.plot(*(CENTIMETRES * candidates.points).T, ".", color=CANDIDATE, markersize=2)
    points = CENTIMETRES * grasp.points
    shadow = np.vstack([points, points[:1]])
    axes.plot_trisurf(*points[:, :2].T, np.full(len(points), base), color=SHADOW, alpha=0.6, shade=False)
    axes.plot(shadow[:, 0], shadow[:, 1], np.full(len(shadow), base), color=CANDIDATE, linewidth=1)
    length = ARROW * CENTIMETRES * rigid_object.size
    tails = points - length * grasp.normals
    axes.quiver(*tails.T, *(length * grasp.normals).T, color=CONTACT, linewidth=2, arrow_length_ratio=0.25)
    axes.plot(*points.T, "o", color="black", markersize=5)
    axes.plot([0], [0], [0], "x", color="black")
    axes.set(title=title, xlabel="x [cm]", ylabel="y [cm]", zlabel="z [cm]", aspect="equal")
    axes.locator_params(nbins=4)
    axes.view_init(elev=35, azim=-120)
    return figure
