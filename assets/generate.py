"""Makes this project's own objects: `python assets/generate.py` writes the same files every time.

Every object is one MJCF that loads alone: one free body named like its folder. Curved surfaces are meshes, so that
the planner and the simulator see the same facets. Concave objects are convex geoms that overlap a little: their
hidden faces lie inside their neighbours.

    prism      Case III of Watanabe and Yoshikawa: their unit of length is 1 cm, their unit of force 1 N
    box        60 x 40 x 30 mm
    cylinder   radius 20 mm, height 80 mm, 96 sides
    ellipsoid  semi-axes 30, 22 and 18 mm, 2048 facets
    bracket    an L of two plates
    mug        a hollow wall of 16 plates, a bottom and a handle

Planar objects are TOML files of one outline each. They are sized like Cases I and II of that paper, whose own outlines
are printed as figures only, and weigh what it assumes, 0.01 N per cm^2. All edges are whole numbers of 5 mm cells:

    planar/convex   a plate of 80 x 70 mm with one corner cut off, 56 cells
    planar/concave  an open-ended spanner, 86 cells
"""

import math
from itertools import pairwise
from pathlib import Path

Point = tuple[float, float, float]
Triangle = tuple[int, int, int]
Mesh = tuple[list[Point], list[Triangle]]
Corner = tuple[float, float]

FOLDER = Path(__file__).resolve().parent

MJCF = """\
<!-- Made by assets/generate.py: change it there. -->
<mujoco model="{name}">
  <default>
    <geom density="{density}" friction="{friction} 0.005 0.0001"/>
  </default>
{asset}  <worldbody>
    <body name="{name}">
      <freejoint/>
{geoms}
    </body>
  </worldbody>
</mujoco>
"""

PLANAR = """\
# Made by assets/generate.py: change it there.
format = "rhograsp.planar"
name = "{name}"
mass = {mass}  # [kg]
friction = {friction}
thickness = {thickness}  # [m]
outline = [  # [m]
{corners}
]
"""

ASSET = """\
  <asset>
    <mesh name="{name}" {source}/>
  </asset>
"""


def main() -> None:
    """Write every file."""
    for name, text in files().items():
        path = FOLDER / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8", newline="\n")


def files() -> dict[str, str]:
    """The text of every generated file by its path relative to this folder."""
    box = [geom("box", "box", size=(0.03, 0.02, 0.015))]
    return {
        "prism/prism.xml": prism(),
        "box/box.xml": mjcf("box", box, density=700, friction=0.5),
        "cylinder/cylinder.xml": mesh_object("cylinder", 'file="cylinder.obj"', density=1000, friction=0.5),
        "cylinder/cylinder.obj": wavefront(cylinder(radius=0.02, height=0.08, sides=96)),
        "ellipsoid/ellipsoid.xml": mesh_object("ellipsoid", 'file="ellipsoid.obj"', density=1000, friction=0.5),
        "ellipsoid/ellipsoid.obj": wavefront(ellipsoid((0.03, 0.022, 0.018), subdivisions=4)),
        "bracket/bracket.xml": mjcf("bracket", bracket(), density=2700, friction=0.4),
        "mug/mug.xml": mjcf("mug", mug(), density=2000, friction=0.5),
        "planar/convex.toml": planar("plate", plate()),
        "planar/concave.toml": planar("spanner", spanner()),
    }


def prism() -> str:
    """Right isosceles triangular prism, legs 4 cm, height 2 cm, centroid at the origin, weight 0.16 N."""
    near, far = -0.04 / 3, 0.08 / 3
    corners = [(x, y, z) for x, y in ((near, near), (far, near), (near, far)) for z in (-0.01, 0.01)]
    vertices = "  ".join(numbers(corner) for corner in corners)
    return mesh_object("prism", f'vertex="{vertices}"', density=1e4 / 9.81, friction=0.3)


def bracket() -> list[str]:
    """A base plate and an upright plate that stands in it, 1 mm from the base's edges."""
    return [
        geom("base", "box", size=(0.04, 0.02, 0.004)),
        geom("upright", "box", size=(0.004, 0.019, 0.03), pos=(-0.035, 0, 0.03)),
    ]


def mug(plates: int = 16) -> list[str]:
    """Wall of flat plates (outer faces 40 mm from the axis, 4 mm thick, 90 mm high), bottom, C-shaped handle."""
    half_width = 0.04 * math.tan(math.pi / plates)  # the outer edges of neighbours meet
    wall = []
    for plate in range(plates):
        angle = 2 * math.pi * plate / plates
        position = (0.038 * math.cos(angle), 0.038 * math.sin(angle), 0.045)
        turn = (0, 0, 360 * plate / plates)  # [deg]
        wall.append(geom(f"wall{plate}", "box", size=(0.002, half_width, 0.045), pos=position, euler=turn))
    return [
        *wall,
        geom("bottom", "cylinder", size=(0.038, 0.003), pos=(0, 0, 0.005)),
        geom("handle_low", "box", size=(0.011, 0.005, 0.004), pos=(0.049, 0, 0.026)),
        geom("handle_high", "box", size=(0.011, 0.005, 0.004), pos=(0.049, 0, 0.064)),
        geom("handle_grip", "box", size=(0.004, 0.006, 0.027), pos=(0.062, 0, 0.045)),
    ]


