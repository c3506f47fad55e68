"""The same as the console command `grasp-view`."""

from sim.commands.start import view

if __name__ == "__main__":
    view()
