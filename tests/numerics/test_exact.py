"""Convergence to exact solutions."""

from importlib import import_module

import numpy as np
import pytest
from states import advance, axial, inner

from subslide.exact import dam_break, riemann
from subslide.exact.paraboloid import depth, radius, ring_mean
from subslide.scenes import standing_wave
from subslide.scenes._bessel import bessel, zero_of_j1
from subslide.solver import solve
from subslide.study import config

END = np.sqrt((2.69**2 - 1) / 2)  # R / R0 = 2.69


def error(dx, order, layers):
    """Relative L1 error of the paraboloid's depth at END; CFL 0.9."""
    edges = np.arange(round(3.2 / dx) + 1) * dx
    h2 = ring_mean(edges, 0.0)
    h1 = 0 if layers == 1 else 2.0 - h2
    model = axial(
        edges,
        h1,
        0,
        h2,
        0,
        level=2.0,
        layers=layers,
        r=0.0,
        m=0.0,
        order=order,
        radial=True,
        walls=(True, 3),
    )
    advance(model, stop=END)
    exact = ring_mean(edges, END)
    ring = np.diff(edges**2)
    return np.abs((inner(model, "h2") - exact) * ring).sum() / (exact * ring).sum()


@pytest.mark.parametrize(("order", "rate", "largest"), [(1, 0.8, 0.04), (2, 1.7, 0.003)])
def test_dry_paraboloid_converges_from_2_to_half_a_millimetre(order, rate, largest):
    errors = [error(size / 70.5, order, layers=1) for size in (2.0, 1.0, 0.5)]
    assert errors[0] < largest
    assert np.log2(errors[0] / errors[2]) / 2 > rate


@pytest.mark.parametrize("order", [1, 2])
def test_paraboloid_under_weightless_water_converges(order):
    errors = [error(size / 70.5, order, layers=2) for size in (2.0, 0.5)]
    assert np.log2(errors[0] / errors[1]) / 2 > 0.5


def test_the_paraboloid_keeps_its_volume():
    edges = np.linspace(0, 4, 4001)
    for t in (0.0, 0.7, END):
        assert np.isclose((ring_mean(edges, t) * np.diff(edges**2)).sum() * np.pi, np.pi / 2, rtol=1e-12)
        assert depth(radius(t), t) == 0
        centres = (edges[1:] + edges[:-1]) / 2
        np.testing.assert_allclose(ring_mean(edges, t), depth(centres, t), atol=1e-3)


def solved(**values):
    """Run of a point, and its exact profiles at the end."""
    point = config.make_point({"delta": 0, **values})
    run = solve(point)
    assert run.status == "ok"
    exact = import_module(f"subslide.exact.{point.scene}")
    return run, exact.solution(point, run.x, run.snapshot_time[-1])


def test_stokers_middle_state_is_the_published_one():
    h, u, shock = dam_break.middle(0.005, 0.001, 9.81)
    assert (h, u, shock) == pytest.approx((2.53936e-3, 0.127280, 0.209963), rel=1e-5)
    assert shock * (h - 0.001) == pytest.approx(h * u, rel=1e-12)  # mass
    push = 9.81 * (h**2 - 0.001**2) / 2
    assert shock * h * u == pytest.approx(h * u**2 + push, rel=1e-12)  # momentum


@pytest.mark.parametrize("right", [0.0, 0.05, 0.2, 0.9])
def test_dam_breaks_keep_their_mass(right):
    x = np.linspace(-4, 4, 400_001)
    for t in (0.0, 0.5, 1.5):
        h = dam_break.depth(x, t, 1.0, right)
        assert np.trapezoid(h, x) == pytest.approx(4 * (1 + right), abs=2e-5)


