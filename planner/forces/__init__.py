"""The inner problem: the least force level that balances one wrench.

problem           as data, with the bound that any direction proves
minimax           by Clarabel; contact_program: what its programs share
reference         by CVXPY as cones; semidefinite: as the paper writes it; cvxpy_forces: what they share
relaxation        the paper's linear program, by HiGHS
least_total       the paper's tie-break
squeeze           fingers that cannot adapt
"""
