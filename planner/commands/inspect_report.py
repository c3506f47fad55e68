"""What `grasp-inspect` says."""

from collections.abc import Iterator, Sequence

import numpy as np
from scipy.spatial import cKDTree

from planner.arrays import Floats
from planner.candidates.candidates import Candidates
from planner.candidates.confirmed import confirmed_candidates
from planner.counted import counted
from planner.millimetres import in_mm, point_in_mm
from planner.objects.graspable import Graspable
from planner.objects.mass_doubts import union_volume
from planner.objects.mjcf.compiled import compile_source
from planner.objects.mjcf.model_tree import body_tree
from planner.objects.mjcf.visual import visual_difference, warn_of_difference
from planner.objects.object_source import ObjectSource
from planner.objects.parts.polyhedron import Polyhedron
from planner.objects.parts.primitives import Primitive
from planner.objects.planar.planar_object import PlanarObject
from planner.objects.pose import Pose
from planner.objects.rigid_object import ConvexPart, RigidObject
from planner.objects.surface.coincident import ON_SURFACE, covered_parts
from planner.objects.surface.survey import survey_surface

WORLD = 0

SAME_AXES = 1e-6
"""Angle below which a body is not turned [rad]."""

MOST_PAIRS = 5
"""Pairs of parts with common faces that are named."""


def bodies(source: ObjectSource) -> Iterator[str]:
    """The bodies of a file, indented below their parents.

    Raises:
        ObjectError: If the file cannot be compiled.
    """
    model, _ = compile_source(source)
    tree = body_tree(model)
    depths = [0]
    for body in range(1, len(tree.names)):
        parent = int(tree.parents[body])
        depths.append(depths[parent] + 1)
        indent = "  " * (depths[body] - 1)
        yield (
            f"body        {indent}{tree.names[body]}: {tree.masses[body]:.4g} kg, "
            f"{counted(tree.colliding_geoms[body], 'colliding geom')}, {counted(len(tree.joints[body]), 'joint')}"
        )
    if tree.colliding_geoms[WORLD]:
        yield f"body        world: {counted(tree.colliding_geoms[WORLD], 'colliding geom')} that no body holds"


def object_lines(rigid_object: RigidObject) -> Iterator[str]:
    """Body, mass, size and surface of an object, what of it collides, and how that differs from what is seen."""
    yield f"object      body {rigid_object.body!r}, sha256 {rigid_object.sha256[:12]}…"
    volume = union_volume(rigid_object)
    density = f", {rigid_object.mass / volume:.4g} kg per m3 of {1e6 * volume:.4g} cm3 that collide" if volume else ""
    yield f"mass        {rigid_object.mass:.4g} kg{density}"
    yield f"centre      {point_in_mm(rigid_object.center_of_mass)} mm, the centre of mass in the body frame"
    yield f"size        {' x '.join(in_mm(edge) for edge in rigid_object.extent)} mm"
    yield f"pose        {_placed(rigid_object.pose_in_file)}"
    width = max(len(part.geom) for part in rigid_object.parts)
    for number, (part, torsion) in enumerate(zip(rigid_object.parts, rigid_object.torsions, strict=True)):
        twist = f", torsion {in_mm(torsion, 3)} mm" if torsion else ""
        apart = "; not for fingers (--body)" if number in rigid_object.untouchable else ""
        yield f"collides    {part.geom:{width}}  {_shape(part)}, friction {part.friction:g}{twist}{apart}"
    yield from _merged(rigid_object)
    difference = visual_difference(rigid_object)
    yield f"visual      {difference or 'no mesh to compare with what collides'}"
    warn_of_difference(rigid_object, difference)


def planar_lines(planar: PlanarObject) -> Iterator[str]:
    """Name, mass and outline of a planar object."""
    outline = planar.outline
    yield f"object      {planar.body!r}, planar, sha256 {planar.sha256[:12]}…"
    yield f"mass        {planar.mass:.4g} kg"
    yield f"centre      {point_in_mm(planar.center_of_mass)} mm, the centre of mass in the body frame"
    yield f"size        {' x '.join(in_mm(edge) for edge in planar.extent)} mm"
    yield (
        f"outline     {len(outline.corners)} corners, perimeter {in_mm(outline.lengths.sum())} mm, "
        f"friction {outline.friction:g}"
    )


