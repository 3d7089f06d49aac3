"""Riemann solvers, each in the registry, and the fluxes of one edge."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from states import advance, axial
from states import settings as numbers
from test_waves import matrix

from subslide.kernels import viscosity
from subslide.kernels.edge.grains import grain_edge_fluxes
from subslide.kernels.edge.roe_matrix import Jump, Normal, RoeMatrix, times
from subslide.kernels.edge.two_layers import edge_fluxes
from subslide.kernels.viscosity.roe import roe
from subslide.kernels.waves import Waves, inner_speeds, outer_bounds, outer_speeds
from subslide.keys.names import SCHEMES

depths = st.floats(1e-3, 10.0)
speeds = st.floats(-1.5, 1.5)
ratios = st.floats(0.0, 0.95)
states = st.tuples(depths, speeds, depths, speeds)
NODES = {"rusanov": "max", "hll": "two", "ifcp": "three", "ifcph": "three"}
PARABOLAS = tuple(NODES)


def alpha(scheme, s_l, s_int, s_r, dry=False):
    """Return the coefficients of a solver for these speeds."""
    waves = Waves(s_l, s_int, s_r, s_l, s_r, 0.5 * (s_l + s_r), 0.0, s_l, s_r)
    return viscosity.alpha(numbers(1.0, scheme=scheme), waves, dry)


def polynomial(scheme, s_l, s_int, s_r, x, dry=False):
    a0, a1, a2 = alpha(scheme, s_l, s_int, s_r, dry)
    return a0 + a1 * x + a2 * x * x


def side(s_l, s_r):
    return np.sign(s_r) if abs(s_r) > abs(s_l) else np.sign(s_l)


def test_every_scheme_is_tested():
    assert {*NODES, "roe"} == set(SCHEMES)


@pytest.mark.parametrize("scheme", PARABOLAS)
@given(s_l=st.floats(-5, 5), width=st.floats(1e-3, 8), part=st.floats(0, 1))
def test_polynomial_takes_the_absolute_value_at_its_nodes(scheme, s_l, width, part):
    s_r = s_l + width
    s_int = side(s_l, s_r) * part * max(abs(s_l), abs(s_r))
    nodes = {"two": [s_l, s_r], "three": [s_l, s_r, s_int], "max": []}[NODES[scheme]]
    if s_l >= 0 or s_r <= 0:
        nodes = [] if scheme == "rusanov" else [s_l, s_r]
    for node in nodes:
        assert np.isclose(
            polynomial(scheme, s_l, s_int, s_r, node), abs(node), atol=1e-9 * (1 + abs(s_l) + abs(s_r))
        )
    for node in (s_l, s_r):
        assert polynomial(scheme, s_l, s_int, s_r, node) >= abs(node) - 1e-9


@pytest.mark.parametrize("scheme", PARABOLAS)
@settings(max_examples=200, deadline=None)
@given(h1=depths, u1=speeds, h2=depths, shear=st.floats(-0.4, 0.4), r=ratios)
def test_viscosity_is_at_least_upwind_on_all_four_waves(scheme, h1, u1, h2, shear, r):
    u2 = u1 + shear * np.sqrt((1 - r) * (h1 + h2))
    values = np.sort(np.linalg.eigvals(matrix(h1, u1, h2, u2, r)).real)
    s_l, s_r = values[0], values[3]
    s_int = side(s_l, s_r) * max(abs(values[1]), abs(values[2]))
    for value in values:
        p = polynomial(scheme, s_l, s_int, s_r, value)
        assert p >= abs(value) - 1e-7 * max(abs(s_l), abs(s_r))


def test_ifcph_is_hll_at_a_dry_edge_and_ifcp_elsewhere():
    speeds = (-1.0, -0.4, 2.0)
    assert alpha("ifcph", *speeds, dry=True) == alpha("hll", *speeds, dry=True)
    assert alpha("ifcph", *speeds) == alpha("ifcp", *speeds)


def fluxes(scheme, r, w_i, w_j, stuck=False, exact_front=True):
    """(advective and viscous flux, pressure product), each on (h1, q1, h2, q2)."""
    bounds = np.array([outer_speeds(*w, r) for w in (w_i, w_j)])
    d_eta = (w_j[0] + w_j[2]) - (w_i[0] + w_i[2])
    f1, m1, p1, f2, m2, p2 = edge_fluxes(
        numbers(1.0, scheme=scheme, r=r, exact_front=exact_front),
        stuck,
        bounds[:, 0].min(),
        bounds[:, 1].max(),
        Normal(*w_i),
        Normal(*w_j),
        d_eta,
    )
    return np.array([f1, m1, f2, m2]), np.array([0, p1, 0, p2])


def parts(r, w_i, w_j):
    """Whether a layer parts faster than its two sound speeds, where the viscosity is that of HLL."""
    c1, c2 = (np.sqrt(w_i[k]) + np.sqrt(w_j[k]) for k in (0, 2))
    return w_j[1] - w_i[1] > c1 or w_j[3] - w_i[3] > np.sqrt(1 - r) * c2


def conserved(w):
    h1, u1, h2, u2 = w
    return np.array([h1, h1 * u1, h2, h2 * u2])


def advection(w):
    h1, u1, h2, u2 = w
    return np.array([h1 * u1, h1 * u1**2, h2 * u2, h2 * u2**2])


def roe_mean(w_i, w_j):
    def velocity(h_i, u_i, h_j, u_j):
        a, b = np.sqrt(h_i), np.sqrt(h_j)
        return (a * u_i + b * u_j) / (a + b)

    h1, h2 = (w_i[0] + w_j[0]) / 2, (w_i[2] + w_j[2]) / 2
    return h1, velocity(w_i[0], w_i[1], w_j[0], w_j[1]), h2, velocity(w_i[2], w_i[3], w_j[2], w_j[3])


@given(w=states, d=st.tuples(speeds, speeds, speeds, speeds), r=ratios)
def test_products_with_the_roe_matrix(w, d, r):
    h1, u1, h2, u2 = w
    a = RoeMatrix(u1, h1 - u1 * u1, h1, u2, h2 - u2 * u2, h2, r * h2, 0.0, 0.0)
    np.testing.assert_allclose(times(a, Jump(*d)), matrix(*w, r) @ d, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("scheme", SCHEMES)
@given(w=states, r=ratios)
def test_equal_states_exchange_only_their_own_flux(scheme, w, r):
    flux, pressure = fluxes(scheme, r, w, w)
    np.testing.assert_array_equal(pressure, 0)
    np.testing.assert_allclose(flux, advection(w), rtol=1e-14, atol=1e-14)


@pytest.mark.parametrize("scheme", SCHEMES)
@settings(deadline=None)
@given(w_i=states, w_j=states, r=ratios)
def test_fluctuations_add_up_to_the_roe_matrix_times_the_jump(scheme, w_i, w_j, r):
    flux, pressure = fluxes(scheme, r, w_i, w_j)
    left = flux - advection(w_i) + pressure / 2
    right = advection(w_j) - flux + pressure / 2
    jump = conserved(w_j) - conserved(w_i)
    scale = 1 + np.abs(advection(w_i)).max() + np.abs(advection(w_j)).max() + np.abs(pressure).max()
    np.testing.assert_allclose(left + right, matrix(*roe_mean(w_i, w_j), r) @ jump, atol=1e-12 * scale)


@pytest.mark.parametrize("scheme", PARABOLAS)
@settings(deadline=None)
@given(w_i=states, w_j=states, r=ratios)
def test_viscosity_is_the_polynomial_of_the_roe_matrix(scheme, w_i, w_j, r):
    torn = {"ifcp": "rusanov", "ifcph": "hll"}
    kind = torn.get(scheme, scheme) if parts(r, w_i, w_j) else scheme
    mean = roe_mean(w_i, w_j)
    speeds = np.array([outer_speeds(*w, r) for w in (w_i, w_j, mean)])
    s_l, s_r = speeds[:, 0].min(), speeds[:, 1].max()
    centre, half = inner_speeds(*mean, r, *speeds[2])
    s_int = side(s_l, s_r) * (abs(centre) + np.sqrt(max(half, 0)))
    a0, a1, a2 = alpha(kind, s_l, s_int, s_r)
    a = matrix(*mean, r)
    jump = conserved(w_j) - conserved(w_i)
    viscous = (a0 * np.eye(4) + a1 * a + a2 * a @ a) @ jump
    flux, _ = fluxes(scheme, r, w_i, w_j)
    expected = (advection(w_i) + advection(w_j) - viscous) / 2
    np.testing.assert_allclose(
        flux, expected, atol=1e-10 * (1 + np.abs(expected).max() + np.abs(a).max() ** 2)
    )


@pytest.mark.parametrize("scheme", SCHEMES)
@settings(deadline=None)
@given(w_i=states, w_j=states, r=ratios, stuck=st.booleans())
def test_a_mirrored_edge_has_mirrored_fluxes_to_the_bit(scheme, w_i, w_j, r, stuck):
    def mirrored(w):
        return w[0], -w[1], w[2], -w[3]

    flux, pressure = fluxes(scheme, r, w_i, w_j, stuck)
    other, push = fluxes(scheme, r, mirrored(w_j), mirrored(w_i), stuck)
    np.testing.assert_array_equal(other, flux * [-1, 1, -1, 1])
    np.testing.assert_array_equal(push, -pressure)


@settings(deadline=None)
@given(h_i=st.tuples(depths, depths), h_j=st.tuples(depths, depths), r=ratios)
def test_a_stuck_edge_sees_the_jump_less_what_friction_holds(h_i, h_j, r):
    """Eq. (8) with the inverse of the matrix at rest, and friction as large as the slope of the grains asks for."""
    w_i, w_j = (h_i[0], 0.0, h_i[1], 0.0), (h_j[0], 0.0, h_j[1], 0.0)
    a = matrix(*roe_mean(w_i, w_j), r)
    d = conserved(w_j) - conserved(w_i)
    friction = (1 - r) * (h_i[1] + h_j[1]) / 2 * d[2]
    seen = d - np.linalg.solve(a, [0, 0, 0, friction])
    bounds = np.array([outer_speeds(*w, r) for w in (w_i, w_j, roe_mean(w_i, w_j))])
    a0, a1, _ = alpha("hll", bounds[:, 0].min(), 0.0, bounds[:, 1].max())
    viscous = a0 * seen + a1 * a @ seen
    flux, pressure = fluxes("hll", r, w_i, w_j, stuck=True)
    scale = 1e-9 * (1 + np.abs(d).max() ** 2 + np.abs(a).max() ** 2)
    by_weight = (
        (h_i[1] - h_j[1]) * (r * d[0] + d[2]) / 4
    )  # each side is pushed by its own depth, not by the mean
    np.testing.assert_allclose(flux, [*-viscous[:3] / 2, by_weight - viscous[3] / 2], atol=scale)
    np.testing.assert_allclose(pressure, a @ d, atol=scale)


def test_an_edge_takes_the_bounds_of_both_its_cells():
    """HLL between two cells, the second of which has both the slowest and the fastest wave, and turned round."""
    states = np.array([(1.0, 0.0, 0.1, 0.0), (0.8, -0.2, 3.0, -0.1)])
    own = [outer_bounds(*w, 0.4) for w in states]
    assert own[1][0] < own[0][0] < 0 < own[0][1] < own[1][1]
    for turn in (1, -1):
        w_i, w_j = states[::turn]
        model = axial(np.arange(3) * 0.1, *states[::turn].T, level=2.0, scheme="hll", exact_front=False)
        advance(model, steps=1)
        s_l, s_r = own[1]
        passed = (s_r * w_i[::2] * w_i[1::2] - s_l * w_j[::2] * w_j[1::2] + s_l * s_r * (w_j - w_i)[::2]) / (
            s_r - s_l
        )
        np.testing.assert_allclose([model.fluxes.f1[1], model.fluxes.f2[1]], passed, rtol=1e-12)


@pytest.mark.parametrize("layer", [0, 2])
def test_a_film_up_to_the_dry_depth_takes_hll(layer):
    def differs(depth):
        w = [0.5, 0.3, 0.5, -0.1]
        w[layer] = depth
        pairs = [
            fluxes(scheme, 0.4, w, (0.6, 0.1, 0.4, 0.2), exact_front=False)[0] for scheme in ("ifcph", "hll")
        ]
        return not np.array_equal(*pairs)

    assert not differs(1e-6)
    assert differs(1.1e-6)


def test_no_grain_passes_a_stuck_edge_even_under_a_wave():
    flux, _ = fluxes("ifcph", 0.6, (1.0, 0.3, 0.5, 0.0), (1.2, -0.1, 0.4, 0.0), stuck=True)
    assert flux[2] == 0
    assert flux[0] != 0


@given(h_i=depths, u_i=speeds, h_j=depths, u_j=speeds)
def test_grains_alone_are_consistent(h_i, u_i, h_j, u_j):
    f, m, p = grain_edge_fluxes(numbers(1.0, scheme="hll"), False, h_i, u_i, h_i, u_i)
    np.testing.assert_allclose([f, m, p], [h_i * u_i, h_i * u_i**2, 0], atol=1e-13)
    f, m, p = grain_edge_fluxes(numbers(1.0, scheme="hll"), False, h_i, u_i, h_j, u_j)
    back = grain_edge_fluxes(numbers(1.0, scheme="hll"), False, h_j, -u_j, h_i, -u_i)
    assert back == (-f, m, -p)


@given(
    nodes=st.lists(st.integers(-96, 96).map(lambda n: n / 32), min_size=4, max_size=4), more=st.floats(0, 1)
)
def test_roe_polynomial_takes_the_absolute_value_at_four_speeds(nodes, more):
    x = np.sort(nodes)
    a = roe(*x, abs(x[0]) + more * (x[1] - x[0] > 0.1), abs(x[3]))
    assert np.all(np.isfinite(a))
    gap = np.diff(x).min()
    for node, value in zip(x[1:], np.abs(x[1:]), strict=True):
        assert np.isclose(np.polyval(a[::-1], node), value, atol=1e-9 * (1 + 1 / max(gap, 1e-3) ** 3))


@given(speeds=st.tuples(*[st.sampled_from([-1.0, -0.5, 0.0, 0.5, 1.0])] * 4))
def test_roe_polynomial_survives_equal_speeds(speeds):
    x = sorted(speeds)
    a = roe(*x, abs(x[0]), abs(x[3]))
    np.testing.assert_allclose([np.polyval(a[::-1], node) for node in x], np.abs(x), atol=1e-12)


@settings(max_examples=200, deadline=None)
@given(w_i=states, w_j=states, r=st.floats(0.05, 0.95))
def test_roe_viscosity_is_the_absolute_value_of_the_roe_matrix(w_i, w_j, r):
    assume(not parts(r, w_i, w_j))
    mean = roe_mean(w_i, w_j)
    values, vectors = np.linalg.eig(matrix(*mean, r))
    gap = np.diff(np.sort(values.real)).min()
    assume(np.abs(values.imag).max() < 1e-12 and gap > 1e-2)
    bounds = np.array([outer_speeds(*w, r) for w in (w_i, w_j)])
    opens = bounds[:, 0].min() < values.real.min() - abs(values.real.min())
    assume(not opens and bounds[:, 1].max() - values.real.max() <= abs(values.real.max()))
    viscous = (vectors * np.abs(values)) @ np.linalg.solve(vectors, conserved(w_j) - conserved(w_i))
    flux, _ = fluxes("roe", r, w_i, w_j)
    expected = (advection(w_i) + advection(w_j) - viscous.real) / 2
    np.testing.assert_allclose(flux, expected, atol=1e-9 * (1 + np.abs(expected).max()))


@given(h=depths, r=ratios, w=st.floats(-3, 3))
def test_grains_run_onto_a_dry_bed_as_the_fan_of_a_dam_break(h, r, w):
    flux, pressure = fluxes("ifcph", r, (1.0, 0.0, h, w), (1.0 + h, 0.0, 0.0, 0.0))
    c = np.sqrt((1 - r) * h)
    u = w if w >= c else max(0.0, (w + 2 * c) / 3)
    depth = h if w >= c else u**2 / (1 - r)
    total = depth * u**2 + (1 - r) * depth**2 / 2  # the wet cell loses this, the dry one gains it
    np.testing.assert_allclose(flux[2], depth * u, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(flux[3] - pressure[3] / 2, total, rtol=1e-9, atol=1e-12)


def test_a_flat_surface_over_a_front_stays_flat():
    flux, pressure = fluxes("ifcph", 0.6, (1.0, 0.0, 0.5, 0.0), (1.5, 0.0, 0.0, 0.0))
    assert flux[0] == -flux[2] != 0
    assert pressure[1] == 0


def test_an_exact_front_changes_nothing_between_wet_cells():
    inside = (1.0, 0.1, 0.5, 0.2), (1.1, 0.0, 0.4, 0.1)
    for exact, hll in zip(
        fluxes("ifcph", 0.6, *inside), fluxes("ifcph", 0.6, *inside, exact_front=False), strict=True
    ):
        np.testing.assert_array_equal(exact, hll)


def test_the_front_under_weightless_water_is_the_front_of_grains_alone():
    grains, water = (0.4, 0.7), (0.3, 0.0)
    flux, _ = fluxes("ifcph", 0.0, (*water, *grains), (*water, 0.0, 0.0))
    f, m, _ = grain_edge_fluxes(numbers(1.0, scheme="hll"), False, *grains, 0.0, 0.0)
    np.testing.assert_allclose(flux[2:], [f, m], rtol=1e-14)
