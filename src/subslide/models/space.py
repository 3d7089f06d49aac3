"""Arrays that a step works on, in one block, which later runs on as many cells take over."""

from typing import Any, NamedTuple

import numpy as np

from subslide.kernels.arrays import GHOSTS, Cells, CellTerms, Fluxes, Side

PAGE, LINE = 4096, 128
"""Arrays that share their offset modulo PAGE bytes evict each other, so they lie an odd number of LINEs apart."""

MOST_KEPT, LARGEST = 16, 1 << 20
"""Blocks that are kept for later runs, and the bytes of the largest of these."""

_kept: dict[tuple[int, int, Any], list["Space"]] = {}


class Space(NamedTuple):
    """Arrays of a radius or line; at first order the faces of cells are the cells."""

    cells: Cells
    left: Side
    right: Side
    fluxes: Fluxes
    terms: CellTerms
    block: np.ndarray
    kind: tuple[int, int, Any]


def taken(padded: int, order: int, real: Any) -> Space:
    """Return arrays as for a new run: zero, but for `keep1` and `keep2`, which are 1.

    Parameters
    ----------
    padded
        Cells with ghosts.
    order
        Order of the scheme.
    real
        Type of the working precision.

    Returns
    -------
    Space
        Arrays that no other run works on until they are `returned`.
    """
    kept = _kept.get((padded, order, real))
    try:
        space = kept.pop() if kept else _made(padded, order, real)
    except IndexError:  # another thread was faster
        space = _made(padded, order, real)
    space.block.fill(0)
    space.terms.keep1.fill(1)
    space.terms.keep2.fill(1)
    return space


def returned(space: Space) -> None:
    """Put the arrays of a run that has ended aside for one to come.

    Parameters
    ----------
    space
        What it was given by `taken`, which it uses no more.
    """
    if space.block.nbytes <= LARGEST:
        if sum(map(len, _kept.values())) >= MOST_KEPT:
            _kept.clear()
        _kept.setdefault(space.kind, []).append(space)


def _made(padded: int, order: int, real: Any) -> Space:
    """Return new arrays, not yet set."""
    itemsize = np.dtype(real).itemsize
    stride = (-(-padded * itemsize // LINE) | 1) * LINE // itemsize  # an odd number of lines
    kinds: tuple[Any, ...] = (Cells, CellTerms, Fluxes, *((Side, Side) if order != 1 else ()))
    count = sum(len(kind._fields) for kind in kinds)
    spare: np.ndarray = np.empty(count * stride + LINE // itemsize, real)
    first = -spare.ctypes.data % LINE // itemsize
    block = spare[first : first + count * stride]
    rows = iter(block.reshape(count, stride))
    edges = padded - 2 * GHOSTS + 1

    def group(kind: Any) -> Any:
        size = edges if kind is Fluxes else padded
        return kind(*(next(rows)[:size] for _ in kind._fields))

    cells, terms, fluxes = group(Cells), group(CellTerms), group(Fluxes)
    if order == 1:
        left = right = Side(*(getattr(cells, variable) for variable in Side._fields))
    else:
        left, right = group(Side), group(Side)
    return Space(cells, left, right, fluxes, terms, block, (padded, order, real))
