"""What must be in a picture: the object with its arrows, its cones and its load."""

import numpy as np

from planner.arrays import Floats
from planner.contacts import Contacts, contact_frames
from sim.render.drawn_motion import DrawnPose
from sim.render.load import TURN_ROOM, Load
from sim.render.proportions import ARROW, BEYOND, CONE_HEIGHT, TWIST


def extent(corners: Floats, contacts: Contacts, pose: DrawnPose, load: Load) -> Floats:
    """Points that bound everything that is drawn of one pose, shape (n, 3) [m].

    Args:
        corners: Of the object where it was planned, shape (corners, 3) [m].
        contacts: Where they were planned.
        pose: Where the object and its fingers are, and their forces.
        load: What pushes on it.
    """
    size = load.size
    points = [corners @ pose.rotation.T + pose.position, load.points() + pose.position]
    points.append(pose.contacts - ARROW * size * pose.forces)
    frames = contact_frames(pose.normals)
    for frame, contact, mu in zip(frames, pose.contacts, contacts.friction, strict=True):
        rim = np.array([[-1, mu, 0], [-1, -mu, 0], [-1, 0, mu], [-1, 0, -mu]])
        points.append(contact + CONE_HEIGHT * size * rim @ frame.T)
    for frame, contact in zip(frames[contacts.torsions > 0], pose.contacts[contacts.torsions > 0], strict=True):
        around = TURN_ROOM * TWIST * np.array([[0, 1, 1], [0, 1, -1], [0, -1, 1], [0, -1, -1]])
        points.append(contact + size * (around - [BEYOND, 0, 0]) @ frame.T)
    return np.concatenate(points)
