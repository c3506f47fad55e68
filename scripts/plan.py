"""The same as the console command `grasp-plan`."""

from planner.commands.plan import main

if __name__ == "__main__":
    main()
