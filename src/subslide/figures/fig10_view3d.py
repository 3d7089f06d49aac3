"""Paper's Figure 10: the grains and the water surface in three dimensions, r = 0.4 and a_H = 1."""

from typing import TYPE_CHECKING, Any, NamedTuple

import matplotlib as mpl
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from subslide.figures import _kinds, _profiles, _slices, _style, _water, _words

if TYPE_CHECKING:
    from subslide.results import Results

TITLE = "Grains and water surface in three dimensions, r = 0.4, a_H = 1"
CATEGORY = "4 Views"
NEEDS = {"scene": ("cylinder",), "a_H": (1,), "r": (0.4,)}

REACH = 3.0
"""Half-width of the view over R."""
OPEN = np.radians((-100.0, -20.0))
"""Sector left out of the water, so that the grains are seen."""
FLAT = 0.5
"""Height of the drawn box over its width."""
WATER = mpl.colors.ListedColormap(mpl.colormaps["Blues_r"](np.linspace(0.1, 0.95, 256)))
GRAINS = mpl.colors.ListedColormap(mpl.colormaps["YlOrBr"](np.linspace(0.3, 0.95, 256)))

LIGHT = mpl.colors.LightSource(azdeg=190, altdeg=55)


@_style.styled
def draw(results: "Results") -> Figure:
    """Return the figure: four times; the grains and, above them, the water with a sector cut away.

    Parameters
    ----------
    results
        A finished study.

    Returns
    -------
    Figure
        A row for each of four times and a column for each kind of numerics, or two panels a row if there is one.
    """
    kinds = _kinds.of(results, a_H=1, r=0.4)
    first = kinds[0].runs.iloc[0]
    radius, height = _slices.sizes(kinds[0].runs)
    level = _slices.column(first).level
    views = [View.of(results, kind) for kind in kinds]
    times = _profiles.times_of([view.grains for view in views], 4) or [0.0]
    waves = [_profiles.at(view.waves, time) for view in views for time in times]
    largest = max((_largest(profile, radius) for profile in waves if profile is not None), default=0.0)
    scale = max((s for s in (1, 2, 5, 10, 20, 50, 100) if s * largest <= height / 2), default=1)
    x_unit, unit, t_unit = (
        _words.length_unit(2 * radius),
        _words.length_unit(height),
        _words.time_unit(*times),
    )
    norm = mpl.colors.Normalize(-largest * unit.factor, largest * unit.factor)

    options = {"projection": "3d", "computed_zorder": False}
    panels = [(time, kind, view) for time in times for kind, view in zip(kinds, views, strict=True)]
    figure, axes = _style.panels(len(panels), min(2, len(panels)), 2.6, subplot_kw=options)
    for k, (ax, (time, kind, view)) in enumerate(zip(axes, panels, strict=True)):
        pile, surface = _profiles.at(view.grains, time), _profiles.at(view.waves, time)
        if pile is not None:
            _pile(ax, pile, radius, height, x_unit, unit)
        if surface is not None:
            x, y, z = _turned(surface, radius, surface.x[-1], np.linspace(OPEN[1], OPEN[0] + 2 * np.pi, 81))
            x, y, lifted = x * x_unit.factor, y * x_unit.factor, (level + scale * z) * unit.factor
            _surface(ax, x, y, lifted, WATER(norm(z * unit.factor)), shade=False, alpha=0.9, zorder=2)
            _edges(ax, x, y, lifted)
        _frame(ax, REACH * radius * x_unit.factor, 1.25 * level * unit.factor)
        ax.set_xlabel(_words.label("x", x_unit), labelpad=-4)
        ax.set_ylabel(f"$y$ ({x_unit.name})", labelpad=-4)
        ax.set_zlabel(f"height ({unit.name})", labelpad=-5)
        ax.set_title(_words.panel(k, kind.called(_words.moment(time, t_unit))), y=0.97)
    if largest > 0:
        shades = mpl.cm.ScalarMappable(norm, WATER)
        bar = figure.colorbar(shades, ax=axes, orientation="horizontal", fraction=0.03, aspect=45, pad=0.02)
        bar.set_label(
            f"displacement of the water surface {_words.label('eta', unit)}; drawn {scale} times too high"
        )
    notes = [_heights(FLAT * 2 * REACH * radius / (1.25 * level), scale)]
    notes += [kind.called(f"{_words.solver(kind.runs)}.") for kind in kinds if kind.name]
    if largest > 0:
        notes += _water.convergence(results, _kinds.of(results, a_H=1), times[:2], t_unit, bars=False)
    title = f"Grains and water surface, {_words.equation('r', 0.4)}, {_words.equation('a_H', 1)}"
    runs = pd.concat([kind.runs for kind in kinds])
    notes += [*_water.wet(runs)[1], *kinds[0].chosen.notes, *_words.trouble(runs)]
    return _style.finish(figure, title, _kinds.about(kinds), notes)


