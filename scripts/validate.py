"""The same as the console command `grasp-validate`."""

from sim.commands.validate import main

if __name__ == "__main__":
    main()
