"""The same as the console command `grasp-render`."""

from sim.commands.start import render

if __name__ == "__main__":
    render()
