"""Profiles along the x axis at given times, as figures draw them."""

from collections.abc import Iterable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from subslide import naming
from subslide.figures import _kinds, _style, _words
from subslide.results import positions

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes

    from subslide.results import Results


class Profile(NamedTuple):
    """One profile: time (s), position and value (m), if asked for, if at the end of the run, if grains are at rest."""

    time: float
    x: np.ndarray
    values: np.ndarray
    asked: bool
    last: bool
    at_rest: bool


def of_run(results: "Results", name: str, variable: str) -> list[Profile]:
    """Return the finite profiles of a run, earliest first; from half a cell before the axis.

    The profile at the end of a failed run, unless its time was asked for, is none that other runs have, and left out.

    Parameters
    ----------
    results
        The study.
    name
        Id of the run.
    variable
        Name of the profiles in its record, such as ``h2``.
    """
    record = results.profiles(name)
    wanted = next(run.point.profile_times for run in results.runs_of_study if run.id == name)
    times = np.atleast_1d(record["snapshot_time"].to_numpy())
    rest = float(record["time_at_rest"])
    finished = str(record["status"].item()) in naming.FINISHED
    profiles = []
    for k, time in enumerate(times):
        values = record[variable].isel(snapshot=k).to_numpy()
        seen = np.isfinite(values)
        if not np.isfinite(time) or not seen.any():
            continue
        xs, values = positions(record, k)[seen], values[seen]
        if xs[0] > 0:
            xs, values = np.concatenate([-xs[:1], xs]), np.concatenate([values[:1], values])
        asked, end = float(time) in wanted, k == len(times) - 1
        last = end and finished
        if asked or last:
            profiles.append(Profile(float(time), xs, values, asked, last, last and rest <= time))
    return profiles


def at(profiles: list[Profile], time: float | None) -> Profile | None:
    """Return the profile at `time` (s), at the end of a finished run if None; None where there is none."""
    if time is None:
        return next((p for p in profiles if p.last), None)
    return next((p for p in profiles if abs(p.time - time) <= 1e-3 * max(time, 1e-12)), None)


def draw(
    ax: "Axes",
    kinds: Iterable[_kinds.Kind],
    rows: "pd.DataFrame",
    shapes: dict[str, list[Profile]],
    time: float | None,
    looks: dict[float, _style.Look],
    units: tuple[_words.Unit, _words.Unit],
) -> list[str]:
    """Draw the profiles of runs at a time, a line for each r and kind of numerics, and return what has none, in words.

    Parameters
    ----------
    ax
        Panel to draw in.
    kinds, rows
        Kinds of numerics, and the rows of the table of runs to draw.
    shapes
        Profiles by id of the run.
    time
        Time (s); None for the end of the run.
    looks
        Look of each r.
    units
        Units of x and of the values.
    """
    missing = []
    for kind in kinds:
        for _, row in rows[rows["id"].isin(kind.runs["id"])].iterrows():
            profile = at(shapes[row["id"]], time)
            if profile is None:
                missing.append(kind.called(_words.equation("r", row["r"])))
                continue
            x, values = profile.x * units[0].factor, profile.values * units[1].factor
            ax.plot(x, values, **kind.line(looks[row["r"]]))
    return missing


def times_of(runs: Iterable[list[Profile]], most: int) -> list[float]:
    """Return up to `most` times (s) after release that were asked for and of which the runs have profiles."""
    seen = {float(f"{p.time:.6g}") for profiles in runs for p in profiles if p.asked and p.time > 0}
    times = sorted(seen)
    if len(times) <= most:
        return times
    return [times[k] for k in sorted({round(k) for k in np.linspace(0, len(times) - 1, most)})]


def together(profiles: list[Profile], tolerance: float) -> list[list[Profile]]:
    """Return the profiles in groups, each within `tolerance` (m) of the first of its group."""
    groups: list[list[Profile]] = []
    for profile in profiles:
        first = groups[-1][0] if groups else profile
        there = np.interp(first.x, profile.x, profile.values)
        same = groups and np.allclose(first.values, there, rtol=0, atol=tolerance)
        groups[-1].append(profile) if same else groups.append([profile])
    return groups


def name_of(group: list[Profile]) -> str:
    """Return the words for a group of profiles: their times."""
    unit = _words.time_unit(max(p.time for p in group))
    words = [f"{p.time * unit.factor:.4g}" for p in group if p.asked]
    text = ", ".join(words) + f" {unit.name}" if words else ""
    if group[-1].last:
        end = (
            "at rest" if group[-1].at_rest else f"end of run ({group[-1].time * unit.factor:.4g} {unit.name})"
        )
        text = f"{text} and {end}" if text else end
    return text


def start(runs: Iterable[list[Profile]], far: float) -> float:
    """Return where an axis (m) begins: 0 where every profile mirrors itself or ends at the axis, else -far."""
    mirrored = (
        np.allclose(
            np.interp(-p.x, p.x, p.values), p.values, rtol=0, atol=1e-6 * max(np.abs(p.values).max(), 1e-30)
        )
        for profiles in runs
        for p in profiles
        if p.x[0] < -2 * (p.x[1] - p.x[0])
    )
    return 0.0 if all(mirrored) else -far


def reach(profiles: list[Profile], floor: float) -> float:
    """Return the largest |x| (m) where any profile exceeds `floor`."""
    return max(
        (float(np.abs(p.x[p.values > floor]).max()) for p in profiles if (p.values > floor).any()),
        default=0.0,
    )
