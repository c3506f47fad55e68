"""The one error tree: everything that is the caller's to mend.

Infeasible and out-of-time are statuses of a result, never exceptions. A message says what was wrong,
its value, what is allowed and what to do.
"""


class RhograspError(Exception):
    """Root of every error this project raises on purpose."""


class ObjectError(RhograspError):
    """The MJCF object cannot be read as one rigid body with a collision surface."""


class MasslessError(ObjectError):
    """Something in the object's file moves and has no mass, which MuJoCo does not compile."""


class CandidateError(RhograspError):
    """The candidate contact points cannot be made, or are not on the surface."""


class TaskError(RhograspError):
    """The required external force set is empty, malformed or not finite."""


class LimitsError(RhograspError):
    """The limits of the fingers are malformed, contradict each other, or do not fit the object."""


class ContactError(RhograspError):
    """Contact points, normals or friction coefficients are malformed."""


class SettingError(RhograspError):
    """A setting of a search or of a measurement is out of range."""


class GraspFileError(RhograspError):
    """A grasp file is missing, truncated, inconsistent, or of an unknown version."""


class OutputError(RhograspError):
    """A result cannot be written where the user asked."""


class RenderingError(RhograspError):
    """A picture cannot be drawn: no OpenGL, or a package is missing."""


class SolverError(RhograspError):
    """A convex solver stopped without an answer or a certificate."""


class SimulationError(RhograspError):
    """MuJoCo cannot build or step the validation scene as planned."""
