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
def soft_recording(box_object: RigidObject, soft_grasp: Grasp) -> Recording:
    """The same of the box between two soft fingers."""
    return record(box_object, soft_grasp)


@pytest.fixture(scope="package")
def soft_picture(box_object: RigidObject, soft_grasp: Grasp, soft_recording: Recording) -> Iterator[Picture]:
    """Small pictures of that; skips where there is no OpenGL."""
    yield from _pictures(box_object, soft_grasp, soft_recording)


@pytest.fixture(scope="package")
def picture(prism: RigidObject, golden_grasp: Grasp, recording: Recording) -> Iterator[Picture]:
    """Small pictures of the golden grasp; skips where there is no OpenGL."""
    yield from _pictures(prism, golden_grasp, recording)


def _pictures(rigid_object: RigidObject, grasp: Grasp, recording: Recording) -> Iterator[Picture]:
    try:
        picture = Picture(rigid_object, recording, heading_of(grasp.body, grasp, recording), (640, 360))
    except RenderingError as error:
        pytest.skip(f"no OpenGL here: {error}")
    with picture:
        yield picture
