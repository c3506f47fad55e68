"""Is rho true? The verdict with its evidence.

validation        the whole of it; verdict: from evidence to pass, fail, or not to be trusted
control_experiment, control_experiments     a changed experiment and what theory predicts of it; displacement: moved
critical_force    the measured cap of every wrench
beyond            loads beside the vertices; wrench_samples: which
force_agreement   measured against predicted forces
document          the file

To add a control experiment: a function in `control_experiments` that returns a `ControlExperiment`, and its call in
`validation`.
"""
