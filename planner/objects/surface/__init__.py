"""The outside of a union of convex parts: nearest points, what is exposed, random points, lines, coincident parts."""
