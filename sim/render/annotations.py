"""Shapes added to a drawn scene: cylinders, cones, spheres, arrows and arcs, in world coordinates [m]."""

from dataclasses import dataclass
from itertools import pairwise

import mujoco
import numpy as np

from planner.arrays import Floats, Singles
from planner.contacts import contact_frames
from sim.render.palette import rgba
from sim.render.proportions import arc, arc_head, arrow_head

SPHERE = mujoco.mjtGeom.mjGEOM_SPHERE
CYLINDER = mujoco.mjtGeom.mjGEOM_CYLINDER
CAPSULE = mujoco.mjtGeom.mjGEOM_CAPSULE
LINE = mujoco.mjtGeom.mjGEOM_LINE
MESH = mujoco.mjtGeom.mjGEOM_MESH


@dataclass(frozen=True, eq=False, kw_only=True)
class Annotations:
    """Adds shapes to one scene."""

    scene: mujoco.MjvScene

    model: mujoco.MjModel
    """Whose meshes are drawn."""

    head: int
    """Mesh of an arrow's head: a cone of height and radius 1, its apex at the origin, opening along -z."""

    def sphere(self, center: Floats, radius: float, color: str) -> None:
        """A ball."""
        self._add(SPHERE, np.full(3, radius), center, np.eye(3), rgba(color))

    def line(self, start: Floats, stop: Floats, width: float, color: str, opacity: float = 1.0) -> None:
        """A line of a width in pixels, which no light shades."""
        self._connector(LINE, width, start, stop, color, opacity)

    def rod(self, start: Floats, stop: Floats, radius: float, color: str) -> None:
        """A thin rod with round ends."""
        self._connector(CAPSULE, radius, start, stop, color)

    def cone(self, mesh: int, apex: Floats, axis: Floats, height: float, color: str, opacity: float) -> None:
        """A cone mesh of height 1 made as large as `height`; it opens along `axis`."""
        self._mesh(mesh, apex, -axis, np.full(3, height), color, opacity)

    def arrow(self, tip: Floats, vector: Floats, radius: float, color: str) -> None:
        """An arrow of the vector's length that ends at `tip`; none for no vector."""
        length = float(np.linalg.norm(vector))
        if not length > 0:
            return
        axis, (head, wide) = vector / length, arrow_head(length, radius)
        self._connector(CYLINDER, radius, tip - vector, tip - head * axis, color)
        self._mesh(self.head, tip, axis, np.array([wide, wide, head]), color, 1.0)

    def turn(self, center: Floats, axis: Floats, share: float, size: float, radius: float, color: str) -> None:
        """An arc about a unit axis, up to three quarters long, with a head that says which way it turns."""
        points, heading = arc(axis, share, size)
        for start, stop in pairwise(center + points):
            self.rod(start, stop, radius, color)
        length, wide = arc_head(share, radius)
        tip = center + points[-1] + length * heading
        self._mesh(self.head, tip, heading, np.array([wide, wide, length]), color, 1.0)

    def _connector(
        self, kind: mujoco.mjtGeom, width: float, start: Floats, stop: Floats, color: str, opacity: float = 1.0
    ) -> None:
        geom = self._add(kind, np.zeros(3), np.zeros(3), np.eye(3), rgba(color, opacity))
        mujoco.mjv_connector(geom, kind, width, start, stop)

    def _mesh(self, mesh: int, apex: Floats, axis: Floats, scale: Floats, color: str, opacity: float) -> None:
        """A mesh whose z axis is turned to `axis` and whose axes are scaled: MuJoCo multiplies by any matrix."""
        axis, first, second = contact_frames(axis[None])[0].T
        axes = np.column_stack([first, second, axis]) * scale
        own = np.zeros(9)  # MuJoCo keeps a mesh in its own inertial frame
        mujoco.mju_quat2Mat(own, self.model.mesh_quat[mesh])
        place = apex + axes @ self.model.mesh_pos[mesh]
        geom = self._add(MESH, np.zeros(3), place, axes @ own.reshape(3, 3), rgba(color, opacity))
        geom.dataid = 2 * mesh  # even: the mesh; odd: its convex hull

    def _add(
        self, kind: mujoco.mjtGeom, size: Floats, position: Floats, axes: Floats, color: Singles
    ) -> mujoco.MjvGeom:
        """The next geom of the scene."""
        geom = self.scene.geoms[self.scene.ngeom]
        mujoco.mjv_initGeom(geom, kind, size, position, axes.ravel(), color)
        self.scene.ngeom += 1
        return geom
