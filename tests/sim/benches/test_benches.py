"""Others' tests, with fingertips: their settings, a pencil's threshold, and what must fail does."""

from dataclasses import asdict
from functools import cache
from pathlib import Path

import msgspec
import numpy as np
import pytest

from planner.contacts import Contacts
from planner.errors import SettingError, SimulationError
from planner.objects.mjcf.reader import read_object
from planner.objects.rigid_object import RigidObject
from sim.benches.bench import BenchOutcome
from sim.benches.dexgraspbench import DEXGRASPBENCH, dexgraspbench
from sim.benches.document import FORMAT, BenchDocument, to_document, write_bench
from sim.benches.graspdatagen import GRASPDATAGEN, graspdatagen
from sim.benches.world import build_world
from tests.tools.commands import ASSETS

BENCHES = {"DexGraspBench": dexgraspbench, "GraspDataGen": graspdatagen}


@cache
def brick() -> RigidObject:
    """The box asset."""
    return read_object(ASSETS / "box" / "box.xml")


def fingers(*axes: int) -> Contacts:
    """Two opposed fingers on the middles of the box's faces across each axis; their friction is not used."""
    signs = np.vstack([sign * np.eye(3)[axis] for axis in axes for sign in (-1.0, 1.0)])
    low, high = brick().parts[0].bounds()
    points = (low + high) / 2 + signs * brick().extent / 2
    return Contacts(points=points, normals=-signs, friction=np.full(len(signs), 0.1))


@cache
def outcome(bench: str, squeeze: float) -> BenchOutcome:
    return BENCHES[bench](brick(), fingers(0, 1), squeeze)


@pytest.mark.parametrize("bench", BENCHES)
def test_four_fingers_that_squeeze_enough_pass_without_a_slip(bench: str) -> None:
    result = outcome(bench, 12.0)
    assert result.passed, result.reasons
    assert result.touching.all() and result.translations.max() < 5e-3 and result.rotations.max() < 0.1


@pytest.mark.parametrize("bench", BENCHES)
def test_too_little_force_fails(bench: str) -> None:
    result = outcome(bench, 0.1)
    assert not result.passed and result.reasons
    assert result.translations.max() > 1.0


@pytest.mark.parametrize("bench", BENCHES)
def test_without_the_finger_that_opposes_it_a_finger_cannot_hold(bench: str) -> None:
    assert BENCHES[bench](brick(), fingers(0), 12.0).passed
    assert not BENCHES[bench](brick(), fingers(0).subset(np.array([0])), 12.0).passed
    assert not BENCHES[bench](brick(), fingers(0, 1).subset(np.array([0, 2])), 12.0).passed


def test_dexgraspbench_asks_two_fingers_for_weight_over_twice_its_friction_or_up_to_twice_that() -> None:
    pencil = 0.1 * 10 / (2 * 0.6)  # held still; a spring loaded all at once swings to twice its rest
    assert dexgraspbench(brick(), fingers(0), 2.0 * pencil).passed
    assert not dexgraspbench(brick(), fingers(0), 0.95 * pencil).passed


def test_graspdatagen_asks_for_contact_and_not_for_stillness() -> None:
    pencil = 9.81 / 2  # along z, friction 1
    slipped = graspdatagen(brick(), fingers(0), 0.9 * pencil)
    assert not slipped.passed and not slipped.touching.all()
    assert "do not touch" in slipped.reasons[0]
    assert GRASPDATAGEN.translation_limit is None and GRASPDATAGEN.rotation_limit is None


def test_the_settings_are_those_the_benchmarks_state() -> None:
    theirs = DEXGRASPBENCH
    assert (theirs.object_mass, theirs.friction, theirs.torsional_friction) == (0.1, 0.6, 0.02)
    scene = build_world(brick(), fingers(0), theirs).model
    assert (scene.pair_dim == 4).all() and (scene.pair_friction[:, :3] == (0.6, 0.6, 0.02)).all()
    assert (theirs.cone, theirs.impratio, theirs.noslip_iterations) == ("elliptic", 10, 2)
    assert (theirs.timestep, theirs.integrator, theirs.tug_time, theirs.tug_acceleration) == (
        4e-3,
        "implicitfast",
        2,
        10,
    )
    assert theirs.translation_limit == 0.05 and theirs.rotation_limit == pytest.approx(np.radians(15))
    axes = [tuple(row) for sign in (-1, 1) for row in sign * np.eye(3)]
    assert sorted(tug for (tug,) in theirs.tugs) == sorted(axes)

    nvidia = GRASPDATAGEN
    assert (nvidia.object_mass, nvidia.friction, nvidia.squeeze_time, nvidia.tug_time) == (1.0, 1.0, 1.0, 0.5)
    assert (build_world(brick(), fingers(0), nvidia).model.pair_dim == 3).all()
    assert nvidia.tug_acceleration == 9.81 and nvidia.contact_at_end and len(nvidia.tugs) == 1
    stated = np.array([(0, 0, 1), (0, 2, 1), (0, -2, 1), (2, 0, 1), (-2, 0, 1)], dtype=float)
    np.testing.assert_allclose(nvidia.tugs[0], stated / np.linalg.norm(stated, axis=1, keepdims=True))
    assert all(settings.name.endswith("(fingertips)") for settings in (theirs, nvidia))


def test_the_world_is_compiled_with_the_settings_in_real_units() -> None:
    model = build_world(brick(), fingers(0), DEXGRASPBENCH).model
    assert model.opt.timestep == 4e-3 and model.opt.impratio == 10 and model.opt.noslip_iterations == 2
    assert (model.pair_dim == 4).all() and not model.opt.gravity[2] * (model.opt.disableflags == 0)
    np.testing.assert_allclose(model.pair_friction[:, :3], [(0.6, 0.6, 0.02)] * 2)
    body = model.body("object")
    assert body.mass[0] == 0.1
    inertia = np.linalg.eigvalsh(brick().inertia) * 0.1 / brick().mass
    np.testing.assert_allclose(np.sort(body.inertia), inertia, rtol=1e-9)
    np.testing.assert_allclose(body.ipos, brick().center_of_mass, atol=1e-12)


@pytest.mark.parametrize("squeeze", [0.0, -1.0, np.inf, np.nan])
def test_a_squeeze_that_is_no_force_is_refused(squeeze: float) -> None:
    with pytest.raises(SettingError, match="squeeze is"):
        dexgraspbench(brick(), fingers(0), squeeze)


def test_a_fingertip_off_the_surface_is_refused() -> None:
    held = fingers(0)
    lifted = Contacts(points=held.points - 1e-4 * held.normals, normals=held.normals, friction=held.friction)
    with pytest.raises(SimulationError, match="fingertip 1"):
        dexgraspbench(brick(), lifted, 1.0)


def test_what_is_written_is_read_back_with_every_setting(tmp_path: Path) -> None:
    path, result = tmp_path / "box.bench.json", outcome("DexGraspBench", 0.1)
    write_bench(path, result, grasp="box.grasp.json")
    document = msgspec.json.decode(path.read_bytes(), type=BenchDocument)
    assert document == to_document(result, grasp="box.grasp.json")
    assert document.format == FORMAT and len(document.simulations) == 6 and document.reasons
    assert asdict(document.settings) == asdict(DEXGRASPBENCH)
