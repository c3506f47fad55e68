"""Pictures and films of a trial."""
