"""Mass properties from the shape alone, for files whose object has no mass: the user gives it."""

import mujoco
import numpy as np

from planner.objects.mjcf.collides import only_seen

DENSITY = 1000.0
"""Of water; only its being uniform matters, because the mass is given [kg / m^3]."""


def weigh_massless_bodies(spec: mujoco.MjSpec) -> None:
    """Give what collides of every body without mass a uniform density.

    Args:
        spec: Changed; to be compiled again.
    """
    seen = set(only_seen(spec))
    for body in spec.bodies[1:]:
        geoms = [geom for geom in body.geoms if geom not in seen]
        stated = body.mass if body.explicitinertial else sum(_weighs(geom) for geom in body.geoms)
        if stated == 0 and geoms:
            body.explicitinertial, body.ipos = False, np.full(3, np.nan)  # MuJoCo infers what is not a number
            for geom in geoms:
                geom.mass, geom.density = np.nan, DENSITY


def _weighs(geom: mujoco.MjsGeom) -> bool:
    return bool(geom.density > 0 if np.isnan(geom.mass) else geom.mass > 0)
