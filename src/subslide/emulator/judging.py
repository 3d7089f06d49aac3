"""An emulator held against runs that it never saw."""

from typing import TYPE_CHECKING

import numpy as np

from subslide.emulator import measures as named
from subslide.emulator import training
from subslide.emulator.model import Emulator
from subslide.emulator.training import LeftOut

if TYPE_CHECKING:
    from subslide.results import Results


def held_out(emulator: Emulator, results: "Results") -> dict[str, LeftOut]:
    """Return predictions beside the limits of a study's runs, by quantity; columns outside the range are left out.

    Parameters
    ----------
    emulator
        The emulator.
    results
        The study, on two grids or more.

    Returns
    -------
    dict
        Of fronts at the nodes of their clock, and of the others.
    """
    return against(emulator, training.limits(training.of_study(results)))


def against(emulator: Emulator, known: dict[str, training.Limits]) -> dict[str, LeftOut]:
    """Return predictions beside limits, by quantity.

    Parameters
    ----------
    emulator
        The emulator.
    known
        Limits of runs, by group.

    Returns
    -------
    dict
        By quantity.
    """
    low, high = np.array(list(emulator.range.values())).T
    parts: dict[str, list[LeftOut]] = {}
    for name, group in emulator.groups.items():
        if name not in known:
            continue
        inputs, values = known[name].inputs, known[name].values
        inside = ((inputs >= low * (1 - 1e-6)) & (inputs <= high * (1 + 1e-6))).all(axis=1)
        inputs, values = inputs[inside], values[inside]
        if name == "gauge":
            guess, band = emulator.predict(*inputs.T, quantities=[named.PEAK])[named.PEAK]
            parts[named.PEAK] = [LeftOut(inputs, guess, values.max(axis=1), band)]
            continue
        guess, band = group(inputs)
        for q, quantity in enumerate(known[name].quantities):
            if quantity in group.names:
                place = group.names.index(quantity)
                one = LeftOut(inputs, guess[:, place], values[:, q], band[:, place])
                parts.setdefault(quantity.partition("@")[0], []).append(one)
    return {name: LeftOut(*map(np.concatenate, zip(*some, strict=True))) for name, some in parts.items()}
