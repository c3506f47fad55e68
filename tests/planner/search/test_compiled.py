"""The compiled loops against plain NumPy that says the same, and the tree under them."""

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest

from planner.arrays import Indices
from planner.contact_models.friction_cone import support
from planner.contacts import grasp_maps
from planner.search.compiled.swaps import best_partner
from planner.search.cuts import CutTable
from planner.search.finger_kind import FingerKind
from planner.search.node_bounds import RAISED, NodeBounds
from planner.search.problem import SearchProblem
from planner.search.regions.candidate_tree import build_tree
from planner.search.regions.region_tree import RegionTree
from planner.search.regions.rows import NO_CUT, BoundedRows, split
from tests.strategies.search_problems import random_problem

PROBLEMS = [random_problem(seed) for seed in range(12)]


def table_of(problem: SearchProblem, cuts: int) -> CutTable:
    """Random cuts; those that bound nothing are left out."""
    table, generator = CutTable(problem), np.random.default_rng(0)
    scale = np.ones(problem.wrenches.shape[1])
    scale[problem.contacts.dimension :] /= problem.length
    while len(table) < cuts:
        table.add(scale * generator.normal(size=len(scale)))
    return table


def below(tree: RegionTree, node: int) -> Indices:
    """Candidates below a node, in their order."""
    left = int(tree.left[node])
    return tree.contact[[node]] if left < 0 else np.concatenate([below(tree, left), below(tree, left + 1)])


def test_the_table_holds_the_support_function_over_the_load() -> None:
    for problem in PROBLEMS:
        table, contacts = table_of(problem, 20), problem.contacts
        maps = grasp_maps(contacts.points, problem.reference_point)
        for k, direction in enumerate(table.directions):
            assert max(-direction @ wrench for wrench in problem.wrenches) == pytest.approx(1)
            pulls = maps.transpose(0, 2, 1) @ direction
            expected = support(pulls, contacts.normals, contacts.friction)
            np.testing.assert_allclose(table.values[:, k], expected, rtol=1e-9, atol=1e-12 * expected.max())


def test_every_row_is_bounded_by_its_smallest_sum_of_maxima() -> None:
    """More cuts than fit a block or the first table, so that blocks are skipped and cuts regrouped."""
    for problem in PROBLEMS:
        table, tree = table_of(problem, 10), build_tree(problem)
        bounds = NodeBounds(tree, table)
        bounds.extend()
        for direction in table_of(problem, 400).directions[10:]:
            table.add(direction)
        bounds.extend()
        generator = np.random.default_rng(1)
        rows = np.sort(generator.integers(0, len(tree.left), (200, problem.fingers)), axis=1)
        exact = np.array([min(sum(table.values[below(tree, node)].max(axis=0) for node in row)) for row in rows])
        threshold = float(np.median(exact))
        found = bounds.bound(BoundedRows.unbounded(rows), threshold)
        assert ((found.bounds <= threshold) == (exact * RAISED <= threshold)).all()
        assert (found.bounds >= exact).all()  # rounded outward: never below the truth
        assert (exact <= threshold).sum() > 50
        given = [
            sum(table.values[below(tree, node), cut].max() for node in row)
            for row, cut in zip(rows, found.cuts, strict=True)
        ]
        np.testing.assert_allclose(found.bounds, given, rtol=2e-6)  # by the very cut that travels with the bound
        assert len(set(found.cuts.tolist())) > 1


def test_a_row_that_is_pruned_by_what_is_known_keeps_the_cut_that_proves_it() -> None:
    """As when the threshold has risen since its parent was bounded: no cut need be looked for, and none else named."""
    problem = PROBLEMS[0]
    table, tree = table_of(problem, 30), build_tree(problem)
    bounds = NodeBounds(tree, table)
    bounds.extend()
    root = bounds.bound(BoundedRows.unbounded(tree.first_row[None]), 0.0)
    assert root.cuts != NO_CUT
    risen = 1.5 * float(root.bounds[0])
    children = bounds.bound(split(root, tree), risen)
    assert (children.cuts == root.cuts[0]).all()
    assert (children.bounds == root.bounds[0]).all()


def test_the_best_partner_is_that_of_all_sums() -> None:
    for problem in PROBLEMS:
        values = table_of(problem, 60).values
        among, chosen = np.arange(1, len(values)), np.array([0])
        scores = (values[among] + values[0]).min(axis=1)
        partner, score = best_partner(values, chosen, among, -1.0)
        assert score == pytest.approx(scores.max())
        assert scores[partner - 1] == pytest.approx(score)
        assert best_partner(values, chosen, among, scores.max())[0] == -1


def test_splitting_down_to_single_candidates_meets_every_subset_once() -> None:
    for problem in PROBLEMS:
        count = len(problem.contacts)
        half = count // 2
        kinds = (FingerKind(fingers=1, candidates=half), FingerKind(fingers=1, candidates=count - half))
        for each in (problem, replace(problem, fingers=2, kinds=kinds)):
            tree = build_tree(each)
            assert sorted(below(tree, int(tree.first_row[0])).tolist()) == list(range(half if each.kinds else count))
            rows, met = tree.first_row[None], []
            while len(rows):
                single = (tree.sizes[rows] == 1).all(axis=1)
                met += [tuple(sorted(tree.contact[row].tolist())) for row in rows[single]]
                rows = rows[~single]
                if len(rows):
                    rows = split(BoundedRows.unbounded(rows), tree).nodes
            wanted = [subset for subset in combinations(range(count), each.fingers) if each.admits(np.array(subset))]
            assert sorted(met) == wanted


def test_coincident_candidates_make_no_deep_tree() -> None:
    problem = random_problem(2)
    same = problem.contacts.subset(np.zeros(2000, dtype=np.int64))
    tree = build_tree(replace(problem, contacts=same))
    assert len(tree.left) == 2 * 2000 - 1
    depth, node = 0, 0
    while tree.left[node] >= 0:
        depth, node = depth + 1, int(tree.left[node])
    assert depth <= 12
    assert (tree.diameters[tree.left >= 0] > 0).all()
