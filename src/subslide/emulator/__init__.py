"""A Gaussian process in place of the solver: fits, predictions with bands, calibration by data."""
