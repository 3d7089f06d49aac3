"""Discs and ellipses, shifted and turned, on a grid: the exact area of each cell that they cover."""

import math

import numpy as np


def ellipse_area(
    x_edges: np.ndarray,
    y_edges: np.ndarray,
    centre: tuple[float, float] = (0.0, 0.0),
    semi_axes: tuple[float, float] = (1.0, 1.0),
    angle: float = 0.0,
) -> np.ndarray:
    """Return the areas (ny, nx) that an ellipse shares with the cells between x_edges and y_edges.

    angle: from the x axis to the first semi-axis, in radians. Cells whole inside or outside are exact. The area is a
    sum over a cell's edges (Green's theorem), taken where the ellipse is the unit disc.
    """
    a, b = semi_axes
    c, s = math.cos(angle), math.sin(angle)
    x, y = np.meshgrid(x_edges - centre[0], y_edges - centre[1])
    u, v = (c * x + s * y) / a, (c * y - s * x) / b
    bottom, crossed_y = edge_area(u[:, :-1], v[:, :-1], u[:, 1:], v[:, 1:])
    left, crossed_x = edge_area(u[:-1], v[:-1], u[1:], v[1:])
    area = a * b * (bottom[:-1] + left[:, 1:] - bottom[1:] - left[:, :-1])
    corner = u**2 + v**2 <= 1.0
    whole = corner[:-1, :-1] & corner[:-1, 1:] & corner[1:, :-1] & corner[1:, 1:]
    holds = np.outer(between(y_edges, centre[1]), between(x_edges, centre[0]))
    touched = holds | crossed_y[:-1] | crossed_y[1:] | crossed_x[:, :-1] | crossed_x[:, 1:]
    cell = np.outer(np.diff(y_edges), np.diff(x_edges))
    return np.where(whole, cell, np.where(touched, np.clip(area, 0.0, cell), 0.0))


def edge_area(
    u0: np.ndarray, v0: np.ndarray, u1: np.ndarray, v1: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the area that the unit disc shares with the triangle (0, edge), signed, and whether the edge enters it."""
    du, dv = u1 - u0, v1 - v0
    a = du**2 + dv**2
    b = u0 * du + v0 * dv
    root = np.sqrt(np.maximum(0.0, b**2 - a * (u0**2 + v0**2 - 1.0)))
    a = np.where(a > 0, a, 1.0)
    t0, t1 = np.clip((-b - root) / a, 0.0, 1.0), np.clip((-b + root) / a, 0.0, 1.0)
    enter, leave = (u0 + t0 * du, v0 + t0 * dv), (u0 + t1 * du, v0 + t1 * dv)
    chord = enter[0] * leave[1] - enter[1] * leave[0]
    sectors = turn(u0, v0, *enter) + turn(*leave, u1, v1)
    return 0.5 * (chord + sectors), t1 > t0


def turn(u0: np.ndarray, v0: np.ndarray, u1: np.ndarray, v1: np.ndarray) -> np.ndarray:
    """Return the angle from one point to another as seen from the origin."""
    return np.arctan2(u0 * v1 - v0 * u1, u0 * u1 + v0 * v1)


def between(edges: np.ndarray, place: float) -> np.ndarray:
    """Return whether each cell (n) of a row holds a place."""
    return (edges[:-1] <= place) & (place <= edges[1:])


def fraction(area: np.ndarray, x_edges: np.ndarray, y_edges: np.ndarray) -> np.ndarray:
    """Return areas over those of their cells, at most 1."""
    return np.minimum(1.0, area / np.outer(np.diff(y_edges), np.diff(x_edges)))
