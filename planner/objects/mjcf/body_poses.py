"""Where the bodies of an object are: at qpos0, or where a keyframe puts their joints."""

import mujoco

from planner.arrays import Floats
from planner.errors import ObjectError
from planner.objects.mjcf.names import name_at
from planner.objects.pose import Pose


def configuration_at(model: mujoco.MjModel, keyframe: str | None) -> Floats:
    """Coordinates of the joints: qpos0, or those of a keyframe, shape (nq,).

    Raises:
        ObjectError: If there is no such keyframe.
    """
    if keyframe is None:
        return model.qpos0.copy()
    names = [name_at(model, model.name_keyadr, number, "key") for number in range(model.nkey)]
    if keyframe not in names:
        listed = ", ".join(f"'{name}'" for name in names) or "none"
        raise ObjectError(f"there is no keyframe named '{keyframe}'; the file has {listed}")
    return model.key_qpos[names.index(keyframe)].copy()


def body_poses(model: mujoco.MjModel, root: int, bodies: list[int], configuration: Floats) -> dict[int, Pose]:
    """Pose in B of each body of the object, that of the root, which is B, first.

    Args:
        model: The model.
        root: The body whose frame is B.
        bodies: The object's, root among them, in the order of their numbers.
        configuration: Coordinates of the joints, shape (nq,).
    """
    if (configuration == model.qpos0).all() and root == bodies[0] and _one_tree(model, bodies):
        return _poses_below(model, bodies)
    in_world = poses_in_world(model, bodies, configuration)
    to_root = in_world[root].inverse()
    others = [body for body in bodies if body != root]
    return {root: Pose.identity()} | {body: to_root.compose(in_world[body]) for body in others}


def poses_in_world(model: mujoco.MjModel, bodies: list[int], configuration: Floats) -> dict[int, Pose]:
    """X_WB of each body, W being the world."""
    data = mujoco.MjData(model)
    data.qpos[:] = configuration
    mujoco.mj_kinematics(model, data)
    return {body: Pose(position=data.xpos[body].copy(), quaternion=data.xquat[body].copy()) for body in bodies}


def _one_tree(model: mujoco.MjModel, bodies: list[int]) -> bool:
    """Whether the parents of all bodies but the first are among them."""
    return set(model.body_parentid[bodies[1:]].tolist()) <= set(bodies)


def _poses_below(model: mujoco.MjModel, bodies: list[int]) -> dict[int, Pose]:
    """Pose in B of each body of a subtree at qpos0, where no joint displaces anything."""
    root, *descendants = bodies
    poses = {root: Pose.identity()}
    for body in descendants:
        in_parent = Pose(position=model.body_pos[body].copy(), quaternion=model.body_quat[body].copy())
        poses[body] = poses[int(model.body_parentid[body])].compose(in_parent)
    return poses
