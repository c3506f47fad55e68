"""Required external force sets W_R: a family of convex sets of wrenches, one per file.

by_name           the list of them, by the names of task files, and how to add one
wrench_set        what is asked of one
presets           sets made for an object: paper, gravity, axes6
circumscribed     polytopes around what is round; values: checked numbers
"""
