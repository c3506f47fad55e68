"""`verify` accepts the golden grasp and notices each kind of lie."""

from dataclasses import replace

import numpy as np
import pytest

from planner.contacts import Contacts
from planner.grasp import Certificate, Grasp
from planner.search.result import Status
from planner.verification import verify


def failures(grasp: Grasp) -> list[str]:
    return [check.claim for check in verify(grasp) if not check.holds]


def test_the_golden_grasp_is_true(golden_grasp: Grasp) -> None:
    assert failures(golden_grasp) == []


def test_forces_that_do_not_balance_are_noticed(golden_grasp: Grasp) -> None:
    forces = golden_grasp.forces.copy()
    forces[3, 0] *= 1 - 1e-4
    assert any("balance" in claim for claim in failures(replace(golden_grasp, forces=forces)))


def test_forces_outside_their_cones_are_noticed(golden_grasp: Grasp) -> None:
    contacts = golden_grasp.contacts
    slippery = Contacts(points=contacts.points, normals=contacts.normals, friction=0.99 * contacts.friction)
    claims = failures(replace(golden_grasp, contacts=slippery))
    assert any("cone" in claim for claim in claims)
    assert any("independent solver" in claim for claim in claims)
    assert any("candidates" in claim for claim in claims)


def test_a_rho_that_is_not_the_least_is_noticed(golden_grasp: Grasp) -> None:
    lazy = replace(golden_grasp, phi=1.01 * golden_grasp.phi)
    assert any("independent solver" in claim for claim in failures(lazy))


def test_a_bound_that_is_not_proven_is_noticed(golden_grasp: Grasp) -> None:
    bold = replace(golden_grasp, lower_bound=1.01 * golden_grasp.rho)
    assert any("need less than" in claim for claim in failures(bold))
    cuts = golden_grasp.certificate.cuts
    few = Certificate(candidates=golden_grasp.certificate.candidates, cuts=cuts[: len(cuts) // 2])
    assert any("need less than" in claim for claim in failures(replace(golden_grasp, certificate=few)))


@pytest.mark.parametrize("status", [Status.INFEASIBLE, Status.OPTIMAL])
def test_a_status_that_claims_too_much_is_noticed(golden_grasp: Grasp, status: Status) -> None:
    loose = replace(golden_grasp, status=status, lower_bound=0.9 * golden_grasp.lower_bound)
    assert failures(loose) == [f"the status is {status}"]


def test_a_better_grasp_of_the_same_candidates_would_be_noticed(golden_grasp: Grasp) -> None:
    """The bound is about all candidates: make one of them better and the old cuts no longer cover it."""
    candidates = golden_grasp.certificate.candidates
    friction = candidates.friction.copy()
    friction[:] = 0.6
    better = Contacts(points=candidates.points, normals=candidates.normals, friction=friction)
    certificate = Certificate(candidates=better, cuts=golden_grasp.certificate.cuts)
    assert any("need less than" in claim for claim in failures(replace(golden_grasp, certificate=certificate)))
    assert np.all(golden_grasp.certificate.candidates.friction == 0.3)