@pytest.mark.parametrize("downstream", [0.0, 0.2])
@pytest.mark.parametrize(
    "keys", [{"model": "one-layer"}, {"model": "line"}, {"scene_options": {"layer": "water"}}]
)
def test_dam_breaks_converge(downstream, keys):
    options = {**keys.get("scene_options", {}), "downstream": downstream}
    keys = {"t_end": 0.07, "boundary": "wall", **keys, "scene_options": options}
    errors = []
    for cells in (100, 200):
        run, exact = solved(scene="dam_break", cells=cells, r=0, **keys)
        name = "eta" if "layer" in options else "h2"
        assert np.isfinite(exact[name]).all()
        errors.append(np.abs(getattr(run, name)[-1] - exact[name]).sum() / np.abs(exact[name]).sum())
    assert errors[1] < 0.012
    assert errors[1] < 0.65 * errors[0]


def test_the_shallow_water_dam_break_is_stokers_at_its_size():
    """0.005 m over 0.001 m: a_H = 0, so that the water is H2 = a_2 R = 0.005 m deep."""
    keys = {"radius": 0.05, "a_2": 0.1, "a_H": 0, "cells": 400}
    run, exact = solved(
        scene="dam_break", scene_options={"layer": "water", "downstream": 0.2}, t_end=0.5, **keys
    )
    middle = (run.x > 0.04) & (run.x < 0.09)
    np.testing.assert_allclose(0.005 + exact["eta"][middle], 2.53936e-3, rtol=1e-5)
    np.testing.assert_allclose(0.005 + run.eta[-1][middle], 2.53936e-3, rtol=2e-3)


def test_the_coulomb_edge_decelerates_and_stops():
    friction = 0.7
    stop = 2 / friction
    t = np.array([0.3, 0.9])
    speed = (dam_break.edge(t + 1e-6, friction) - dam_break.edge(t - 1e-6, friction)) / 2e-6
    np.testing.assert_allclose(speed, 2 - friction * t, rtol=1e-8)
    assert dam_break.edge(stop, friction) == dam_break.edge(2 * stop, friction) == pytest.approx(2 / friction)
    assert dam_break.edge(0.8, 0.0) == pytest.approx(1.6)


def test_a_coulomb_dam_break_stops_short_of_its_edge():
    point = config.make_point(
        {"scene": "dam_break", "boundary": "wall", "r": 0, "quantities": "grains", "cells": 800}
    )
    run = solve(point)
    assert run.model == "one-layer"
    edge = np.array([dam_break.edge_position(point, t) for t in run.time])
    assert np.all(run.x_front[0] <= edge + point.dx)
    assert run.L_f[0] / edge[-1] == pytest.approx(1.53 / 2, abs=0.01)  # the limit of fine grids
    assert np.isnan(dam_break.solution(point, run.x, 0.1)["h2"]).all()


def test_bessel_functions_and_the_zeros_of_j1():
    np.testing.assert_allclose(
        bessel(0, [0, 1, 10]), [1, 0.7651976865579666, -0.2459357644513483], atol=1e-14
    )
    np.testing.assert_allclose(
        bessel(1, [0, 1, 10]), [0, 0.4400505857449335, 0.04347274616886144], atol=1e-14
    )
    x = 300.0
    p, q = 1 - 9 / (128 * x**2), -1 / (8 * x) + 75 / (1024 * x**3)  # Hankel's expansion
    far = np.sqrt(2 / (np.pi * x)) * (p * np.cos(x - np.pi / 4) - q * np.sin(x - np.pi / 4))
    assert float(bessel(0, x)) == pytest.approx(far, abs=1e-11)
    zeros = [3.8317059702075125, 7.015586669815619, 10.173468135062722]
    assert [zero_of_j1(n) for n in (1, 2, 3)] == pytest.approx(zeros, rel=1e-14)


@pytest.mark.parametrize("kind", ["surface", "internal"])
@pytest.mark.parametrize(("h1", "r"), [(1.0, 0.4), (0.3, 0.8), (4.0, 0.1), (0.5, 0.0), (2.0, 0.0)])
def test_standing_waves_are_eigenvectors_of_the_two_layers(kind, h1, r):
    c2 = standing_wave.speed(kind, h1, 1.0, r) ** 2
    dh1, dh2 = standing_wave.parts(kind, h1, 1.0, r)
    assert max(dh1, abs(dh2)) == 1
    assert c2 * dh1 == pytest.approx(h1 * (dh1 + dh2), abs=1e-14)
    assert c2 * dh2 == pytest.approx(r * dh1 + dh2, abs=1e-14)


