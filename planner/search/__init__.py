"""The outer problem (4): which m of n candidates need the smallest fingertip force, and the proof.

Read in this order:

    problem, finger_kind        what is searched: candidates, fingers, W_R, limits
    evaluation                  exact rho of one subset, by cone programs
    cuts                        the table in which one direction bounds every subset
    regions/                    groups of candidates, and rows of them that stand for many subsets
    node_bounds, compiled/      bounds of rows from the table
    constraints/                rows that hold nothing wanted
    local_search, incumbents    good grasps early, and which are still wanted
    branch_and_bound            all of it together
    settings, certified, result what callers ask for and get;  minimal_cuts: those that a finished proof needs
    two_fingers, infeasible     two special cases that need no search
    exhaustive, paper, lower_bounds, coarse_to_fine, tie_break      other searches, and the paper's tie-break

Where the time goes, in per cent, one run each on two cores (n candidates, m fingers; a cone program is one solved
inner problem):

                            Case III    prism refined    drill scan    drill scan
                            n 217 m 3   n 1905 m 3       n 3000 m 3    n 1000 m 4
    cone programs               47          25               24             6
    bounds of rows               4          11               20            60
    entering cuts in tables      8          19               24             5
    swaps of the local search    9          18                2             0
    splitting rows               2           3                7            11

The rest is the bookkeeping of batches. So few fingers wait for the solver, many fingers for the bounds.
"""
