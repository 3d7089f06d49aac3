"""Profiles along the x axis at given times, as figures draw them."""

from typing import NamedTuple

import numpy as np

from subslide.figures import _slices, _words


class Profile(NamedTuple):
    """One profile: time (s), position and value (m), if it is the last, if grains are at rest."""

    time: float
    x: np.ndarray
    values: np.ndarray
    last: bool
    at_rest: bool


def profiles(record, name):
    """Return the finite profiles of a record's variable, earliest first; from half a cell before the axis.

    The last profile of a failed run, at no time that other runs have, is left out.
    """
    x = record["x"].to_numpy()
    times = np.atleast_1d(record["snapshot_time"].to_numpy())
    rest = float(record["time_at_rest"])
    finished = str(record["status"].item()) in _slices.FINISHED
    found = []
    for k, time in enumerate(times):
        values = record[name].isel(snapshot=k).to_numpy()
        seen = np.isfinite(values)
        if not np.isfinite(time) or not seen.any():
            continue
        xs, values = x[seen], values[seen]
        if xs[0] > 0:
            xs, values = np.concatenate([-xs[:1], xs]), np.concatenate([values[:1], values])
        last = k == len(times) - 1
        if last and not finished:
            continue
        found.append(Profile(float(time), xs, values, last, last and rest <= time))
    return found


def at(found, time):
    """Return the profile at `time` (s), at the end of a finished run if None; None where there is none."""
    if time is None:
        return next((p for p in found if p.last), None)
    return next((p for p in found if abs(p.time - time) <= 1e-3 * max(time, 1e-12)), None)


def times_of(records, most):
    """Return up to `most` times (s) after release at which the records have profiles, the end left out."""
    seen = {float(f"{p.time:.6g}") for found in records for p in found if not p.last and p.time > 0}
    times = sorted(seen)
    if len(times) <= most:
        return times
    return [times[k] for k in sorted({round(k) for k in np.linspace(0, len(times) - 1, most)})]


def together(found, tolerance):
    """Return the profiles in groups, each within `tolerance` (m) of the first of its group."""
    groups = []
    for profile in found:
        same = groups and np.allclose(groups[-1][0].values, profile.values, rtol=0, atol=tolerance)
        groups[-1].append(profile) if same else groups.append([profile])
    return groups


def name_of(group):
    """Return the words for a group of profiles: their times."""
    unit = _words.time_unit(max(p.time for p in group))
    words = [f"{p.time * unit.factor:.4g}" for p in group if not p.last]
    text = ", ".join(words) + f" {unit.name}" if words else ""
    if group[-1].last:
        end = (
            "at rest" if group[-1].at_rest else f"end of run ({group[-1].time * unit.factor:.4g} {unit.name})"
        )
        text = f"{text} and {end}" if text else end
    return text


def start(shapes, far):
    """Return where an axis begins: 0 where every profile mirrors itself or ends at the axis, else -far."""
    mirrored = (
        np.allclose(
            np.interp(-p.x, p.x, p.values), p.values, rtol=0, atol=1e-6 * max(np.abs(p.values).max(), 1e-30)
        )
        for found in shapes
        for p in found
        if p.x[0] < -2 * (p.x[1] - p.x[0])
    )
    return 0.0 if all(mirrored) else -far


def reach(found, floor):
    """Return the largest |x| (m) where any profile exceeds `floor`."""
    return max(
        (float(np.abs(p.x[p.values > floor]).max()) for p in found if (p.values > floor).any()), default=0.0
    )
