"""`verify` accepts the golden grasp and notices each kind of lie."""

import sys
from dataclasses import replace

import numpy as np
import pytest

from planner.arrays import Floats
from planner.candidates.choice import make_candidates
from planner.contacts import Contacts, grasp_maps
from planner.grasp_problem import GraspProblem
from planner.grasps.grasp import Certificate, Grasp
from planner.objects.rigid_object import RigidObject
from planner.planning import plan
from planner.search.result import Status
from planner.task import make_task
from planner.verification.verify import verify


def failures(grasp: Grasp) -> list[str]:
    return [check.claim for check in verify(grasp) if check.fails]


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


def test_a_grasp_under_limits_is_true(limited_grasp: Grasp) -> None:
    assert failures(limited_grasp) == []


def test_a_finger_stronger_than_its_kind_is_noticed(limited_grasp: Grasp) -> None:
    contacts = replace(limited_grasp.contacts, strength=np.array([1.0, 1.0, 0.6]))
    claims = failures(replace(limited_grasp, contacts=contacts))
    assert any("candidates that keep the limits" in claim for claim in claims)
    assert any("independent solver" in claim for claim in claims)


def test_a_finger_that_pushes_beyond_its_strength_is_noticed(limited_grasp: Grasp) -> None:
    """Everything about the grasp is as planned but the strength, that of the candidates too."""
    weak = replace(limited_grasp.contacts, strength=np.array([1.0, 1.0, 0.45]))
    assert any("no finger pushes harder" in claim for claim in failures(replace(limited_grasp, contacts=weak)))


@pytest.mark.parametrize(("spacing", "span"), [(0.021, 0.028), (0.02, 0.021)])
def test_contacts_that_do_not_keep_their_distances_are_noticed(
    limited_grasp: Grasp, spacing: float, span: float
) -> None:
    certificate = replace(limited_grasp.certificate, spacing=spacing, span=span)
    claims = failures(replace(limited_grasp, certificate=certificate))
    assert claims == ["the contacts are candidates that keep the limits"]


def test_contacts_of_the_wrong_kinds_are_noticed(limited_grasp: Grasp) -> None:
    """Finger 2 on the candidate of the same point that is for the weak kind."""
    count = limited_grasp.certificate.kinds[0].candidates
    candidates = limited_grasp.chosen + np.array([0, count, 0])
    contacts = replace(limited_grasp.contacts, strength=np.array([1.0, 0.5, 0.5]))
    claims = failures(replace(limited_grasp, chosen=candidates, contacts=contacts))
    assert "the contacts are candidates that keep the limits" in claims


@pytest.mark.parametrize("loosened", ["strength", "kinds"])
def test_a_bound_that_looser_limits_would_break_is_noticed(limited_grasp: Grasp, loosened: str) -> None:
    strong, weak = limited_grasp.certificate.kinds
    if loosened == "strength":
        certificate = replace(limited_grasp.certificate, kinds=(strong, replace(weak, strength=0.55)))
    else:
        certificate = replace(limited_grasp.certificate, kinds=())
    assert any("need less than" in claim for claim in failures(replace(limited_grasp, certificate=certificate)))


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


def test_wrong_moments_in_all_that_the_search_uses_are_noticed(
    prism: RigidObject, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nothing that verifies takes its moments from where the search does."""

    def halved(points: Floats, reference_point: Floats) -> Floats:
        maps = grasp_maps(points, reference_point)
        maps[:, 3:] /= 2
        return maps

    for name, module in list(sys.modules.items()):
        if name.startswith("planner.") and hasattr(module, "grasp_maps"):
            monkeypatch.setattr(module, "grasp_maps", halved)
    wrong = plan(GraspProblem(prism, make_task("paper", prism), make_candidates(prism, "20", 0.5), fingers=3))
    claims = failures(wrong)
    assert "the forces balance every wrench" in claims
    assert "an independent solver finds the same forces for every wrench" in claims
