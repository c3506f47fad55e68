"""How MuJoCo computes: the settings of contacts and solver that every scene has.

The values are those of the measurement; each says what was wrong without it, out of 1,216 grasp and wrench pairs that
should all hold. MuJoCo's defaults cannot make this measurement.
"""

from dataclasses import dataclass

from sim.scene.dm_control_mjcf import mjcf


@dataclass(frozen=True, kw_only=True)
class Physics:
    """Contacts, solver and time step."""

    # Contact
    solref: tuple[float, float] = (0.002, 1.0)
    """Time constant [s] and damping ratio of a contact: two time steps, critical; 0.02 s fails 55 falsely."""

    solimp: tuple[float, float, float, float, float] = (0.999, 0.9999, 1e-3, 0.5, 2.0)
    """Constraint impedance; MuJoCo's 0.9 0.95 fails 1,190 falsely: soft friction creeps."""

    cone: str = "elliptic"
    """The circular cone of the prediction; a pyramidal one fails all 1,216."""

    impratio: float = 100.0
    """Friction-to-normal impedance; 1 fails 1,013 falsely, 10 fails 4, 30 to 1000 none."""

    # Solver
    timestep: float = 1e-3
    """Time step [s]; 4 ms fails 29 falsely, 0.25 to 1 ms none.

    2 ms fails 204 of 2,304 falsely on random grasps, and passes 11 falsely.
    """

    integrator: str = "implicitfast"
    """All integrators measured equal."""

    solver: str = "Newton"
    """Newton; conjugate gradients fail 1,086 falsely."""

    iterations: int = 50
    """Largest number of solver iterations; 10 fails 11 falsely."""

    tolerance: float = 1e-15
    """Solver tolerance; MuJoCo's 1e-8 fails 442 falsely, 1e-10 fails 47, 1e-12 and below none."""

    noslip_iterations: int = 0
    """No post-processing of friction: it is not needed at this tolerance."""

    ccd_tolerance: float = 1e-8
    """Tolerance of mesh and ellipsoid collisions [m]."""

    jacobian: str = "dense"
    """Dense: the sparse factorisation of mujoco-core 4.0.0 has a bug."""

    def set_options(self, root: mjcf.RootElement) -> None:
        """Write them into a scene. No gravity: W_R holds every load; no restart: what diverges must not look held."""
        root.option.set_attributes(
            timestep=self.timestep,
            integrator=self.integrator,
            cone=self.cone,
            jacobian=self.jacobian,
            solver=self.solver,
            iterations=self.iterations,
            tolerance=self.tolerance,
            impratio=self.impratio,
            noslip_iterations=self.noslip_iterations,
            ccd_tolerance=self.ccd_tolerance,
        )
        root.option.flag.set_attributes(gravity="disable", autoreset="disable")
