"""Planar objects: a simple polygon, read from TOML, and the slab that stands for it in space."""
