"""Lower bounds on rho of many combinations from one vertex of W_R each: step 4 of the paper's algorithm."""

import os
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Literal

import numpy as np

from planner.arrays import Floats, Indices
from planner.contacts import grasp_maps
from planner.errors import CandidateError
from planner.forces.minimax import MinimaxForces
from planner.forces.relaxation import RelaxedForces, cone_edges, edge_columns
from planner.search.problem import SearchProblem

Bound = Literal["relaxation", "subproblem 2"]
"""The Relaxed Problem (9), or Subproblem 2 in its place."""

CHUNK = 2048
"""Combinations a thread takes at a time."""


class LowerBounds:
    """Solves one kind of bounding problem on all cores, with one reused solver per thread."""

    def __init__(self, problem: SearchProblem, bound: Bound, sides: int) -> None:
        """
        Args:
            problem: Whose combinations are bounded.
            bound: Which problem bounds them.
            sides: L, edges of the cone of the Relaxed Problem.

        Raises:
            CandidateError: When a finger has torsional friction: with hard ones in its place, no bound is one.
        """
        if problem.contacts.torsions.any():
            raise CandidateError("the paper's bounds are those of hard fingers; with torsional friction they are none")
        self._problem, self._bound, self._sides = problem, bound, sides
        contacts = problem.contacts
        maps = grasp_maps(contacts.points, problem.reference_point)
        edges = cone_edges(contacts.normals, contacts.friction, sides)
        self._columns = edge_columns(maps, edges, problem.length)
        self._thread = threading.local()

    def solve(self, subsets: Indices, vertex: int) -> Floats:
        """phi of the bounding problem at one vertex of W_R for each combination.

        Args:
            subsets: Candidate indices, shape (subsets, m).
            vertex: Which vertex.

        Returns:
            Shape (subsets,) [N]; infinite where even the bounding problem is infeasible.
        """
        chunks = [subsets[first : first + CHUNK] for first in range(0, len(subsets), CHUNK)]
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            solved = list(pool.map(lambda chunk: self._solve_chunk(chunk, self._problem.wrenches[vertex]), chunks))
        return np.concatenate([np.empty(0), *solved])

    def _solve_chunk(self, subsets: Indices, wrench: Floats) -> Floats:
        if not hasattr(self._thread, "phi"):
            self._thread.phi = self._solver()
        return np.array([self._thread.phi(subset, wrench) for subset in subsets])

    def _solver(self) -> Callable[[Floats, Floats], float]:
        """phi of one combination and one wrench; each thread has its own."""
        problem, columns = self._problem, self._columns
        shape = problem.fingers, problem.contacts.dimension
        if self._bound == "relaxation":
            relaxed = RelaxedForces(*shape, self._sides)
            return lambda subset, wrench: relaxed.solve_columns(columns[subset], wrench, problem.length)
        exact = MinimaxForces(*shape)
        friction = problem.contacts.friction
        return lambda subset, wrench: exact.solve_arrays(
            problem.maps[subset], friction[subset], wrench, problem.length
        )[1]
