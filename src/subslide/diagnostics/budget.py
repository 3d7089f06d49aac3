"""Volumes, energy and the cells that lost hyperbolicity: sums over a row."""

from ..kernels.arrays import GHOSTS
from ..kernels.jit import summed
from ..kernels.waves import discriminant


@summed
def row_volumes(h1, h2, weight):
    """Return the sums of h1 and h2 over a row, each cell times `weight` (n); not finite if any depth is not."""
    water = 0.0
    grains = 0.0
    for k in range(weight.shape[0]):
        i = k + GHOSTS
        water += weight[k] * h1[i]
        grains += weight[k] * h2[i]
    return water, grains


@summed
def row_energy(h1, u1, v1, h2, u2, v2, weight, r):
    """Return the sum of r (h1 |u1|^2 + h1^2) / 2 + (h2 |u2|^2 + h2^2) / 2 + r h1 h2 over a row."""
    energy = 0.0
    for k in range(weight.shape[0]):
        i = k + GHOSTS
        water = h1[i] * (u1[i] * u1[i] + v1[i] * v1[i] + h1[i])
        grains = h2[i] * (u2[i] * u2[i] + v2[i] * v2[i] + h2[i])
        energy += weight[k] * (0.5 * (r * water + grains) + r * h1[i] * h2[i])
    return energy


@summed
def row_nonhyperbolic(h1, u1, v1, h2, u2, v2, r, n, dry_depth, margin):
    """Return how many of a row's n cells, wet in both layers, have complex wave speeds along their shear."""
    count = 0.0
    for k in range(n):
        i = k + GHOSTS
        du = u1[i] - u2[i]
        dv = v1[i] - v2[i]
        wet = min(h1[i], h2[i]) > dry_depth
        count += 1.0 if wet and discriminant(h1[i], h2[i], du * du + dv * dv, r) < -margin else 0.0
    return count
