"""Which packages made a file: those whose other versions could have made another."""

from importlib.metadata import version

PACKAGES = ("rhograsp", "mujoco", "dm-control", "numpy", "scipy", "clarabel", "trimesh")
"""All whose versions are recorded, by the planner and by the simulation."""


def package_versions() -> dict[str, str]:
    """Name and version of each."""
    return {name: version(name) for name in PACKAGES}
