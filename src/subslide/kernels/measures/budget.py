"""Volumes and energy: sums over a row."""

from subslide.kernels.jit import inlined, part, summed
from subslide.kernels.measures._series import SUM, Series

SERIES = {
    "water_volume": Series(SUM, lambda column, si: column * si.volume, layers=2),
    "sediment_volume": Series(SUM, lambda column, si: column * si.volume),
    "energy": Series(SUM, lambda column, si: column * si.volume * si.height * si.g),
}


@inlined
def measure(s, c, mesh, watch, span):
    """Return the volumes of water and of grains, and the energy, of a row's cells; still ones count by their size."""
    water, grains, energy = row_budget(
        c.h1, c.u1, c.v1, c.h2, c.u2, c.v2, mesh.weight, s.r, span.low, span.high
    )
    rest = mesh.size - (mesh.total[span.high] - mesh.total[span.low])
    h1, h2 = watch.still1, watch.still2
    energy_at_rest = 0.5 * (s.r * h1 * h1 + h2 * h2) + s.r * h1 * h2
    return water + rest * h1, grains + rest * h2, energy + rest * energy_at_rest


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
