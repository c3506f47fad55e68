"""Is rho true? The verdict with its evidence: control experiments, measured caps, loads beyond the vertices."""
