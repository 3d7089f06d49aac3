"""The whole range of parameters, grids and schemes: any run ends in a status, with its volumes, and in bounded time.

200 random points in `make test`; 2,000 with `--long` (`make test-all`).
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from subslide.keys.names import SCHEMES
from subslide.naming import STATUSES
from subslide.points import Point
from subslide.solver import solve

FINISHED = ("ok", "not_at_rest")
NEVER = ("diverged", "negative_depth", "hyperbolicity_lost")
SHORT, LONG = 200, 2000
SCALED_TIME = 12.0
"""End of runs that are not to rest, in R / sqrt(g H2): all grains of the paper's range have come to rest by then."""


def logarithmic(low, high):
    """Numbers from low to high, as many in each decade."""
    return st.floats(math.log(low), math.log(high)).map(math.exp)


ANY = st.builds(
    Point,
    a_H=logarithmic(0.01, 20),
    a_2=logarithmic(0.05, 10),
    r=st.floats(0, 0.99) | logarithmic(0.01, 1).map(lambda gap: 1 - gap),
    delta=st.floats(0, 60),
    cells=st.integers(20, 200),
    scheme=st.sampled_from(list(SCHEMES)),
    order=st.sampled_from([1, 2]),
    boundary=st.sampled_from(["open", "wall"]),
    model=st.just("radial"),
)
PAPER = st.builds(
    Point,
    a_H=st.floats(1, 10),
    r=st.floats(0, 0.8),
    cells=st.integers(20, 200),
    scheme=st.sampled_from(list(SCHEMES)),
    order=st.sampled_from([1, 2]),
    boundary=st.sampled_from(["open", "wall"]),
)
SENSITIVITY = st.builds(
    Point,
    a_H=st.floats(0.5, 10),
    a_2=st.floats(0.3, 1.5),
    r=st.floats(0, 0.8),
    delta=st.floats(20, 40),
    cells=st.integers(50, 200),
)
"""The range of config/sensitivity.yaml, in the default numerics."""


def lane(short, long):
    """Parameters of a test: so many examples in `make test`, and with `--long`."""
    return pytest.mark.parametrize("count", [short, pytest.param(long, marks=pytest.mark.long)])


def drive(count, points, judge):
    """Nothing; `judge` holds for `count` of the points."""

    @settings(max_examples=count, deadline=None, derandomize=True, database=None)
    @given(points)
    def run(point):
        judge(point)

    run()


def bounded(point):
    """The point with an end in bounded scaled time."""
    return point.with_values(t_end=SCALED_TIME * math.sqrt(point.radius / (point.g * point.a_2)))


def ends_well(run):
    """Nothing; a run ended in a status that it may have, with its volumes, and said why."""
    assert run.status in STATUSES
    assert run.status not in NEVER
    assert bool(run.status_detail) == (run.status != "ok")
    assert np.isfinite(run.time).all()
    assert np.isfinite(run.energy).all()
    assert run.h2.min() >= 0
    surface = run.eta + run.point.a_2 * run.point.radius * (1 + run.point.a_H)
    assert (surface - run.h2).min() >= -1e-15 * surface.max()
    if run.point.boundary == "wall":
        for volume in (run.sediment_volume, run.water_volume):
            assert np.abs(volume / volume[0] - 1).max() < 1e-12


@lane(SHORT, LONG)
def test_any_point_ends_in_a_status(count):
    drive(count, ANY, lambda point: ends_well(solve(bounded(point))))


@lane(SHORT // 4, LONG // 4)
def test_any_point_of_the_papers_range_comes_to_its_end(count):
    def judge(point):
        run = solve(point)
        ends_well(run)
        assert run.status in FINISHED

    drive(count, PAPER, judge)


@lane(SHORT // 4, LONG // 4)
def test_the_default_numerics_are_stable_over_the_range_of_sensitivity(count):
    def judge(point):
        run = solve(point)
        ends_well(run)
        assert run.status in FINISHED

    drive(count, SENSITIVITY, judge)


@pytest.mark.parametrize("a_H", [0.5, 10])
@pytest.mark.parametrize("r", [0, 0.8])
def test_the_default_numerics_are_stable_on_the_corners_of_sensitivity(a_H, r):
    for a_2 in (0.3, 1.5):
        for delta in (20, 40):
            run = solve(Point(a_H=float(a_H), a_2=a_2, r=float(r), delta=float(delta), cells=100))
            assert run.status in FINISHED, run.status_detail
            assert run.x[-1] >= run.L_f[0]
