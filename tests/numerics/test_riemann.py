"""Two-layer dam breaks of the literature on a flat bed: Castro Diaz, Kurganov and Morales de Luna (2019).

ESAIM: M2AN 53, 959, sections 5.2 and 5.3. No answer is known, so grids are held against a fine one.
"""

import math

import numpy as np
import pytest

from subslide.solver import solve
from subslide.study import config

FINE = 6400
PROBLEMS = {
    "5.2": {
        "sides": ((1.8, 0, 0.2, 0), (0.2, 0, 1.8, 0)),
        "g": 9.81,
        "half": 5.0,
        "time": 7.0,
        "radius": 4.5,
    },
    "5.3": {
        "sides": ((1.22582, -0.03866, 0.75325, 0.02893), (0.37002, -0.18684, 1.59310, 0.17416)),
        "g": 10.0,
        "half": 1.0,
        "time": 1.0,
        "radius": 0.7,
    },
}
"""(h1, q1, h2, q2) on the left and right, g, half-width and time, all SI; R makes a box that no wave comes back in."""


def answer(name, **values):
    """Return the run, and its h2 and eta (m) within the half-width, each (cells of 2 half)."""
    about = PROBLEMS[name]
    (h1, _, h2, _), _ = about["sides"]
    options, unit = {}, math.sqrt(about["g"] * h2)
    for side, (d1, q1, d2, q2) in zip(("left", "right"), about["sides"], strict=True):
        options |= {f"h2_{side}": d2 / h2, f"surface_{side}": (d1 + d2) / (h1 + h2)}
        options |= {f"u1_{side}": q1 / d1 / unit, f"u2_{side}": q2 / d2 / unit}
    run = solve(
        config.make_point(
            {
                "scene": "riemann",
                "scene_options": options,
                "a_H": h1 / h2,
                "a_2": h2 / about["radius"],
                "radius": about["radius"],
                "g": about["g"],
                "delta": 0,
                "boundary": "wall",
                "t_end": about["time"],
                "snapshot_times": [],
                **values,
            }
        )
    )
    assert run.status == "ok"
    return run


def error(name, run, fine):
    """Return the relative L1 distance of h2 from that of a finer grid within the half-width."""
    truth = fine.h2[-1].reshape(len(run.x), -1).mean(axis=1)
    near = np.abs(run.x) < PROBLEMS[name]["half"]
    return np.abs(run.h2[-1] - truth)[near].sum() / truth[near].sum()


@pytest.mark.parametrize(
    ("name", "r", "largest"), [("5.2", 0.98, 0.004), ("5.2", 0.2, 5e-4), ("5.3", 0.98, 0.001)]
)
def test_second_order_comes_nearer_to_a_fine_answer(name, r, largest):
    fine = answer(name, r=r, cells=FINE)
    coarse, middle, near = (error(name, answer(name, r=r, cells=cells), fine) for cells in (200, 400, 1600))
    assert near < largest
    assert math.log2(coarse / near) / 3 > 0.85
    assert middle < 0.7 * coarse


def test_waves_of_the_first_go_as_far_as_linear_theory_says():
    run = answer("5.2", r=0.98, cells=1600)
    changed = np.abs(run.h2[-1] - np.where(run.x < 0, 0.2, 1.8)) > 0.02
    reach = np.abs(run.x[changed]).max()
    assert math.sqrt(9.81 * 0.02 * 0.18) * 7 < reach < 2.5 * math.sqrt(9.81 * 0.02 * 0.5) * 7
    assert run.nonhyperbolic_cells.max() == 0
