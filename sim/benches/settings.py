"""Everything that defines another group's test of a grasp: world, fingers, tugs and what counts as a pass."""

from dataclasses import dataclass

from sim.scene.physics import Physics
from sim.trial.force_law import FingerLaw


@dataclass(frozen=True, kw_only=True)
class BenchSettings(Physics, FingerLaw):
    """One published protocol, emulated with fingertips in real metres, newtons and kilograms."""

    name: str
    """Says where it comes from and that fingertips stand in for the hand."""

    # Object
    object_mass: float
    """The protocol's own mass, whatever the object weighs [kg]; its inertia is scaled along."""

    # Contact
    friction: float
    """The protocol's own sliding friction, whatever was planned."""

    torsional_friction: float = 0.0
    """The protocol's own resistance to turning about the contact normal, whatever was planned [m]."""

    # Fingers: the emulation's own
    stiffness: float = 1000.0
    """Stiffness of a fingertip [N/m]: a joint of 5 N m/rad, DexGraspBench's hands, at 7 cm."""

    tip_mass: float = 0.05
    """Mass of a fingertip [kg]."""

    # Schedule
    squeeze_time: float
    """Seconds in which the fingers close and the squeeze grows [s]."""

    tugs: tuple[tuple[tuple[float, float, float], ...], ...]
    """Unit directions in body axes: one simulation per row, its tugs one after another."""

    tug_time: float
    """Seconds of each tug [s]."""

    tug_acceleration: float
    """Force of a tug per mass of the object, at its centre of mass, without torque [m/s^2]."""

    # Pass
    check_interval: float
    """The object's motion is looked at every so many seconds of a tug and at the end [s]."""

    translation_limit: float | None = None
    """Largest displacement of the body's origin at any look [m]; None: any."""

    rotation_limit: float | None = None
    """Largest rotation of the object at any look [rad]; None: any."""

    contact_at_end: bool = False
    """Whether every fingertip must touch the object at the end."""
