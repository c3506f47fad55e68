"""The project's own objects: as generated, loadable alone, with the masses they claim."""

import mujoco
import numpy as np
import pytest

from assets.generate import FOLDER, files
from planner.objects.planar.reader import read_planar

OBJECTS = sorted(name for name in files() if name.endswith(".xml"))


def body_of(name: str) -> tuple[mujoco.MjModel, int]:
    """The compiled model and its only moving body."""
    model = mujoco.MjModel.from_xml_path(str(FOLDER / name))
    return model, 1


@pytest.mark.parametrize("name", sorted(files()))
def test_the_file_is_what_the_generator_makes(name: str) -> None:
    assert (FOLDER / name).read_text(encoding="utf-8") == files()[name]


def test_no_object_file_was_made_by_hand() -> None:
    paths = [path for kind in ("*.xml", "*.obj", "planar/*.toml") for path in FOLDER.rglob(kind)]
    found = {path.relative_to(FOLDER).as_posix() for path in paths}
    assert found == set(files())


@pytest.mark.parametrize("name", OBJECTS)
def test_the_object_loads_alone_as_one_free_body_of_sensible_mass(name: str) -> None:
    model, body = body_of(name)
    assert (model.nbody, model.njnt, int(model.jnt_type[0])) == (2, 1, mujoco.mjtJoint.mjJNT_FREE)
    assert model.body(body).name == name.split("/")[0]
    assert 0.01 < model.body_mass[body] < 0.5
    assert (model.geom_friction[:, 0] >= 0.3).all()
    assert (model.geom_contype == 1).all()


def test_the_prism_weighs_what_the_paper_says_about_its_centroid() -> None:
    model, body = body_of("prism/prism.xml")
    assert model.body_mass[body] * 9.81 == pytest.approx(0.16, rel=1e-6)
    np.testing.assert_allclose(model.body_ipos[body], 0, atol=1e-9)
    assert model.geom_friction[0, 0] == 0.3


def test_the_prism_has_the_papers_corners() -> None:
    model, _ = body_of("prism/prism.xml")
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    corners = model.mesh_vert @ data.geom_xmat[0].reshape(3, 3).T + data.geom_xpos[0]
    expected = [[x, y, z] for x, y in ((-4, -4), (8, -4), (-4, 8)) for z in (-3, 3)]
    np.testing.assert_allclose(sorted((300 * corners).round(4).tolist()), sorted(expected), atol=1e-4)


def test_curved_meshes_are_convex_and_nearly_as_heavy_as_the_solids_they_approximate() -> None:
    """Density 1000 kg/m^3; an inscribed mesh is lighter, by less than a percent."""
    solids = {
        "cylinder/cylinder.xml": np.pi * 0.02**2 * 0.08,
        "ellipsoid/ellipsoid.xml": 4 / 3 * np.pi * 0.03 * 0.022 * 0.018,
    }
    for name, volume in solids.items():
        model, body = body_of(name)
        assert 0.99 * 1000 * volume < model.body_mass[body] < 1000 * volume
        np.testing.assert_allclose(model.body_ipos[body], 0, atol=1e-9)


@pytest.mark.parametrize("name", ["mug/mug.xml", "bracket/bracket.xml"])
def test_the_geoms_of_a_concave_object_hang_together(name: str) -> None:
    """From the first geom every other is reached through geoms that overlap, by more than rounding."""
    model, _ = body_of(name)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    reached, waiting = {0}, [0]
    while waiting:
        geom = waiting.pop()
        for other in set(range(model.ngeom)) - reached:
            if mujoco.mj_geomDistance(model, data, geom, other, 1.0, None) < -1e-4:
                reached.add(other)
                waiting.append(other)
    assert reached == set(range(model.ngeom))


def test_the_mug_is_hollow() -> None:
    """A ray from above along its axis meets nothing but the bottom, 8 mm high."""
    model, _ = body_of("mug/mug.xml")
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    met = np.zeros(1, dtype=np.int32)
    distance = mujoco.mj_ray(model, data, np.array([0.02, 0.01, 1.0]), np.array([0, 0, -1.0]), None, 1, -1, met)
    assert model.geom(int(met[0])).name == "bottom"
    assert distance == pytest.approx(1 - 0.008)


@pytest.mark.parametrize(("name", "cells", "area"), [("convex", 56, 50.0), ("concave", 86, 45.0)])
def test_planar_objects_weigh_what_the_paper_says_about_their_centroids_and_have_whole_cells(
    name: str, cells: int, area: float
) -> None:
    """0.01 N per square centimetre; cells of 5 mm."""
    planar = read_planar(FOLDER / "planar" / f"{name}.toml")
    assert planar.mass * 9.81 == pytest.approx(0.01 * area, rel=1e-8)
    assert planar.outline.area == pytest.approx(1e-4 * area)
    np.testing.assert_allclose(planar.center_of_mass, 0, atol=1e-12)
    edges = planar.outline.lengths / 0.005
    np.testing.assert_allclose(edges, edges.round(), rtol=1e-9)
    assert edges.sum() == pytest.approx(cells)
