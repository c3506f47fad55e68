"""The same as the console command `grasp-view`."""

from sim.commands.view import main

if __name__ == "__main__":
    main()
