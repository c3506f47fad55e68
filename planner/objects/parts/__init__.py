"""Convex parts of an object: one shape per file, its surface divided into facets; see `planner.objects.part`.

primitives        the list of shapes that MuJoCo knows by a size, and how to add one:
box, sphere, ellipsoid, cylinder, capsule
polyhedron        any mesh; hull: its facets; tessellation: triangles of what is round
"""
