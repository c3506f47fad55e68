"""The same as the console command `grasp-convert`."""

from planner.commands.convert import main

if __name__ == "__main__":
    main()
