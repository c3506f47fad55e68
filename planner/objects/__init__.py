"""The object that is grasped: a union of convex parts in space (`rigid_object`), or an outline in the plane.

object_file, object_source   which object comes out of a file, and how it is read
parts/      one convex shape per file
mjcf/       reading MJCF through MuJoCo, and writing it
planar/     outlines in the plane
surface/    points of the outside: nearest, exposed, evenly drawn
mass_doubts, given_mass, pose, vectors
"""
