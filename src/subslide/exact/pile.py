"""A pile no steeper than friction allows, under a flat surface: it stays as it is (Theorem 3.1 of the paper)."""

DEFAULTS = {"shape": "cone", "angle": 0.0, "steepness": 0.95}
"""Options of the scene that a point leaves out."""


def stays(point):
    """Return whether friction holds the pile."""
    steepness = {**DEFAULTS, **dict(point.scene_options)}["steepness"]
    return point.friction == "coulomb" and steepness <= 1
