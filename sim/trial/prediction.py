"""What the theory says about a grasp and its wrenches, solved anew: the measurement trusts no file."""

import numpy as np

from planner.contact_models.models import model_of
from planner.contacts import Contacts, reach
from planner.forces.minimax import MinimaxForces


def predicted_caps(contacts: Contacts, reference_point: np.ndarray, wrenches: np.ndarray) -> np.ndarray:
    """phi of every wrench: the least force level that balances it within the friction cones, |f_i| <= s_i phi.

    Args:
        contacts: The grasp.
        reference_point: p_o, shape (d,) [m].
        wrenches: About p_o, shape (wrenches, D) [N, N m].

    Returns:
        Shape (wrenches,) [N]; infinite where no forces balance the wrench.
    """
    model = model_of(contacts)
    solver = MinimaxForces(len(contacts), contacts.dimension, model)
    maps, length = model.maps(contacts, reference_point), reach(contacts.points, reference_point)
    return np.array([solver.solve_arrays(maps, contacts.friction, wrench, length)[1] for wrench in wrenches])


def on_friction_limit(
    contacts: Contacts, reference_point: np.ndarray, wrenches: np.ndarray, margin: float
) -> np.ndarray:
    """Which wrenches need more than `margin` of the friction whatever the cap: no measurement can decide these.

    Args:
        contacts: The grasp.
        reference_point: p_o, shape (d,) [m].
        wrenches: About p_o, shape (wrenches, D) [N, N m].
        margin: Part of the friction, below 1.

    Returns:
        Shape (wrenches,).
    """
    slippery = contacts.with_friction(margin * contacts.friction)
    return ~np.isfinite(predicted_caps(slippery, reference_point, wrenches))
