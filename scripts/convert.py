"""The same as the console command `grasp-convert`."""

from planner.commands.start import convert

if __name__ == "__main__":
    convert()
