"""Which geoms MuJoCo tests for contact with others; names and groups do not matter.

Those whose contype or conaffinity is not 0, and those that a contact pair names.
"""

import mujoco
import numpy as np

from planner.arrays import Mask


def collides(model: mujoco.MjModel) -> Mask:
    """For the geoms of a compiled model, shape (geoms,), boolean."""
    masks = (model.geom_contype | model.geom_conaffinity) != 0
    paired = np.concatenate([model.pair_geom1, model.pair_geom2])
    return masks | np.isin(np.arange(model.ngeom), paired)


def only_seen(spec: mujoco.MjSpec) -> list[mujoco.MjsGeom]:
    """The geoms of a file that do not collide, before it is compiled."""
    paired = {name for pair in spec.pairs for name in (pair.geomname1, pair.geomname2)}
    return [
        geom for geom in spec.geoms if not (geom.contype or geom.conaffinity or (geom.name and geom.name in paired))
    ]
