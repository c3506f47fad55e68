"""Formats of other programs, both ways: 3-D scenes, contact frames, grasps of hands, JSON Schema.

formats           the list of exports, by the ending of the file, and how to add one
glb               a 3-D scene
isaac_grasp, graspgen, dexgraspbench     grasps for, and of, other programs; hand_grasp: what they share
yaml_text, restricted_pickle, json_schema
"""
