"""Convex parts of an object: one shape per file, its surface divided into facets; see `planner.objects.part`."""
