"""Runs made up on a grid whose cells differ in size and move, as the solver's fitted grid does."""

import numpy as np

WAVES = ("max_abs_eta", "max_abs_eta_outside", "eta_gauge")


def fitted(run, seed=0, shots=3, cells=12, **changes):
    """The run on such a grid: depths at random, and nothing known of the waves."""
    random = np.random.default_rng(seed)
    width = run.point.radius * random.uniform(0.01, 1, (shots, cells))
    made = {
        "grid": "fitted",
        "dx": np.nan,
        "x": np.cumsum(width, axis=1) - width / 2,
        "width": width,
        "snapshot_time": np.linspace(0, 1, shots),
        "h2": random.uniform(0, run.point.column_height, (shots, cells)),
        "eta": np.full((shots, cells), np.nan),
        "wave_free_until": np.nan,
        **{name: np.full(len(run.time), np.nan) for name in WAVES},
    }
    vars(run).update(made | changes)
    return run
