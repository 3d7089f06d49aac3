"""Profiles and fields that a run leaves on its way."""

from typing import Any, NamedTuple

import numpy as np

from subslide.models.model import Model
from subslide.points import Point

NONE = np.empty(0)
"""Places of cells whose profiles are not kept."""

WHERE_THERE_ARE = ("h2_diagonal", "h2_field", "eta_field", "width")
"""Attributes of a run that only some have."""


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
        return Snapshot(time, NONE, None, {}, None)
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
    if model.width is not None:
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


def profiles_in_si(point: Point, model: Model, snapshots: list[Snapshot]) -> dict[str, Any]:
    """Return the places and profiles of a run in SI units.

    Parameters
    ----------
    point
        The run.
    model
        What was run, in its last state.
    snapshots
        Its snapshots.

    Returns
    -------
    dict
        Attributes of a `Run` by name; without cells where no profiles are kept.
    """
    if not snapshots[0].profile:
        nothing = np.empty((len(snapshots), 0))
        return {"x": NONE, "h2": nothing, "eta": nothing, **dict.fromkeys(WHERE_THERE_ARE)}
    height = point.column_height
    x, profiles = shared(model, snapshots)
    whole = [snapshot.fields for snapshot in snapshots if snapshot.fields]
    widths = [snapshot.width for snapshot in snapshots if snapshot.width is not None]
    alone = model.settings.layers == 1
    return {
        "x": x * point.radius,
        "h2": in_metres(profiles, "h2", height),
        "eta": np.full((len(profiles), x.shape[-1]), np.nan) if alone else in_metres(profiles, "eta", height),
        "h2_diagonal": in_metres(profiles, "h2_diagonal", height) if "h2_diagonal" in profiles[0] else None,
        "h2_field": in_metres(whole, "h2", height).astype(np.float32) if whole else None,
        "eta_field": in_metres(whole, "eta", height).astype(np.float32) if whole else None,
        "width": np.stack(widths) * point.radius if widths else None,
    }


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
