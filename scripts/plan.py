"""The same as the console command `grasp-plan`."""

from planner.commands.start import plan

if __name__ == "__main__":
    plan()
