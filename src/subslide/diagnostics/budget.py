"""Volumes, energy and the cells that lost hyperbolicity: sums over a row."""

from ..kernels.jit import part, summed
from ..kernels.waves import discriminant


@summed
def row_budget(h1, u1, v1, h2, u2, v2, weight, r, start, stop):
    """Return the sums of h1, of h2 and of the energy over a row's cells start..stop-1, each times its weight.

    The energy of a cell is r (h1 |u1|^2 + h1^2) / 2 + (h2 |u2|^2 + h2^2) / 2 + r h1 h2. `weight` is as long as the
    row. A sum is not finite if any depth is not.
    """
    water = 0.0
    grains = 0.0
    energy = 0.0
    first, count = part(start, stop)
    for k in range(count):
        i = k + first
        water += weight[i] * h1[i]
        grains += weight[i] * h2[i]
        double1 = h1[i] * (u1[i] * u1[i] + v1[i] * v1[i] + h1[i])
        double2 = h2[i] * (u2[i] * u2[i] + v2[i] * v2[i] + h2[i])
        energy += weight[i] * (0.5 * (r * double1 + double2) + r * h1[i] * h2[i])
    return water, grains, energy


@summed
def row_nonhyperbolic(h1, u1, v1, h2, u2, v2, r, dry_depth, margin, start, stop):
    """Return how many of a row's cells start..stop-1, wet in both layers, have complex speeds along their shear."""
    found = 0.0
    first, count = part(start, stop)
    for k in range(count):
        i = k + first
        du = u1[i] - u2[i]
        dv = v1[i] - v2[i]
        wet = min(h1[i], h2[i]) > dry_depth
        found += 1.0 if wet and discriminant(h1[i], h2[i], du * du + dv * dv, r) < -margin else 0.0
    return found
