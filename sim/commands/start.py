"""Where the simulator's commands begin: signals are watched before anything else is imported."""

from planner.commands.start import starting

validate = starting("sim.commands.validate")
report = starting("sim.commands.report")
render = starting("sim.commands.render", draws=True)
view = starting("sim.commands.view")
