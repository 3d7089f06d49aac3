"""Periodic boxes have no place of their own, and keep mass and momentum."""

import numpy as np
import pytest
from states import advance, axial, inner, plane

N, DX, R = 64, 0.05, 0.7
EDGES = np.arange(N + 1) * DX
PERIODIC = 2


def layers(shape, dry, seed=3):
    """h1, h2 and four velocities of a rough periodic state; grains in patches, some of them thin, if `dry`."""
    rng = np.random.default_rng(seed)
    h2 = rng.uniform(0.2, 1.0, shape)
    if dry:
        h2[rng.uniform(size=shape) < 0.3] = 0
        h2[rng.uniform(size=shape) < 0.3] = 1e-3  # of which IFCP would take more than there is
    fastest = 1.0 if dry else 0.3
    return 1.5 - h2, h2, rng.uniform(-fastest, fastest, (4, *shape)) * (h2 > 0)


def on_a_line(order, dry, shift=0):
    h1, h2, (u1, u2, *_) = (np.roll(values, shift, axis=-1) for values in layers((N,), dry))
    options = {"order": order, "r": R, "m": 0.0 if not dry else 0.5, "level": 1.5, "scheme": "ifcp"}
    return axial(EDGES, h1, u1, h2, u2, walls=(PERIODIC, PERIODIC), **options)


def in_the_plane(order, dry, shift=(0, 0)):
    h1, h2, u = layers((24, 24), dry)
    h1, h2, *u = (np.roll(values, shift, axis=(0, 1)) for values in (h1, h2, *u))
    velocities = dict(zip(("u1", "u2", "v1", "v2"), u, strict=True))
    options = {"order": order, "r": R, "m": 0.5 if dry else 0.0, "level": 1.5, "scheme": "ifcp"}
    return plane(EDGES[:25], h1, h2, walls=(PERIODIC,) * 4, **velocities, **options)


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("dry", [False, True])
def test_a_moved_start_on_a_line_gives_the_moved_answer_to_the_bit(order, dry):
    """Moved so that cells which drain at once, and their limited fluxes, come to either side of the ends."""
    one = on_a_line(order, dry)
    advance(one, steps=1)
    drained = np.flatnonzero(inner(one.terms, "keep2") < 1)
    assert (len(drained) > 1) == dry
    one = on_a_line(order, dry)
    advance(one, steps=60)
    assert inner(one, "h2").min() >= 0
    for shift in (13, *-drained, *(N - 1 - drained)):
        other = on_a_line(order, dry, shift)
        advance(other, steps=60)
        for name in ("h1", "u1", "h2", "u2"):
            assert np.array_equal(np.roll(inner(one, name), shift), inner(other, name))


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("dry", [False, True])
def test_a_moved_start_in_the_plane_gives_the_moved_answer_to_the_bit(order, dry):
    one = in_the_plane(order, dry)
    advance(one, steps=1)
    drained = np.argwhere(inner(one.terms, "keep2") < 1)
    assert (len(drained) > 1) == dry
    one = in_the_plane(order, dry)
    advance(one, steps=30)
    for shift in ((5, -7), *-drained[:3], *(23 - drained[:3])):
        other = in_the_plane(order, dry, tuple(shift))
        advance(other, steps=30)
        for name in ("h1", "u1", "v1", "h2", "u2", "v2"):
            assert np.array_equal(np.roll(inner(one, name), shift, axis=(0, 1)), inner(other, name))


@pytest.mark.parametrize("make", [on_a_line, in_the_plane])
@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("dry", [False, True])
def test_mass_and_momentum_stay_in_the_box(make, order, dry):
    model = make(order, dry)

    def totals():
        h1, h2 = inner(model, "h1"), inner(model, "h2")
        momenta = [
            (R * h1 * inner(model, a) + h2 * inner(model, b)).sum() for a, b in (("u1", "u2"), ("v1", "v2"))
        ]
        return np.array([h1.sum(), h2.sum(), *([] if dry else momenta)])  # friction takes momentum

    before = totals()
    advance(model, steps=60)
    np.testing.assert_allclose(totals(), before, rtol=1e-13, atol=1e-12)
