"""The Coulomb friction cone K = {f : |f_t| <= mu f_n} and its capped version K ∩ B (B: the unit ball).

f_n = f . n along the inward normal n, f_t = f - f_n n. All functions broadcast over leading axes and
serve both the plane and space. Source: Watanabe and Yoshikawa, eq. (3).
"""

import numpy as np

from planner.arrays import Floats


def components(vectors: Floats, normals: Floats) -> tuple[Floats, Floats]:
    """Normal component v_n (signed) and length |v_t| of the tangential part.

    Args:
        vectors: Shape (..., d).
        normals: Unit vectors, broadcastable to `vectors`.

    Returns:
        Two arrays of shape (...).
    """
    normal = (vectors * normals).sum(axis=-1)
    tangential = vectors - normal[..., None] * normals
    return normal, np.sqrt((tangential * tangential).sum(axis=-1))


def support(vectors: Floats, normals: Floats, friction: Floats) -> Floats:
    """Support function of the capped cone: h(v) = max { v.f : f in K, |f| <= 1 } = |Proj_K(v)|.

    Inside the cone the projection is v itself; between the cone and its polar it is the foot on the
    nearest edge, of length (v_n + mu |v_t|) / sqrt(1 + mu^2); inside the polar it is zero.

    Args:
        vectors: Directions v, shape (..., d).
        normals: Inward unit normals, broadcastable to `vectors`.
        friction: mu, broadcastable to shape (...).

    Returns:
        h(v) >= 0, shape (...), in the unit of `vectors`.
    """
    normal, tangential = components(vectors, normals)
    foot = (normal + friction * tangential) / np.sqrt(1 + friction * friction)
    length = np.hypot(normal, tangential)
    return np.where(tangential <= friction * normal, length, np.maximum(foot, 0.0))


def utilisation(forces: Floats, normals: Floats) -> Floats:
    """Friction utilisation |f_t| / f_n: the smallest mu whose cone holds each force.

    Args:
        forces: Shape (..., d) [N].
        normals: Inward unit normals, broadcastable to `forces`.

    Returns:
        Shape (...); infinite where a force pulls, zero where it vanishes.
    """
    return slope(*components(forces, normals))


def slope(along: Floats, across: Floats) -> Floats:
    """|f_t| / f_n, infinite where a force pulls, zero where it vanishes, shape (...).

    Args:
        along: f_n, shape (...) [N].
        across: |f_t|, shape (...) [N].
    """
    ratio = np.full_like(along, np.inf)
    np.divide(across, along, out=ratio, where=along > 0)
    ratio[(across == 0) & (along >= 0)] = 0.0
    return ratio
