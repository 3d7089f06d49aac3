"""Orders of accuracy that are required, by direct runs: smooth standing waves, and the dry round paraboloid."""

import math

import numpy as np
import pytest

from subslide import exact, solver
from subslide.scenes import standing_wave
from subslide.study.config import make_point

ROUND, LINE = "round", "line"
SCALE = math.sqrt(0.0705 / (9.81 * 0.56))
"""Unit of time (s) of the paper's column."""
SPREAD = math.sqrt((2.69**2 - 1) / 2) * SCALE
"""Time (s) at which the paraboloid's radius is 2.69 of the first."""


def relative_error(end, shape, scale=None, **values):
    """L1 error of h2 at `end` (s), over `scale` (m) or the mean depth; rings count by their area."""
    point = make_point({"t_end": end, "snapshot_times": [0], "delta": 0, **values})
    run = solver.solve(point)
    assert run.status == "ok", run.status_detail
    weight = run.x if shape == ROUND else np.ones(len(run.x))
    known = exact.load(point.scene).solution(point, run.x, end)["h2"]
    size = (weight * (np.abs(known) if scale is None else scale)).sum()
    return (weight * np.abs(run.h2[-1] - known)).sum() / size


def order(errors, cells):
    """Order from the coarsest to the finest grid."""
    return math.log(errors[0] / errors[-1]) / math.log(cells[-1] / cells[0])


@pytest.mark.parametrize("scheme", ["ifcph", "hll"])
@pytest.mark.parametrize("kind", ["surface", "internal"])
@pytest.mark.parametrize("shape", [LINE, ROUND])
@pytest.mark.parametrize(("formal", "least"), [(1, 0.9), (2, 1.8)])
def test_standing_waves(scheme, kind, shape, formal, least):
    cells, amplitude, a_H, r = (200, 800), 1e-7, 1.0, 0.4
    k = standing_wave.wave_number(shape, 2, 0.3 / 0.0705)
    period = 2 * math.pi / (k * standing_wave.speed(kind, a_H, 1.0, r)) * SCALE
    errors = [
        relative_error(
            1.125 * period,  # after whole periods an error of phase hardly shows
            shape,
            scale=amplitude * 0.56 * 0.0705,
            scene="standing_wave",
            scene_options={"kind": kind, "shape": shape, "amplitude": amplitude},
            boundary="wall",
            a_H=a_H,
            r=r,
            scheme=scheme,
            order=formal,
            cells=n,
        )
        for n in cells
    ]
    assert errors[0] < {1: 0.06, 2: 5e-4}[formal]
    assert order(errors, cells) >= least


@pytest.mark.parametrize("scheme", ["ifcph", "hll", "rusanov"])
@pytest.mark.parametrize(("formal", "least"), [(1, 0.6), (2, 1.6)])
def test_dry_paraboloid_from_2_to_half_a_millimetre(scheme, formal, least):
    cells = (300, 600, 1200)
    common = {"scene": "paraboloid", "model": "one-layer", "r": 0, "scheme": scheme, "order": formal}
    errors = [relative_error(SPREAD, ROUND, cells=n, **common) for n in cells]
    assert errors[0] < {1: 0.08, 2: 0.006}[formal]
    assert sorted(errors, reverse=True) == errors
    assert order(errors, cells) >= least
