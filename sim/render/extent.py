"""What must be in a picture: the object with its arrows, its cones and its load."""

import numpy as np

from planner.arrays import Floats
from planner.contacts import contact_frames
from sim.render.drawn_motion import DrawnPose
from sim.render.load import Load
from sim.render.proportions import ARROW, CONE_HEIGHT


def extent(corners: Floats, friction: Floats, pose: DrawnPose, load: Load) -> Floats:
    """Points that bound everything that is drawn of one pose, shape (n, 3) [m].

    Args:
        corners: Of the object where it was planned, shape (corners, 3) [m].
        friction: Of the contacts, shape (contacts,).
        pose: Where the object and its fingers are, and their forces.
        load: What pushes on it.
    """
    size = load.size
    points = [corners @ pose.rotation.T + pose.position, load.points() + pose.position]
    points.append(pose.contacts - ARROW * size * pose.forces)
    for frame, contact, mu in zip(contact_frames(pose.normals), pose.contacts, friction, strict=True):
        rim = np.array([[-1, mu, 0], [-1, -mu, 0], [-1, 0, mu], [-1, 0, -mu]])
        points.append(contact + CONE_HEIGHT * size * rim @ frame.T)
    return np.concatenate(points)
