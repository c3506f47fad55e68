"""The same as the console command `grasp-report`."""

from sim.commands.report import main

if __name__ == "__main__":
    main()
