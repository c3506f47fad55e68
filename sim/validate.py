"""One verb: measure in MuJoCo whether a grasp's rho is true.

With the cap slightly above rho every wrench must be held; with the cap slightly below it the critical
wrench must slip. The second is the negative control: a test that cannot fail would prove nothing.
"""

from dataclasses import dataclass
from importlib.metadata import version

import mujoco
import numpy as np

from planner.contacts import Contacts
from planner.errors import SimulationError
from planner.objects.rigid_object import RigidObject
from sim.experiment import check_wrenches, set_up
from sim.measurement import Measurement
from sim.protocol import ACTIVE, ValidationProtocol
from sim.static_check import StaticCheck
from sim.verdict import objections


@dataclass(frozen=True, eq=False, kw_only=True)
class Validation:
    """Verdict, evidence and the settings under which it was gathered."""

    verdict: bool
    """Whether rho is confirmed."""

    reasons: tuple[str, ...]
    """Why not, one sentence each; empty when confirmed."""

    rigid_object: RigidObject
    """What was held."""

    rho: float
    """Predicted force cap [N]."""

    critical_wrench: int
    """Index of the wrench that decides rho."""

    phi: np.ndarray
    """Predicted cap of every wrench, shape (wrenches,) [N]."""

    planned_friction: np.ndarray
    """Shape (contacts,)."""

    simulated_friction: np.ndarray
    """Shape (contacts,)."""

    static: StaticCheck
    """Whether the fingertips touch what was planned; if not, nothing was simulated."""

    vertices: Measurement | None
    """Every wrench with the cap above rho, in order."""

    control: Measurement | None
    """The critical wrench with the cap below rho; must slip."""

    protocol: ValidationProtocol

    versions: dict[str, str]
    """Of the packages that can change the outcome."""


def validate(
    rigid_object: RigidObject,
    contacts: Contacts,
    reference_point: np.ndarray,
    wrenches: np.ndarray,
    rho: float,
    critical_wrench: int,
    phi: np.ndarray,
    protocol: ValidationProtocol = ACTIVE,
    simulated_friction: np.ndarray | None = None,
) -> Validation:
    """Measure whether the grasp holds every wrench just above rho and loses the critical one just below.

    Args:
        rigid_object: What the fingers hold.
        contacts: The grasp, with the planned friction.
        reference_point: p_o, shape (3,) [m].
        wrenches: Vertices of W_R about p_o, shape (wrenches, 6) [N, N m].
        rho: Predicted force cap [N].
        critical_wrench: Index of the wrench that decides rho.
        phi: Predicted cap of every wrench, shape (wrenches,) [N].
        protocol: Settings and thresholds.
        simulated_friction: Friction in the simulator, shape (contacts,); the planned one if None.

    Raises:
        SimulationError: When the experiment cannot be built or run as described.
    """
    check_wrenches(wrenches, phi)
    if not 0 <= critical_wrench < len(wrenches):
        raise SimulationError(f"critical wrench {critical_wrench} is not an index of {len(wrenches)} wrenches")
    friction = contacts.friction if simulated_friction is None else np.asarray(simulated_friction, dtype=float)
    experiment = set_up(rigid_object, contacts, reference_point, rho, friction, protocol)
    vertices = control = None
    reasons = experiment.static.reasons()
    if not reasons:
        loads = np.vstack([wrenches, wrenches[critical_wrench]])
        caps = np.append(np.full(len(wrenches), protocol.hold_factor), protocol.control_factor)
        outcome = experiment.measure(loads, caps)
        vertices, control = outcome.rows(slice(0, -1)), outcome.rows(slice(-1, None))
        reasons = objections(vertices, control, critical_wrench, protocol)
    return Validation(
        verdict=not reasons,
        reasons=reasons,
        rigid_object=rigid_object,
        rho=float(rho),
        critical_wrench=int(critical_wrench),
        phi=phi,
        planned_friction=contacts.friction,
        simulated_friction=friction,
        static=experiment.static,
        vertices=vertices,
        control=control,
        protocol=protocol,
        versions={
            "mujoco": mujoco.__version__,
            "numpy": np.__version__,
            "dm-control": version("dm-control"),
        },
    )
