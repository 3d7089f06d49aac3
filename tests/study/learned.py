"""Runs made up by formulas, for emulators that learn in a second what they should answer."""

import math

from scipy.stats import qmc

from subslide.emulator import coordinates
from subslide.emulator import measures as named
from subslide.emulator.training import Measured
from subslide.points import Point


def columns(count: int, seed: int = 1) -> list[tuple[float, float, float]]:
    """Rows of a_H, r and m, spread over the range."""
    (a, b), (c, d), (e, f) = coordinates.RANGE.values()
    even = qmc.Halton(3, seed=seed).random(count)
    return [(a * (b / a) ** x, c + (d - c) * y, e * (f / e) ** z) for x, y, z in even]


def inner(count: int) -> list[tuple[float, float, float]]:
    """Columns that nothing learned from, within the range of what did."""
    return [
        row
        for row in columns(count, seed=9)
        if 0.6 < row[0] < 9 and 0.05 < row[1] < 0.75 and 0.3 < row[2] < 2.5
    ]


def answer(a_H: float, r: float, m: float) -> dict[str, float]:
    """Formulas in place of the solver's limit: smooth, and about as large as its answers."""
    length = 1 + 0.8 * m**-0.7 * (1 - 0.3 * r) * a_H**0.05
    values = {name: 1 + (length - 1) * (1 - 0.1 * n) for n, name in enumerate(named.LENGTHS)}
    for n, name in enumerate(named.FRONTS):
        last = values[named.LENGTHS[n]]
        values |= {
            f"{name}@{k}": 1 + (last - 1) * math.sin(min(t, 1.57)) for k, t in enumerate(named.FRONT_NODES)
        }
    values |= {name: 1.6 / m + 0.1 * r for name in named.ARRESTS}
    crest = 0.03 * m**-0.3 / (1 + a_H)
    values |= {
        "crest_1": crest,
        "crest_2": crest * m**0.8,
        "trough_1": 0.8 * crest,
        "trough_2": 1.2 * crest * m**-0.5,
    }
    return values | {f"{named.SURFACE}@{n}": crest / (1 + t) for n, t in enumerate(named.TIMES)}


def measured(rows: list[tuple[float, float, float]]) -> list[Measured]:
    """Each column on two fitted and two uniform grids, whose errors fall as 1/cells."""
    runs = []
    for a_H, r, m in rows:
        values = answer(a_H, r, m)
        point = Point(a_H=a_H, r=r, a_2=0.56, delta=math.degrees(math.atan(0.56 * m)), t_end=0.6)
        for fitted in (True, False):
            names = [name for name in values if name.startswith(("crest", "trough", named.SURFACE)) != fitted]
            for cells in (96, 192) if fitted else (800, 1600):
                slope = (0.3 if fitted else 8) * (1 + 0.1 * r)
                keys = {"grid": "fitted", "quantities": "grains", "t_end": None} if fitted else {}
                biased = {name: values[name] * (1 - slope / cells) for name in names}
                runs.append(Measured(point.with_values(cells=cells, **keys), biased))
    return runs
