"""Dry round columns beside the laboratory's: height on the axis and time of rest."""

import numpy as np
import pytest

from subslide.laboratory import lajeunesse, lube
from subslide.points import Point
from subslide.solver import solve


@pytest.mark.parametrize("a_2", [0.3, 0.56, 1.0, 2.0, 3.0])
def test_height_and_time_of_rest_are_near_those_of_the_laboratory(a_2):
    run = solve(Point(a_2=a_2, r=0.0, cells=800, model="one-layer", snapshot_times=()))
    assert run.h2[-1][0] / run.point.radius == pytest.approx(lajeunesse.height(a_2), rel=0.12)
    assert run.time_at_rest == pytest.approx(lube.duration(a_2 * run.point.radius, 9.81), rel=0.05)
    assert np.isfinite(run.time_of_arrest).all()
