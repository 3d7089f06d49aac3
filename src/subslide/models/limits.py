"""When and where a state went wrong."""

from collections.abc import Iterable

import numpy as np

from subslide.kernels.arrays import GHOSTS, Cells, Settings
from subslide.kernels.hyperbolicity import is_complex

LARGEST_BOX = 4.0
"""Half-width over the paper's at which a front has left the domain: the end of the largest box, a place in the sea."""

MOST_CELLS = 4_000_000
"""Cells to which the sea on a radius or line is lengthened at most: 3 GB of them."""

LOST_GRAINS = 1e-3
"""Fraction of the grains that may leave the box, thinner than the front, before the run counts as `left_domain`."""


def first_suspect(cells: Cells, names: Iterable[str], x: np.ndarray | None) -> str:
    """Return the first cell that is not finite or has a negative depth, else the fastest, with its scaled state.

    Parameters
    ----------
    cells
        State, padded.
    names
        Fields that make the state, in the order in which it is told.
    x
        Places of the cells over R where they move, else None.

    Returns
    -------
    str
        Place and state in words.
    """
    values = inner(cells, names)
    bad = (values["h1"] < 0) | (values["h2"] < 0)
    for array in values.values():
        bad |= ~np.isfinite(array)
    if not bad.any():
        pace = inner(cells, ("pace",))["pace"]
        bad = pace == pace.max()
    return described(bad, values, x)


def first_sheared(cells: Cells, names: Iterable[str], settings: Settings, x: np.ndarray | None) -> str:
    """Return the first cell whose wave speeds are complex along its shear, with its scaled state.

    Parameters
    ----------
    cells
        State, padded.
    names
        Fields that make the state, in the order in which it is told.
    settings
        Scaled numbers of the run.
    x
        Places of the cells over R where they move, else None.

    Returns
    -------
    str
        Place and state in words; '' if there is no such cell.
    """
    values = inner(cells, names)
    real = type(settings.r)
    pairs = [(a, b) for a, b in (("u1", "u2"), ("v1", "v2")) if a in values]
    square = np.sum([(values[a] - values[b]) ** 2 for a, b in pairs], axis=0)
    h1, h2 = values["h1"], values["h2"]
    lost = np.minimum(h1, h2) > settings.dry_depth
    for where in np.argwhere(lost):
        place = tuple(where)
        lost[place] = is_complex(real(h1[place]), real(h2[place]), real(square[place]), settings.r)
        if lost[place]:
            break
    return described(lost, values, x)


def inner(cells: Cells, names: Iterable[str]) -> dict[str, np.ndarray]:
    """Return the fields of a state without ghost cells.

    Parameters
    ----------
    cells
        State, padded.
    names
        Fields that are wanted.

    Returns
    -------
    dict
        Views, by name.
    """
    inside = (slice(GHOSTS, -GHOSTS),) * cells.h1.ndim
    return {name: getattr(cells, name)[inside] for name in names}


def described(bad: np.ndarray, values: dict[str, np.ndarray], x: np.ndarray | None) -> str:
    """Return the first cell where something is wrong, with its scaled state, in words.

    Parameters
    ----------
    bad
        Whether it is, by cell.
    values
        State by name, each of the shape of `bad`.
    x
        Places of the cells over R where they move, else None.

    Returns
    -------
    str
        Indices of the cell and its state; '' if there is none.
    """
    if not bad.any():
        return ""
    where = tuple(int(index) for index in np.argwhere(bad)[0])
    state = ", ".join(f"{name} = {array[where]:.6g}" for name, array in values.items())
    cell = f"cell {where[0] if len(where) == 1 else where}"
    if x is not None:
        cell += f" at {x[where]:.6g} R"
    return f"{cell}, scaled {state}"
