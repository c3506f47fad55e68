"""The same as the console command `grasp-verify`."""

from planner.commands.verify import main

if __name__ == "__main__":
    main()
