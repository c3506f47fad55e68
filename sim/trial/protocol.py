"""The measuring protocol: every constant of the experiment and every threshold of its verdict.

The experiment is non-dimensional (sim/scene/units.py): the farthest contact lies `reach` from the reference
point and the predicted rho is one newton. How MuJoCo computes is in sim/scene/physics.py, the fingers in
sim/trial/force_law.py.
"""

from dataclasses import dataclass, replace

from planner.arrays import Mask
from planner.contacts import Contacts
from planner.objects.mjcf.touch import CLEARANCE, ON_SURFACE
from sim.scene.physics import Physics
from sim.trial.final_state import FinalState
from sim.trial.force_law import FingerLaw


@dataclass(frozen=True, kw_only=True)
class ValidationProtocol(Physics, FingerLaw):
    """Settings of the scene, the schedule and the verdict, beside those of contacts, solver and fingers."""

    name: str
    """Name and version: one name, one set of values."""

    # The non-dimensional scene
    reach: float = 0.05
    """Distance of the farthest contact from the reference point [m]."""

    object_mass: float = 0.1
    """Mass of the object [kg]: the test is quasi-static, so any from 0.02 to 0.1 serves; 0.5 holds back slips."""

    object_damping: float = 0.5
    """Drag on the object's motion [N s/m], times reach^2 on its rotation: none at rest, so statics do not feel it.

    An object on capped fingertips below it is a pendulum upside down; without drag it tips, without any slip, by up
    to 2e-3 within the hold, with it by 2e-4. Drag also holds slips back: under a load of a fiftieth of the cap
    a fingertip slips at 0.995 by 2.1e-4 without it, by 1.7e-4 with it, by 1.4e-4 with 1.
    """

    # Fingers
    preload: float = 0.5
    """Press of every finger along its normal before the load, and the largest internal force without one, relative
    to the cap."""

    # Schedule
    preload_time: float = 0.05
    """Seconds in which the preload grows [s]; applied at once it makes grasps slip that hold."""

    ramp_time: float = 0.15
    """Seconds in which wrench and forces grow to their full values [s]."""

    hold_time: float = 0.35
    """Seconds under the full wrench [s]; in twice as many the pendulum of `object_damping` tips too far."""

    # Geometry
    touch_tolerance: float = ON_SURFACE
    """Largest gap or overlap of a fingertip and the object before the test, relative to the object's size."""

    clearance: float = CLEARANCE
    """Least distance of a fingertip from any other surface of the object, relative to the object's size."""

    # Verdict
    loaded: float = 0.01
    """A finger is judged when its force exceeds this part of the cap."""

    slip_tolerance: float = 1e-4
    """Largest slip of a held fingertip, relative to the reach: seen 1e-5 above the cap, 1.7e-4 at 0.995 of it.

    On the friction limit, where the load is a hundredth of the cap and less, slips are too slow for any tolerance.
    """

    spin_tolerance: float = 6e-5
    """Largest spin of a held soft fingertip about its normal [rad].

    It starts slowly: below the cap the object turns about the fingers' line long before it has moved by
    `motion_tolerance`. Seen at most 3.5e-5 at 1.005 and 1.01 of the cap; at 0.995, where nothing else tells, at least
    1.3e-4 (264 tests).
    """

    motion_tolerance: float = 1e-3
    """Largest motion of a held object: translation relative to the reach, rotation in radians."""

    gone: float = 3.0
    """An object that moved so many motion tolerances is lost, and its simulation ends."""

    hold_factor: float = 1.02
    """Every wrench must be held with the cap at this multiple of rho."""

    control_factor: float = 0.98
    """The critical wrench must slip with the cap at this multiple of rho."""

    # Controls: what must happen if the experiment is to be believed
    friction_factor: float = 0.9
    """With the planned friction multiplied by this, as often as it takes until theory says that some wrench is lost,
    exactly the predicted wrenches must slip."""

    least_friction: float = 0.05
    """Part of the planned friction below which the search for such a loss ends: friction does not limit this grasp,
    and every wrench must be held with the first part."""

    torsion_factors: tuple[float, ...] = (0.9, 0.8, 0.0)
    """With the planned torsional friction of soft fingers multiplied by each of these, exactly the predicted wrenches
    must slip."""

    least_torsion: float = 0.1
    """A wrench that this part of the planned torsional friction still holds is too near to call without any."""

    friction_margin: float = 0.98
    """A wrench that no cap holds with the planned friction multiplied by this lies on the friction limit. Whatever
    multiplies friction here multiplies the torsional friction too, as for a patch on other materials."""

    ambiguity: float = 0.01
    """Wrenches whose predicted cap is within this part of the simulated one are too near to call."""

    displacement: float = 0.02
    """One contact is moved by this part of the object's size and rho predicted anew."""

    creep_tolerance: float = 2e-5
    """Largest slip of fingers that only squeeze, relative to the reach: a fifth of what a slip is."""

    @property
    def spin_of_reach(self) -> float:
        """The spin that is as much of what a hold allows as a slip of the reach is [rad]."""
        return self.spin_tolerance / self.slip_tolerance

    def lost(self, state: FinalState) -> Mask:
        """Which objects moved too far to come back, shape (simulations,)."""
        far = self.gone * self.motion_tolerance
        return (state.translations > far * self.reach) | (state.rotations > far)

    @property
    def duration(self) -> float:
        """Length of one trial [s]."""
        return self.preload_time + self.ramp_time + self.hold_time


ACTIVE = ValidationProtocol(name="rhograsp.active/2")
"""Finger forces adapt to each wrench, which is what rho means."""

STRICT = replace(ACTIVE, name="rhograsp.active-strict/2", hold_factor=1.005, control_factor=0.995)
"""The same with a four times narrower band around rho."""

ACTIVE_SOFT = replace(
    ACTIVE,
    name="rhograsp.active-soft/1",
    impratio=1000.0,
    noslip_iterations=3,
    hold_time=0.7,
)
"""Fingers with torsional friction, some or all of them.

A contact resists a twist (mu / gamma)^2 times more softly than a slide, so fingers at their limit creep by spinning:
of 264 tests at 1.01 of the cap 99 fail falsely with `impratio` 100 and no `noslip_iterations`, 42 with 1000, 47 with
10,000, where the solver no longer converges; with three iterations 2 at 100, none at 1000, 29 at 10,000. In half the
hold time 2 of 264 pass falsely at 0.995.
"""

STRICT_SOFT = replace(
    ACTIVE_SOFT,
    name="rhograsp.active-soft-strict/1",
    hold_factor=STRICT.hold_factor,
    control_factor=STRICT.control_factor,
)
"""The same with the narrower band."""


def active_protocol(contacts: Contacts, *, strict: bool = False) -> ValidationProtocol:
    """The protocol for fingers that adapt at such contacts.

    Args:
        contacts: The grasp.
        strict: With the narrower band around rho.
    """
    if contacts.torsions.any():
        return STRICT_SOFT if strict else ACTIVE_SOFT
    return STRICT if strict else ACTIVE
