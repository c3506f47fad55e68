"""A planar grasp as a grasp in space: points at z = 0, forces without z, moments about z.

Lifted and planar grasps need the same force: phi of a lifted wrench (f_x, f_y, 0, 0, 0, m) is phi of (f_x, f_y, m).

    Not more: planar forces that balance the wrench, lifted, lie in the cones of space and are as long as before.
    All act in the plane z = 0, so the equations for the force along z and for the moments about x and y read 0 = 0.

    Not less: take forces in space that balance the lifted wrench and drop their z. Normals have no z, so normal
    parts stay and tangential parts do not grow: the forces stay in the cones, and none grows. A force along z at
    z = 0 enters neither the forces along x and y nor the moment about z, so the balance of the plane stays.

The second step also shows that the least friction utilisation under a cap is the same.
"""

from dataclasses import replace

import numpy as np

from planner.arrays import Floats
from planner.contacts import Contacts
from planner.grasps.grasp import Grasp
from planner.objects.graspable import Graspable
from planner.objects.planar.extrusion import extruded
from planner.objects.planar.planar_object import PlanarObject
from planner.objects.rigid_object import RigidObject
from planner.task import Task


def lift_vectors(vectors: Floats) -> Floats:
    """Points, normals or forces, shape (..., 2), as shape (..., 3)."""
    return np.concatenate([vectors, np.zeros((*vectors.shape[:-1], 1))], axis=-1)


def lift_wrenches(wrenches: Floats) -> Floats:
    """Wrenches (f_x, f_y, m), shape (..., 3), as (f_x, f_y, 0, 0, 0, m), shape (..., 6)."""
    lifted = np.zeros((*wrenches.shape[:-1], 6))
    lifted[..., [0, 1, 5]] = wrenches
    return lifted


def lift_contacts(contacts: Contacts) -> Contacts:
    """Contacts in the plane as contacts in space."""
    return replace(contacts, points=lift_vectors(contacts.points), normals=lift_vectors(contacts.normals))


def in_space(rigid_object: Graspable, grasp: Grasp) -> tuple[RigidObject, Grasp]:
    """An object and its grasp in space: as they are, or a planar object as a slab and its grasp lifted."""
    if not isinstance(rigid_object, PlanarObject):
        return rigid_object, grasp
    task, certificate = grasp.task, grasp.certificate
    lifted = replace(
        grasp,
        task=Task(
            name=task.name,
            reference_point=lift_vectors(task.reference_point),
            wrenches=lift_wrenches(task.wrenches),
        ),
        contacts=lift_contacts(grasp.contacts),
        forces=lift_vectors(grasp.forces),
        certificate=replace(
            certificate, candidates=lift_contacts(certificate.candidates), cuts=lift_wrenches(certificate.cuts)
        ),
    )
    return extruded(rigid_object), lifted
