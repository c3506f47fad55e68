"""The same as the console command `grasp-report`."""

from sim.commands.start import report

if __name__ == "__main__":
    report()
