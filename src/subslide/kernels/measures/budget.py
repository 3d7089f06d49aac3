"""Volumes, energy and the cells that lost hyperbolicity: sums over a row."""

from subslide.kernels.jit import part, summed
from subslide.kernels.waves import discriminant, discriminant_without_shear


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
def row_hyperbolicity(h1, u1, v1, h2, u2, v2, ratio, r, dry_depth, margin, start, stop):
    """Return how many of a row's cells start..stop-1 have complex speeds along their shear, and the smallest margin.

    Cells that are wet in both layers count. The margin of a cell is its discriminant over that without shear, each
    scaled to depths and shear of order 1: 1 without shear, 0 where two speeds meet, negative where they are complex.
    `ratio` is scratch, as long as the row: a loop that finds a minimum does not vectorise, so it gets one of its own.
    """
    one = type(r)(1)
    zero = type(r)(0)
    lost = 0.0
    first, count = part(start, stop)
    for k in range(count):
        i = k + first
        du = u1[i] - u2[i]
        dv = v1[i] - v2[i]
        wet = min(h1[i], h2[i]) > dry_depth
        sheared = discriminant(h1[i], h2[i], du * du + dv * dv, r)
        still = discriminant_without_shear(h1[i], h2[i], r)
        judged = (still if wet else zero) > margin
        found = sheared / (still if judged else one)
        ratio[i] = found if judged else one
        lost += 1.0 if (sheared if wet else one) < -margin else 0.0
    smallest = one
    for k in range(count):
        smallest = min(smallest, ratio[k + first])
    return lost, smallest
