"""One HTML page per grasp, offline: the object in 3-D, forces, proof and measurement."""
