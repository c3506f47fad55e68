"""Required external force sets W_R: a family of convex sets of wrenches, one per file."""