@pytest.mark.parametrize("kind", ["surface", "internal"])
@pytest.mark.parametrize(("shape", "mode"), [("line", 3), ("round", 2)])
def test_standing_waves_converge_at_second_order(kind, shape, mode):
    options = {"kind": kind, "shape": shape, "mode": mode}
    errors = []
    for cells in (50, 100):
        run, exact = solved(
            scene="standing_wave", scene_options=options, boundary="wall", cells=cells, t_end=0.5
        )
        height = 1e-5 * 0.56 * 0.0705
        errors.append(
            [np.abs(getattr(run, name)[-1] - exact[name]).mean() / height for name in ("h2", "eta")]
        )
    assert np.all(np.log2(np.divide(*errors)) > 1.7)
    assert np.max(errors[1]) < 0.005


def test_no_exact_solution_is_claimed_with_friction():
    x = np.linspace(-0.1, 0.1, 5)
    for scene, boundary in (("paraboloid", "open"), ("dam_break", "wall"), ("standing_wave", "wall")):
        module = import_module(f"subslide.exact.{scene}")
        for keys, known in (
            ({"delta": 0}, True),
            ({"delta": 5}, False),
            ({"delta": 0, "friction": "voellmy"}, False),
        ):
            point = config.make_point({"scene": scene, "boundary": boundary, "r": 0, **keys})
            assert np.isfinite(module.solution(point, x, 0.01)["h2"]).all() == known


def test_the_paraboloid_scene_is_its_solution_at_the_start():
    run, exact = solved(scene="paraboloid", r=0, quantities="grains", cells=100, t_end=0.12)
    np.testing.assert_allclose(run.h2[0], depth(run.x / 0.0705, 0) * 0.56 * 0.0705, atol=2e-4)
    assert np.abs(run.h2[-1] - exact["h2"]).sum() / exact["h2"].sum() < 0.006


@pytest.mark.parametrize(("a_H", "r"), [(2.0, 0.2), (2.0, 0.8), (5.0, 0.6), (10.0, 0.4)])
def test_the_coupled_fan_is_a_wave_that_meets_the_water_beyond_it(a_H, r):
    fan = riemann.fan(a_H, r)
    assert np.all(np.diff(fan.place) > -1e-9)
    assert fan.h2[-3] == 0
    # both volumes hold: what is beyond x = 0 has left the other side
    edges = np.concatenate([[-5.0], fan.place, [5.0]])
    for inside, left, right in ((fan.h2, 1.0, 0.0), (fan.h1, a_H, 1 + a_H)):
        whole = np.concatenate([[left], inside, [right]])
        assert np.trapezoid(whole, edges) == pytest.approx(5 * (left + right), abs=1e-3)


def test_without_pull_the_coupled_fan_is_that_of_ritter():
    fan = riemann.fan(1000.0, 1e-9)
    inner = (fan.place > -0.9) & (fan.place < 2)
    np.testing.assert_allclose(fan.h2[inner], (2 - fan.place[inner]) ** 2 / 9, atol=1e-3)


@pytest.mark.parametrize(("a_H", "r"), [(2.0, 0.4), (10.0, 0.8)])
@pytest.mark.parametrize(("order", "rate"), [(1, 0.5), (2, 0.9)])
def test_the_coupled_dam_break_converges(a_H, r, order, rate):
    errors = []
    for cells in (200, 800):
        run, known = solved(
            scene="riemann", a_H=a_H, r=r, delta=0, boundary="wall", order=order, cells=cells, t_end=0.14
        )
        pairs = ((getattr(run, key)[-1], known[key]) for key in ("h2", "eta"))
        errors.append([np.abs(one - other).sum() / np.abs(other).sum() for one, other in pairs])
    coarse, fine = errors
    assert (np.log2(np.divide(coarse, fine)) / 2 > rate).all()
    assert (np.array(fine) < [0.007, 0.11]).all()
