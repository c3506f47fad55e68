"""One MJCF geom per convex part of the object, of the type MuJoCo collided it as in the object's own file."""

from planner.errors import SimulationError
from planner.objects.parts.polyhedron import Polyhedron
from planner.objects.parts.primitives import Primitive
from planner.objects.rigid_object import ConvexPart
from sim.scene.dm_control_mjcf import mjcf
from sim.scene.units import Units


def add_part(body: mjcf.Element, name: str, part: ConvexPart, units: Units) -> mjcf.Element:
    """Add the part to a body whose frame has the axes of B and its origin at the reference point.

    The geom by itself collides with nothing: contacts are listed pair by pair.

    Args:
        body: The MJCF body.
        name: Name of the new geom.
        part: The part, in the body frame, SI.
        units: Map to the units of the experiment.

    Raises:
        SimulationError: If the kind of part is unknown.
    """
    if isinstance(part, Primitive):
        position = units.points(part.pose.position)
        shape = {"pos": position, "quat": part.pose.quaternion, "size": part.size * units.length}
    elif isinstance(part, Polyhedron):
        vertices = units.points(part.vertices).ravel()
        shape = {"mesh": body.root.asset.add("mesh", name=name, vertex=vertices, inertia="convex")}
    else:
        raise SimulationError(f"geom '{part.geom}' has no MJCF counterpart to simulate: {type(part).__name__}")
    return body.add("geom", name=name, type=part.mjcf_type, contype=0, conaffinity=0, **shape)
