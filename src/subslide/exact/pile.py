"""A pile no steeper than friction allows, under a flat surface: it stays as it is (Theorem 3.1 of the paper)."""

from subslide.points import Point
from subslide.scenes import options


def stays(point: Point) -> bool:
    """Return whether friction holds the pile."""
    return point.friction == "coulomb" and options(point)["steepness"] <= 1
