"""The drawn edges are those of the shape, however its surface is cut into triangles."""

import numpy as np
import trimesh

from planner.objects.rigid_object import RigidObject
from planner.pictures.sharp_edges import sharp_edges


def test_a_prism_has_nine_edges_of_the_right_length(prism: RigidObject) -> None:
    edges = sharp_edges(prism.parts[0].triangles()[0])
    lengths = np.sort(np.linalg.norm(edges[:, 1] - edges[:, 0], axis=1))
    np.testing.assert_allclose(
        lengths, 0.01 * np.array([2, 2, 2, 4, 4, 4, 4, 4 * 2**0.5, 4 * 2**0.5]), rtol=1e-6
    )  # a mesh in single precision


def test_curved_surfaces_have_none_and_cylinders_have_their_rims() -> None:
    assert len(sharp_edges(trimesh.creation.icosphere(subdivisions=3).triangles)) == 0
    rims = sharp_edges(trimesh.creation.cylinder(radius=0.02, height=0.1, sections=32).triangles)
    assert len(rims) == 2 * 32
    np.testing.assert_allclose(np.abs(rims[..., 2]), 0.05)


def test_an_open_surface_ends_in_edges() -> None:
    assert len(sharp_edges(np.array([[[0, 0, 0], [1, 0, 0], [0, 1, 0]]], dtype=float))) == 3