def candidate_lines(seen: Graspable, candidates: Candidates, fingertip: float | None) -> Iterator[str]:
    """How many candidates there are, how far apart, what no finger reaches, and whether MuJoCo agrees."""
    points = candidates.contacts.points
    if isinstance(seen, RigidObject):
        survey = survey_surface(seen, fingertip)
        yield (
            f"surface     {1e4 * survey.outer:.4g} cm2 outside, of {1e4 * survey.whole:.4g} cm2 on all parts; "
            f"{1e4 * survey.reachable:.4g} cm2 leave room for a fingertip"
        )
        yield from _flush(seen, survey.shared)
        yield (
            f"unreachable {survey.unreachable_samples} of {survey.samples} random points on the parts: inside or too "
            "near other parts"
        )
    yield f"candidates  {len(candidates)}, {in_mm(_spacing(points), 3)} mm apart"
    if isinstance(seen, RigidObject):
        confirmed = confirmed_candidates(seen, candidates)
        yield (
            f"mujoco      confirms {len(confirmed.candidates)} of them, to {in_mm(confirmed.largest_height, 1)} mm "
            f"and {np.rad2deg(confirmed.largest_turn):.1g}°; {confirmed.off_surface} are off its surface, "
            f"{confirmed.turned} have another normal, {confirmed.crowded} touch another part"
        )


def _merged(rigid_object: RigidObject) -> Iterator[str]:
    """Geoms that add nothing to the union."""
    parts, size = rigid_object.parts, rigid_object.size
    for part, other in covered_parts(rigid_object).items():
        pair = f"{parts[min(part, other)].geom} and {parts[max(part, other)].geom}"
        if np.abs(parts[part].bounds() - parts[other].bounds()).max() <= ON_SURFACE * size:
            yield f"merged      geoms {pair} coincide: planned on as one{_slipperier(parts[part], parts[other])}"
        else:
            yield f"merged      geom {parts[part].geom} lies inside {parts[other].geom}: planned on as one"


def _flush(rigid_object: RigidObject, pairs: Sequence[tuple[int, int]]) -> Iterator[str]:
    """Geoms that share faces of the outside."""
    for first, second in ((rigid_object.parts[one], rigid_object.parts[two]) for one, two in pairs[:MOST_PAIRS]):
        yield (
            f"merged      faces of {first.geom} and {second.geom} coincide: planned on as one surface"
            f"{_slipperier(first, second)}"
        )
    if len(pairs) > MOST_PAIRS:
        yield f"merged      and faces of {len(pairs) - MOST_PAIRS} more pairs"


def _slipperier(first: ConvexPart, second: ConvexPart) -> str:
    """Whose friction counts where two parts share a surface."""
    if first.friction == second.friction:
        return ""
    return f", with the smaller friction, {min(first.friction, second.friction):g}"


def _shape(part: ConvexPart) -> str:
    """Type and size of a part; MuJoCo's size, of half lengths and radii, for what is no mesh."""
    if isinstance(part, Primitive):
        return f"{part.mjcf_type} of size {' '.join(in_mm(length) for length in part.size)} mm"
    edges = " x ".join(in_mm(edge) for edge in np.ptp(part.bounds(), axis=0))
    facets = f", {len(part.polygons)} facets" if isinstance(part, Polyhedron) else ""
    return f"hull of {edges} mm{facets}"


def _placed(pose: Pose) -> str:
    """Where the file places the body frame, in which everything else is said."""
    axis = ", ".join(f"{coordinate + 0.0:.4g}" for coordinate in pose.axis)
    turned = f"turned by {np.rad2deg(pose.angle):.4g}° about ({axis})" if pose.angle > SAME_AXES else "not turned"
    return f"the body frame lies at {point_in_mm(pose.position)} mm in the world of the file, {turned}"


def _spacing(points: Floats) -> float:
    """Median distance of a point to its nearest neighbour [m]."""
    if len(points) < 2:
        return 0.0
    distances, _ = cKDTree(points).query(points, k=2)
    return float(np.median(distances[:, 1]))
