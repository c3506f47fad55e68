"""Regions of the candidates, and rows of regions that stand for many subsets at once.

region_tree       a binary tree of regions: what the search asks of one
candidate_tree    that of clusters of candidates
frontier          rows of its nodes: how they split, and those that are open
bounded_rows      such rows, each with its bound and the cut that proves it
"""
