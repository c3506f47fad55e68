"""An OBJ file of several objects: MuJoCo reads the faces of the first and hulls the corners of all."""

from pathlib import Path
from zipfile import ZipFile

import mujoco
import numpy as np
import pytest
import trimesh

from planner.objects.mjcf.compiled import compile_object
from planner.objects.mjcf.decompose import decompose
from planner.objects.mjcf.obj_file import read_obj
from planner.objects.mjcf.reader import read_object
from planner.objects.object_source import ObjectSource
from tests.strategies.mjcf_files import world, written
from tests.tools.lanes import first_fast

CUP, HANDLE = (0.04, 0.04, 0.04), (0.03, 0.01, 0.02)


def obj(*tags: str, form: str = "{}", negative: bool = False) -> str:
    """A cube of 40 mm, a handle of 30 mm beside it and so on, each after its tag (or none)."""
    lines, before = [], 0
    for number, tag in enumerate(tags):
        box = trimesh.creation.box(HANDLE if number else CUP)
        box.apply_translation([0.035 * number, 0, 0])
        lines += [tag] if tag else []
        lines += ["v " + " ".join(f"{coordinate:.6g}" for coordinate in vertex) for vertex in box.vertices]
        numbers = box.faces - len(box.vertices) if negative else box.faces + 1 + before
        lines += ["f " + " ".join(form.format(vertex) for vertex in face) for face in numbers]
        before += len(box.vertices)
    return "\n".join(lines) + "\n"


WHOLE = {
    "two objects": obj("o cup", "o handle"),
    "two groups": obj("g cup", "g handle"),
    "an empty group first": "o nothing\n" + obj("o cup", "o handle"),
    "an empty group last": obj("o cup", "o handle") + "o nothing\n",
    "the first without a name": obj("", "o handle"),
    "one name twice": obj("g part", "g part"),
    "three": obj("o cup", "o handle", "o end"),
    "materials inside": obj("o cup\nusemtl blue", "o handle\nusemtl red"),
    "texture and normal numbers": "vn 0 0 1\nvt 0 0\n" + obj("o cup", "o handle", form="{}/1/1"),
    "counted from the end": obj("o cup", "o handle", negative=True),
    "lines of Windows": obj("o cup", "o handle").replace("\n", "\r\n"),
}

READ_WHOLE = {
    "one object": obj("o both", ""),
    "no tags": obj("", ""),
    "materials": obj("usemtl blue", "usemtl red"),
    "groups without names": obj("g", "g"),
    "smoothing": obj("s 1", "s 2"),
    "one of two is empty": "o nothing\n" + obj("o both", ""),
    "no faces": "\n".join(line for line in obj("o cup", "o handle").splitlines() if line[0] != "f"),
}


def mjcf(folder: Path, text: str, attributes: str = "") -> Path:
    (folder / "m.obj").write_text(text, newline="")
    geom = '<geom name="cup" type="mesh" mesh="m" mass=".2" pos=".1 0 0" euler="0 0 90"/>'
    return written(folder, world(f"<body><freejoint/>{geom}</body>", f'<mesh name="m" file="m.obj" {attributes}/>'))


@pytest.mark.parametrize("kind", WHOLE)
def test_faces_that_mujoco_leaves_out_are_counted_and_said(
    tmp_path: Path, kind: str, caplog: pytest.LogCaptureFixture
) -> None:
    path = mjcf(tmp_path, WHOLE[kind])
    read_object(path)
    count = 3 if kind == "three" else 2
    assert f"holds {count} objects: " in caplog.messages[0]
    assert mujoco.MjModel.from_xml_path(str(path)).nmeshface == 12
    compiled = compile_object(ObjectSource(file=path))
    vertices, faces = compiled.mesh(0)
    assert len(faces) == 12 * count
    volume = np.prod(CUP) + (count - 1) * np.prod(HANDLE)
    assert trimesh.Trimesh(vertices, faces, process=False).volume == pytest.approx(volume, rel=1e-6)
    # turned by 90 degrees about z and moved: (x, y, z) -> (-y + 0.1, x, z)
    np.testing.assert_allclose(vertices.min(axis=0), [0.08, -0.02, -0.02], atol=1e-8)
    np.testing.assert_allclose(vertices.max(axis=0), [0.12, 0.035 * count - 0.02, 0.02], atol=1e-8)


@pytest.mark.parametrize("kind", READ_WHOLE)
def test_files_that_mujoco_reads_whole_are_left_to_it(
    tmp_path: Path, kind: str, caplog: pytest.LogCaptureFixture
) -> None:
    compiled = compile_object(ObjectSource(file=mjcf(tmp_path, READ_WHOLE[kind])))
    assert not compiled.partly_read
    read_object(mjcf(tmp_path, READ_WHOLE[kind]))
    assert not any("objects: " in message for message in caplog.messages)


def test_mirrored_and_scaled_meshes_keep_all_faces_outward(tmp_path: Path) -> None:
    compiled = compile_object(ObjectSource(file=mjcf(tmp_path, WHOLE["two objects"], 'scale="-1 2 1"')))
    volume = trimesh.Trimesh(*compiled.mesh(0), process=False).volume
    assert volume == pytest.approx(2 * (np.prod(CUP) + np.prod(HANDLE)), rel=1e-6)


@pytest.mark.parametrize("kind", first_fast(WHOLE, fast=4))
def test_decomposing_keeps_every_object_of_the_file_exactly(tmp_path: Path, kind: str) -> None:
    source, parts = decompose(ObjectSource(file=mjcf(tmp_path, WHOLE[kind])), tmp_path)
    assert parts == (3 if kind == "three" else 2)
    thing = read_object(source)
    length = 0.105 if kind == "three" else 0.07
    np.testing.assert_allclose(thing.extent, [0.04, length, 0.04], atol=1e-7)
    assert thing.mass == pytest.approx(0.2)


@pytest.mark.parametrize("folder", ["", "meshes/"])
def test_an_archive_is_asked_for_all_faces_too(tmp_path: Path, folder: str) -> None:
    text = mjcf(tmp_path, WHOLE["two objects"]).read_text().replace("m.obj", f"{folder}m.obj")
    with ZipFile(tmp_path / "cup.mjz", "w") as archive:
        archive.writestr("cup.xml", text)
        archive.write(tmp_path / "m.obj", f"{folder}m.obj")
    source, parts = decompose(ObjectSource(file=tmp_path / "cup.mjz"), tmp_path)
    assert parts == 2
    np.testing.assert_allclose(read_object(source).extent, [0.04, 0.07, 0.04], atol=1e-7)


def test_a_broken_face_is_left_to_mujoco(tmp_path: Path) -> None:
    path = tmp_path / "m.obj"
    path.write_text(obj("o a", "o b") + "f 1 2 99\n")
    assert read_obj(path) is None
