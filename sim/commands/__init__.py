"""The commands of the simulator, one per file."""
