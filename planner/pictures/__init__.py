"""Figures for people to look at: Matplotlib, edges and shades of objects."""
