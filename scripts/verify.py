"""The same as the console command `grasp-verify`."""

from planner.commands.start import verify

if __name__ == "__main__":
    verify()
