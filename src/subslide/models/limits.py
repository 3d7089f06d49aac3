"""When and where a state went wrong."""

import numpy as np

from ..kernels.arrays import GHOSTS

LOST_GRAINS = 1e-3
"""Fraction of the grains that may leave the box, thinner than the front, before the run counts as `left_domain`."""


def first_suspect(cells, names):
    """Return the first cell that is not finite or has a negative depth, with its scaled state; '' if there is none."""
    inner = (slice(GHOSTS, -GHOSTS),) * cells.h1.ndim
    values = {name: getattr(cells, name)[inner] for name in names}
    bad = (values["h1"] < 0) | (values["h2"] < 0)
    for array in values.values():
        bad |= ~np.isfinite(array)
    if not bad.any():
        return ""
    where = tuple(int(index) for index in np.argwhere(bad)[0])
    state = ", ".join(f"{name} = {array[where]:.6g}" for name, array in values.items())
    return f"cell {where[0] if len(where) == 1 else where}, scaled {state}"
