"""The same as the console command `grasp-inspect`; a script called inspect.py would hide a module of Python's own."""

from planner.commands.start import inspect

if __name__ == "__main__":
    inspect()
