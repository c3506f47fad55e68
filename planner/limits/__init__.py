"""What a real hand can use: which candidates a finger may touch, and what any two of them must keep to.

limits, limits_file    everything that a limits file can say, as data and as TOML; values, fit: checked
restricted             the list of restrictions, one per file: geoms, keep_out, table, approach
fingers, kinds         fingers that differ
obstacles, clear_path  what stands in the way of a fingertip

To add a restriction of candidates: write its file, its field in `limits`, and name it in `restricted`. A condition on
several contacts at once is a constraint of the search, see `planner.search.constraints`.
"""
