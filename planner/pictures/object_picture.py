"""A picture of an object as the planner sees it: what collides, where fingers may go, where the weight is."""

from typing import TYPE_CHECKING

import numpy as np

from planner.contacts import Contacts
from planner.objects.graspable import Graspable
from planner.objects.planar.planar_object import PlanarObject
from planner.pictures.figures import CENTIMETRES, CONTACT, OBJECT, draw_outline, new_figure
from planner.pictures.sharp_edges import sharp_edges

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def object_picture(seen: Graspable, candidates: Contacts, title: str) -> "Figure":
    """Edges of the colliding geoms, candidates, and the centre of mass as a star.

    Args:
        seen: The object.
        candidates: Candidate contacts.
        title: Of the picture.

    Raises:
        OutputError: When Matplotlib is not installed.
    """
    figure = new_figure(7, 6)
    if isinstance(seen, PlanarObject):
        draw_outline(figure.add_subplot(), seen.outline.corners, candidates, None, title)
        return figure
    axes = figure.add_subplot(projection="3d")
    for part in seen.parts:
        edges = CENTIMETRES * sharp_edges(part.triangles()[0])
        gaps = np.full((len(edges), 1, 3), np.nan)
        axes.plot(*np.concatenate([edges, gaps], axis=1).reshape(-1, 3).T, color=OBJECT, linewidth=0.3)
    axes.plot(*(CENTIMETRES * candidates.points).T, ".", color=CONTACT, markersize=3)
    axes.plot(*(CENTIMETRES * seen.center_of_mass[:, None]), "*", color="black", markersize=10)
    axes.set(title=title, xlabel="x [cm]", ylabel="y [cm]", zlabel="z [cm]", aspect="equal")
    axes.locator_params(nbins=4)
    axes.view_init(elev=35, azim=-120)
    return figure
