"""The bodies of a compiled model, and what ties them to each other."""

from collections.abc import Iterator

import mujoco
import numpy as np

from planner.objects.mjcf.body_tree import WORLD, BodyTree, Tie
from planner.objects.mjcf.collides import collides
from planner.objects.mjcf.names import name_at


def body_tree(model: mujoco.MjModel) -> BodyTree:
    """The bodies of a model."""
    solid = collides(model) & (model.geom_type != mujoco.mjtGeom.mjGEOM_PLANE)
    ends = model.body_jntadr + model.body_jntnum
    joints = tuple(
        tuple(name_at(model, model.name_jntadr, joint, "joint") for joint in range(start, stop))
        for start, stop in zip(model.body_jntadr.tolist(), ends.tolist(), strict=True)
    )
    return BodyTree(
        names=tuple(name_at(model, model.name_bodyadr, body, "body") for body in range(model.nbody)),
        parents=model.body_parentid,
        joints=joints,
        freedoms=model.body_dofnum,
        constraints=tuple(_constraints(model)),
        masses=model.body_mass,
        colliding_geoms=np.bincount(model.geom_bodyid[solid], minlength=model.nbody),
    )


def _constraints(model: mujoco.MjModel) -> Iterator[Tie]:
    """Active equality constraints that weld bodies to each other, or connect them at a point.

    What is fixed in the world is no part of an object that is welded to it, as it is none of one that hangs on a joint.
    """
    for number in range(model.neq):
        kind = mujoco.mjtEq(model.eq_type[number])
        ends = [int(model.eq_obj1id[number]), int(model.eq_obj2id[number])]
        if model.eq_objtype[number] == mujoco.mjtObj.mjOBJ_SITE:
            ends = [int(model.site_bodyid[site]) for site in ends]
        if (
            kind in (mujoco.mjtEq.mjEQ_WELD, mujoco.mjtEq.mjEQ_CONNECT)
            and model.eq_active0[number]
            and (model.body_weldid[ends] != WORLD).all()
        ):
            name = name_at(model, model.name_eqadr, number, "equality")
            yield Tie(ends[0], ends[1], () if kind == mujoco.mjtEq.mjEQ_WELD else (name,))
