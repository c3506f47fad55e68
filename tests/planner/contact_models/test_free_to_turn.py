"""Two hard fingers in space hold no moment about their line; every other number or place of them may."""

import numpy as np
import pytest

from planner.contact_models.models import free_to_turn, model_of
from planner.contacts import Contacts


def some_contacts(fingers: int, dimension: int) -> Contacts:
    generator = np.random.default_rng(fingers)
    normals = generator.normal(size=(fingers, dimension))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    points = generator.normal(size=(fingers, dimension))
    return Contacts(points=points, normals=normals, friction=np.full(fingers, 0.5))


@pytest.mark.parametrize("dimension", [2, 3])
@pytest.mark.parametrize("fingers", [2, 3, 4])
def test_the_rule_is_that_of_the_rank_of_the_grasp_map(fingers: int, dimension: int) -> None:
    contacts = some_contacts(fingers, dimension)
    maps = np.hstack(list(model_of(contacts).maps(contacts, np.zeros(dimension))))
    assert free_to_turn(contacts, fingers) == (np.linalg.matrix_rank(maps) < len(maps))
