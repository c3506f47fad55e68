"""Is a grasp file true? Nothing here shares code with the search that made it.

verify        every claim, one check each
bound_check   the proof of the lower bound; capacities: what a contact does along a cut; groups: many subsets at once
proof_check   the same before a plan is called proven
two_contacts  what no pair of contacts can do; why_infeasible: that in words, and what may help
provenance/   do task, object and candidates belong together?
"""
