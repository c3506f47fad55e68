"""One run of the experiment: forces of the fingers, load over time, stepping, and what is measured.

loaded_grasp   the noun: an object, its contacts, the loads on them, and what theory says they need
protocol       every constant, with its reason
feed_forward, active, prediction      forces that answer a wrench, and what theory says of them
schedule, trial, force_law, final_state   the load over time, and the one stepping loop
measurement    slip, motion, forces
experiment     a grasp set up, run with any wrenches and caps; workload: how far it is
"""
