"""A recorded grasp, and pictures of it where there is OpenGL."""

from collections.abc import Iterator

import pytest

from planner.errors import RenderingError
from planner.grasps.grasp import Grasp
from planner.objects.rigid_object import RigidObject
from sim.render.picture import Picture, heading_of
from sim.render.recording import Recording, record


@pytest.fixture(scope="package")
def recording(prism: RigidObject, golden_grasp: Grasp) -> Recording:
    """The golden grasp under its critical wrench, with the cap at 1.02 and 0.98 rho."""
    return record(prism, golden_grasp)


@pytest.fixture(scope="package")
def picture(prism: RigidObject, golden_grasp: Grasp, recording: Recording) -> Iterator[Picture]:
    """Small pictures of that; skips where there is no OpenGL."""
    try:
        picture = Picture(prism, recording, heading_of("prism", golden_grasp, recording), (640, 360))
    except RenderingError as error:
        pytest.skip(f"no OpenGL here: {error}")
    with picture:
        yield picture
