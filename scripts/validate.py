"""The same as the console command `grasp-validate`."""

from sim.commands.start import validate

if __name__ == "__main__":
    validate()
