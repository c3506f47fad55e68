"""Formats of other programs, both ways: 3-D scenes, contact frames, grasps of hands, JSON Schema."""