def plate() -> list[Corner]:
    """80 x 70 mm less a triangle with legs of 40 and 30 mm: 50 cm^2, the centroid at the origin."""
    left, bottom = -36.8, -32.0
    corners = [(0, 0), (80, 0), (80, 40), (40, 70), (0, 70)]
    return [(left + x, bottom + y) for x, y in corners]


def spanner() -> list[Corner]:
    """A head of 65 x 60 mm with a gap of 30 x 20 mm on a handle of 60 x 20 mm: 45 cm^2, the centroid at the origin."""
    head = -13.5  # where the handle meets the head
    upper = [
        (35, 10),
        (65, 10),
        (65, 30),
        (0, 30),
        (0, 10),
        (-60, 10),
    ]  # from the bottom of the gap to the handle's end
    corners = [*upper, *[(x, -y) for x, y in reversed(upper)]]
    return [(head + x, y) for x, y in corners]


def planar(name: str, corners: list[Corner]) -> str:
    """TOML of a planar object with the weight the paper gives it; corners counter-clockwise [mm]."""
    doubled = [a[0] * b[1] - b[0] * a[1] for a, b in pairwise([*corners, corners[0]])]
    weight = 0.01 * sum(doubled) / 2 / 100  # [N]
    return PLANAR.format(
        name=name,
        mass=numbers((weight / 9.81,)),
        friction=0.3,
        thickness=0.01,
        corners="\n".join(f"    [{numbers((x / 1000,))}, {numbers((y / 1000,))}]," for x, y in corners),
    )


def cylinder(radius: float, height: float, sides: int) -> Mesh:
    """Regular prism around the z axis, its corners on the circle."""
    angles = [2 * math.pi * side / sides for side in range(sides)]
    ring = [(radius * math.cos(angle), radius * math.sin(angle)) for angle in angles]
    points = [(x, y, z) for z in (-height / 2, height / 2) for x, y in ring]
    faces: list[tuple[int, ...]] = [tuple(reversed(range(sides))), tuple(range(sides, 2 * sides))]
    for side in range(sides):
        after = (side + 1) % sides
        faces.append((side, after, sides + after, sides + side))
    return points, [triangle for face in faces for triangle in fan(face)]


def fan(face: tuple[int, ...]) -> list[Triangle]:
    """Triangles of a convex polygon, all sharing its first corner."""
    return [(face[0], second, third) for second, third in pairwise(face[1:])]


def ellipsoid(semi_axes: Point, subdivisions: int) -> Mesh:
    """Octahedron whose triangles are split in four again and again on the unit sphere, then stretched."""
    points: list[Point] = [(1, 0, 0), (0, 1, 0), (0, 0, 1), (-1, 0, 0), (0, -1, 0), (0, 0, -1)]
    triangles = [(0, 1, 2), (1, 3, 2), (3, 4, 2), (4, 0, 2), (1, 0, 5), (3, 1, 5), (4, 3, 5), (0, 4, 5)]
    middles: dict[tuple[int, int], int] = {}

    def middle(first: int, second: int) -> int:
        edge = (min(first, second), max(first, second))
        if edge not in middles:
            middles[edge] = len(points)
            points.append(direction([a + b for a, b in zip(points[first], points[second], strict=True)]))
        return middles[edge]

    for _ in range(subdivisions):
        split: list[Triangle] = []
        for a, b, c in triangles:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            split += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        triangles = split
    return [(semi_axes[0] * x, semi_axes[1] * y, semi_axes[2] * z) for x, y, z in points], triangles


def direction(vector: list[float]) -> Point:
    """The unit vector along the vector."""
    x, y, z = vector
    length = math.sqrt(x * x + y * y + z * z)
    return x / length, y / length, z / length


def mesh_object(name: str, source: str, *, density: float, friction: float) -> str:
    """MJCF of one body made of one mesh, its vertices in a file or inline."""
    return mjcf(
        name,
        [f'      <geom name="{name}" type="mesh" mesh="{name}"/>'],
        density=density,
        friction=friction,
        asset=ASSET.format(name=name, source=source),
    )


def mjcf(name: str, geoms: list[str], *, density: float, friction: float, asset: str = "") -> str:
    """MJCF of one free body [kg/m^3]."""
    return MJCF.format(name=name, geoms="\n".join(geoms), density=numbers((density,)), friction=friction, asset=asset)


def geom(name: str, type: str, **vectors: tuple[float, ...]) -> str:
    """One line of MJCF: a geom and its attributes [m, deg]."""
    attributes = "".join(f' {key}="{numbers(value)}"' for key, value in vectors.items())
    return f'      <geom name="{name}" type="{type}"{attributes}/>'


def wavefront(mesh: Mesh) -> str:
    """The mesh as Wavefront OBJ."""
    points, triangles = mesh
    lines = ["# Made by assets/generate.py: change it there."]
    lines += [f"v {numbers(point)}" for point in points]
    lines += ["f " + " ".join(str(corner + 1) for corner in triangle) for triangle in triangles]
    return "\n".join(lines) + "\n"


def numbers(values: tuple[float, ...]) -> str:
    """Nine digits, down to a picometre: what any machine's sine and cosine agree on, and no negative zeros."""
    return " ".join(f"{round(value, 12) + 0.0:.9g}" for value in values)


if __name__ == "__main__":
    main()
