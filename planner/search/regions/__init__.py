"""Regions of the candidates, and rows of regions that stand for many subsets at once.

region_tree       a binary tree of regions: what the search asks of one
candidate_tree    that of clusters of candidates
rows              rows of its nodes with their bounds and cuts: how they split, and those that are open
"""
