"""Many grasps, many settings: what scripts tabulate, and planners that are wrong on purpose."""
