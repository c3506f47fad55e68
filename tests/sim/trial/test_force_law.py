"""The force law: a spring about the feed-forward force, never beyond the cap."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from planner.arrays import Floats
from sim.trial.force_law import FingerLaw, saturated

VECTORS = arrays(float, (5, 3), elements=st.floats(-1e3, 1e3))
LAW = FingerLaw(tip_mass=0.01, stiffness=100.0, damping_ratio=1.0)
"""Its damping, 2 zeta sqrt(K m), is 2 N s/m."""
CAPS = arrays(float, (5,), elements=st.floats(1e-3, 1e3))


@given(forces=VECTORS, caps=CAPS)
def test_saturation_caps_the_norm_and_keeps_the_direction(forces: Floats, caps: Floats) -> None:
    shortened = saturated(forces, caps)
    norms = np.linalg.norm(forces, axis=1)
    np.testing.assert_allclose(np.linalg.norm(shortened, axis=1), np.minimum(norms, caps), rtol=1e-12, atol=1e-150)
    np.testing.assert_allclose(np.cross(shortened, forces), 0, atol=1e-9 * max(1.0, norms.max() ** 2))


@given(feed_forward=VECTORS, displacements=VECTORS, velocities=VECTORS, caps=CAPS)
def test_the_total_of_feed_forward_and_spring_respects_the_cap(
    feed_forward: Floats, displacements: Floats, velocities: Floats, caps: Floats
) -> None:
    forces = LAW.forces(feed_forward, displacements, velocities, caps)
    assert (np.linalg.norm(forces, axis=1) <= caps * (1 + 1e-12)).all()


def test_the_spring_pulls_back_and_the_damper_against_the_motion() -> None:
    moved, moving = np.array([0.01, 0, 0]), np.array([0, 0.2, 0])
    force = LAW.forces(np.array([0, 0, 1.0]), moved, moving, np.array(9.0))
    np.testing.assert_allclose(force, [-1.0, -0.4, 1.0])
