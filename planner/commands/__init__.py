"""The commands of the planner, one per file: parse, call, write, print."""
