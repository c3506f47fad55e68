"""The edges of an object that one would draw: of its parts' sharp edges those where the whole surface turns.

Two parts that lie flush meet in edges that nobody sees. Around the middle of an edge a small circle is drawn, and
measured how much of it lies inside any part: half of it where the surface is flat, all of it inside the object.
"""

import numpy as np

from planner.arrays import Floats
from planner.contacts import contact_frames
from planner.objects.rigid_object import RigidObject
from planner.objects.vectors import unit
from planner.pictures.sharp_edges import sharp_edges

PROBES = 72
"""Points of the circle."""
RADIUS = 1e-3
"""Of the circle, relative to the object's size."""
FLAT = 0.05
"""How far from a half the inner share of a flat surface's circle may be: 18 degrees."""
MOST_EDGES = 1500
"""An object with more is not drawn with edges: they would hide it."""


def visible_edges(rigid_object: RigidObject) -> Floats:
    """Edges where the union of the parts turns, shape (edges, 2, 3) [m], body frame; none if there are too many."""
    edges = np.concatenate([sharp_edges(part.triangles()[0]) for part in rigid_object.parts])
    if len(edges) > MOST_EDGES:
        return edges[:0]
    if len(rigid_object.parts) == 1:
        return edges
    frames = contact_frames(unit(edges[:, 1] - edges[:, 0]))
    angles = (np.arange(PROBES) + 0.5) * 2 * np.pi / PROBES
    circle = RADIUS * rigid_object.size * np.stack([np.zeros(PROBES), np.cos(angles), np.sin(angles)])
    probes = (edges.mean(axis=1)[:, None] + np.swapaxes(frames @ circle, 1, 2)).reshape(-1, 3)
    inside = np.zeros(len(probes), dtype=bool)
    for part in rigid_object.parts:
        lower, upper = part.bounds()
        asked = np.flatnonzero(~inside & ((probes > lower) & (probes < upper)).all(axis=1))
        inside[asked] = part.depth(probes[asked]) > 0
    share = inside.reshape(-1, PROBES).mean(axis=1)
    return edges[(np.abs(share - 0.5) > FLAT) & (share < 1)]
