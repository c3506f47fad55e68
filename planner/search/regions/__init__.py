"""Regions of the candidates, and rows of regions that stand for many subsets at once.

candidate_tree    a binary tree over the candidates
frontier          rows of its nodes: how they split, and those that are open
bounded_rows      such rows, each with its bound and the cut that proves it
"""
