"""The same as the console command `grasp-render`."""

from sim.commands.render import main

if __name__ == "__main__":
    main()
