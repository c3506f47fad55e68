"""The golden grasp as something to look at, and a running server where there is viser."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import pytest

from planner.grasps.grasp import Grasp
from planner.objects.rigid_object import RigidObject
from sim.view.playback import Playback, play_back
from sim.view.subject import Subject, subject

if TYPE_CHECKING:
    from sim.view.server import Server


@pytest.fixture(scope="package")
def prism_subject(prism: RigidObject, golden_grasp: Grasp) -> Subject:
    """The paper's Case III."""
    return subject("prism", prism, golden_grasp)


@pytest.fixture(scope="package")
def soft_subject(box_object: RigidObject, soft_grasp: Grasp) -> Subject:
    """The box between two soft fingers."""
    return subject("box", box_object, soft_grasp)


@pytest.fixture(scope="package")
def playback(prism_subject: Subject) -> Playback:
    """The trial of its critical wrench."""
    return play_back(prism_subject, prism_subject.grasp.critical_wrench)


@pytest.fixture
def server() -> "Iterator[Server]":
    """A server on a free port."""
    pytest.importorskip("viser", reason="the live view needs the extra viz")
    from sim.view.server import serve

    server = serve("127.0.0.1", 0)
    yield server
    server.stop()
