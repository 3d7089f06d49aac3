"""Profiles and fields that a run leaves on its way."""

from typing import NamedTuple

import numpy as np

from subslide.models.model import Model


class Snapshot(NamedTuple):
    """Time (s) of a snapshot, and scaled centres along x, profiles there and, where they are kept, fields, by name.

    Where cells move, their widths too, else None.
    """

    time: float
    x: np.ndarray
    width: np.ndarray | None
    profile: dict[str, np.ndarray]
    fields: dict[str, np.ndarray] | None


def taken(time: float, model: Model, profiles: bool, fields: bool) -> Snapshot:
    """Return the snapshot of a model as it is.

    Parameters
    ----------
    time
        Time (s) that it has reached.
    model
        What is run.
    profiles, fields
        Whether profiles are kept, and fields with them.

    Returns
    -------
    Snapshot
        Copies of its profiles and fields.
    """
    if not profiles:
        return Snapshot(time, np.empty(0), None, {name: np.empty(0) for name in ("h2", "eta")}, None)
    return Snapshot(time, model.x, model.width, model.profile(), model.fields() if fields else None)


def shared(model: Model, snapshots: list[Snapshot]) -> tuple[np.ndarray, list[dict[str, np.ndarray]]]:
    """Return centres along x, and the profiles there, of the box and beyond it as far as any grains went.

    Parameters
    ----------
    model
        What was run, in its last state.
    snapshots
        Snapshots, of which those of an open sea may have fewer cells than the last.

    Returns
    -------
    tuple of ndarray and list
        Scaled centres (nx), or of each snapshot (snapshots, nx) where cells move, and the profiles by name, each (nx),
        of each snapshot.
    """
    if model.width is not None or not snapshots[0].x.size:
        return np.stack([snapshot.x for snapshot in snapshots]), [one.profile for one in snapshots]
    x = model.x
    kept = np.abs(x) < model.half_width
    profiles = []
    for snapshot in snapshots:
        before = int(np.searchsorted(x, snapshot.x[0]))
        ends = before, len(x) - before - len(snapshot.x)
        profile = snapshot.profile
        if any(ends):
            profile = {name: np.pad(values, ends, mode="edge") for name, values in profile.items()}
        profiles.append(profile)
        kept |= profiles[-1]["h2"] > model.settings.dry_depth
    first, last = np.flatnonzero(kept)[[0, -1]]
    part = slice(first, last + 1)
    return x[part], [{name: values[part] for name, values in profile.items()} for profile in profiles]


def in_metres(values: list[dict[str, np.ndarray]], name: str, height: float) -> np.ndarray:
    """Return one of the profiles or fields of each snapshot in m.

    Parameters
    ----------
    values
        Scaled profiles or fields, by name, of each snapshot.
    name
        The wanted one.
    height
        Column height (m).

    Returns
    -------
    ndarray
        Values (snapshots, ...).
    """
    return np.stack([of_snapshot[name] for of_snapshot in values]) * height
