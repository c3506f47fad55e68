"""Where fingers may go, as points: evenly spread, on grids, listed, the paper's; confirmed by MuJoCo."""
