"""What can be grasped: a rigid object in space or in the plane.

Both name the same things alike: file, sha256, body, parts, mass, center_of_mass, extent, size. Points have three
coordinates in the one and two in the other, and the mathematics of contacts, forces and searches serves both.
"""

from planner.objects.planar.planar_object import PlanarObject
from planner.objects.rigid_object import RigidObject

Graspable = RigidObject | PlanarObject