class View(NamedTuple):
    """Profiles of the one run of a kind: of its grains, and of the water's surface if it has one."""

    grains: list[_profiles.Profile]
    waves: list[_profiles.Profile]

    @classmethod
    def of(cls, results: "Results", kind: _kinds.Kind) -> "View":
        """Return that of a kind."""
        name = kind.runs.iloc[0]["id"]
        wet, _ = _water.wet(kind.runs)
        waves = _profiles.of_run(results, name, "eta") if len(wet) else []
        return cls(_profiles.of_run(results, name, "h2"), waves)


def _heights(steep: float, scale: int) -> str:
    """Return what is drawn, and how far heights are stretched, in words."""
    return (
        "Brown: grains. Blue: water surface, with a sector left out. Both are profiles along the $x$ axis, turned "
        f"about the axis of the column. Heights are stretched {steep:.2g} times against lengths, displacements of the "
        f"water surface {scale} times more."
    )


def _pile(
    ax: Axes,
    pile: _profiles.Profile,
    radius: float,
    height: float,
    x_unit: _words.Unit,
    unit: _words.Unit,
) -> None:
    """Draw the grains of a profile (m), turned about the axis."""
    x, y, z = _turned(pile, radius, _profiles.reach([pile], 1e-3 * height), np.linspace(2 * np.pi, 0, 97))
    x, y = x * x_unit.factor, y * x_unit.factor
    shades = GRAINS(z / height)
    _surface(ax, x, y, z * unit.factor, shades, shade=True, lightsource=LIGHT, zorder=1)


def _turned(
    profile: _profiles.Profile, radius: float, far: float, angles: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return x, y and the values of a profile (m) within `far`, turned about the axis."""
    r = np.linspace(1e-3 * radius, min(REACH * radius, far), 65)[:, None]
    values = np.interp(r, profile.x, profile.values)
    return r * np.cos(angles), r * np.sin(angles), values + 0 * angles


def _surface(
    ax: Axes, x: np.ndarray, y: np.ndarray, z: np.ndarray, shades: np.ndarray, **options: Any
) -> None:
    """Draw a surface as facets of given colours."""
    still = {"rstride": 1, "cstride": 1, "linewidth": 0, "antialiased": False, "rasterized": True}
    ax.plot_surface(x, y, z, facecolors=shades, **still, **options)


def _edges(ax: Axes, x: np.ndarray, y: np.ndarray, z: np.ndarray) -> None:
    """Draw rings and the two cut edges of a surface, for prints without colour."""
    for ring in range(len(z) - 1, 0, -8):
        ax.plot(x[ring], y[ring], z[ring], color="0.25", linewidth=0.4, zorder=3)
    for cut in (0, -1):
        ax.plot(x[:, cut], y[:, cut], z[:, cut], color="0.1", linewidth=0.9, zorder=3)


def _frame(ax: Axes, reach: float, top: float) -> None:
    """Set the limits, the proportions and the view of a panel."""
    ax.set(xlim=(-reach, reach), ylim=(-reach, reach), zlim=(0, top))
    ax.set_box_aspect((1, 1, FLAT), zoom=1.15)
    ax.view_init(elev=24, azim=-60)
    ax.tick_params(pad=-2, labelsize=6.5)


def _largest(profile: _profiles.Profile, radius: float) -> float:
    """Return the largest absolute value (m) of a profile within the view."""
    return float(np.abs(profile.values[profile.x <= REACH * radius]).max())
