"""The paper's study, made up, for the tests of figures."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np
import pytest
from made_up import RESOLVED, MadeUpResults, grid


@pytest.fixture(scope="session")
def paper():
    """Return the paper's fifteen runs."""
    return MadeUpResults(grid((1, 2, 10), (0, 0.2, 0.4, 0.6, 0.8)))


@pytest.fixture(scope="session")
def both():
    """Return the paper's fifteen runs with its numerics and resolved, with bands."""
    values = ((1, 2, 10), (0, 0.2, 0.4, 0.6, 0.8))
    return MadeUpResults(grid(*values) + grid(*values, **RESOLVED), bands=True)


@pytest.fixture(scope="session")
def large():
    """Return more values of a_H, r and a_2 than a figure shows."""
    return MadeUpResults(grid((0.5, 1, 2, 3, 4, 10), np.arange(9) / 10) + grid((1, 10), (0, 0.4), a_2=1.0))


@pytest.fixture(autouse=True)
def _close():
    """Close every figure of a test."""
    yield
    plt.close("all")
