"""The utilisation is the least friction that holds a force and a torque: a little more is enough, less is not."""

from dataclasses import replace

import numpy as np
import pytest

from planner.contact_models.friction_cone import utilisation
from planner.contact_models.hard_finger import HARD_FINGER
from planner.contact_models.models import model_of
from planner.contact_models.soft_finger import SOFT_FINGER
from planner.contacts import Contacts
from tests.strategies.force_problems import random_contacts, soft

FINGERS = 400


def loaded(torsion: np.ndarray) -> tuple[Contacts, np.ndarray, np.ndarray]:
    """Contacts with forces that push and torques, both of any share of the friction."""
    rng = np.random.default_rng(0)
    contacts = soft(random_contacts(rng, FINGERS, 3), torsion)
    forces = rng.normal(size=(FINGERS, 3)) + rng.uniform(2, 4, FINGERS)[:, None] * contacts.normals
    forces *= np.sign(np.einsum("id,id->i", forces, contacts.normals))[:, None]
    return contacts, forces, rng.normal(size=FINGERS) * contacts.torsions


@pytest.mark.parametrize("torsion", [0.0, 0.004])
def test_so_much_friction_holds_and_a_little_less_does_not(torsion: float) -> None:
    contacts, forces, torques = loaded(np.full(FINGERS, torsion))
    model = model_of(contacts)
    share = model.utilisation(forces, torques, contacts) / contacts.friction
    assert (share < 1).any()
    assert (share > 1).any()
    for factor, outside in ((1 + 1e-9, False), (1 - 1e-9, True)):
        other = replace(
            contacts, friction=factor * share * contacts.friction, torsion=factor * share * contacts.torsions
        )
        assert ((model.excess(forces, torques, other) > 0) == outside).all()


def test_what_does_not_twist_uses_what_a_hard_finger_does() -> None:
    contacts, forces, torques = loaded(np.where(np.arange(FINGERS) % 2, 0.004, 0.0))
    hard = utilisation(forces, contacts.normals)
    still = np.zeros(FINGERS)
    np.testing.assert_allclose(SOFT_FINGER.utilisation(forces, still, contacts), hard, rtol=1e-14)
    np.testing.assert_array_equal(HARD_FINGER.utilisation(forces, still, contacts), hard)
    twisting = SOFT_FINGER.utilisation(forces, torques, contacts)
    assert (twisting[1::2] > hard[1::2]).all()  # the control: the torque counts


def test_a_torque_counts_by_its_size_whichever_way_it_turns() -> None:
    contacts, forces, torques = loaded(np.full(FINGERS, 0.004))
    used = SOFT_FINGER.utilisation(forces, torques, contacts)
    np.testing.assert_array_equal(SOFT_FINGER.utilisation(forces, -torques, contacts), used)
    pressed = contacts.normals * 2.0
    twisted = SOFT_FINGER.utilisation(pressed, 2.0 * contacts.torsions, contacts)
    np.testing.assert_allclose(twisted, contacts.friction)  # tau = gamma f_n takes all of it


def test_what_no_friction_holds_takes_infinitely_much_and_nothing_takes_none() -> None:
    contacts, forces, torques = loaded(np.append(np.zeros(1), np.full(FINGERS - 1, 0.004)))
    used = SOFT_FINGER.utilisation(-forces, torques, contacts)
    assert np.isinf(used).all()
    assert np.isinf(SOFT_FINGER.utilisation(forces, torques + 1e-9, contacts)[0])  # a hard finger cannot twist
    assert not SOFT_FINGER.utilisation(0 * forces, 0 * torques, contacts).any()
    many = SOFT_FINGER.utilisation(np.stack([forces, forces]), np.stack([0 * torques, torques]), contacts)
    assert many.shape == (2, FINGERS)
