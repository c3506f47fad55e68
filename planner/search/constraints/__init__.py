"""What a subset must keep to beside its force: one condition per file, over rows of regions and single subsets.

constraint        what the search asks of one, and how to add one
every_grasp       the list of those that every grasp must keep to:
spacing           contacts neither too near nor too far from each other
distinct          grasps unlike those already found: on the grasps after the best
"""
