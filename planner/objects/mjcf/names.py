"""Names in a compiled model. MuJoCo keeps the bytes of the file; what is not UTF-8 is read as Latin-1."""

import mujoco

from planner.arrays import Indices


def name_at(model: mujoco.MjModel, addresses: Indices, number: int, kind: str) -> str:
    """Name of an element, its kind and number (`geom7`) where it has none.

    Args:
        model: The model.
        addresses: Where the names of elements of this kind begin, such as `model.name_geomadr`.
        number: Of the element.
        kind: The word for it.
    """
    start = int(addresses[number])
    name = bytes(model.names[start : model.names.index(b"\0", start)])
    try:
        return name.decode() or f"{kind}{number}"
    except UnicodeDecodeError:
        return name.decode("latin-1")
