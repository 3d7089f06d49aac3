"""What a batch of long runs keeps while it is solved, so that one that is killed goes on from there.

Every few minutes the state of the run at hand, and the runs that have ended since, go into files of numpy's `npz`: each
is whole or not there, and one that is damaged or of other sources counts as none. What has gone on from a state has the
bits of what was never stopped, but for the seconds that it took.
"""

import contextlib
import dataclasses
import itertools
import json
import time
from collections.abc import Collection
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from subslide import source_hash
from subslide.files import replacing
from subslide.points import Point
from subslide.solver.run import Run
from subslide.solver.snapshots import Snapshot
from subslide.study.staging import ABOUT

EVERY = 300.0
"""Seconds from one saving to the next: a run that takes less is never saved."""


class Saved(NamedTuple):
    """State of a run under way.

    Attributes
    ----------
    box
        Cells from the axis to the end of the box that it is in.
    model
        What the model goes on from, by name.
    clock
        Scaled times, see `kernels.clock`.
    samples
        Samples (samples, columns) so far.
    snapshots
        Snapshots so far.
    wall
        Seconds that the loop has taken.
    """

    box: int
    model: dict[str, np.ndarray]
    clock: np.ndarray
    samples: np.ndarray
    snapshots: list[Snapshot]
    wall: float


class Keeper:
    """Files of one batch in a folder: those of its runs under way, by id, and of those that ended, many in one.

    A plan that is made anew may have a point in another batch, so those that ended are looked for in all such files.

    Parameters
    ----------
    folder
        Where they are; made when the first is written.
    batch
        Name of the batch.
    points
        Its points.
    keep
        What is kept of a run that has ended: of another form, it counts as none.
    """

    def __init__(self, folder: Path, batch: str, points: list[Point], keep: str = "all"):
        """Read the runs that ended."""
        self.folder, self.batch = folder, batch
        self.mark = f"{source_hash()} {keep}"
        self.by_id = {point.id: point for point in points}
        self.ended: dict[str, Run] = {}
        self._unsaved: list[Run] = []
        self._last = time.monotonic()
        self._again = folder.is_dir()
        self._groups: list[Path] = []  # with no runs but this batch's
        for path in sorted(folder.glob("batch-*.npz")):
            self.ended |= self._runs(path)

    @property
    def due(self) -> bool:
        """Whether it is time to save."""
        return time.monotonic() - self._last >= EVERY

    def take(self, point: Point) -> Run | None:
        """Return the run of a point if it ended before the batch was killed."""
        return self.ended.pop(point.id, None)

    def add(self, run: Run) -> None:
        """Hold a run that has ended now, which the next saving keeps."""
        self._unsaved.append(run)
        if self.due:
            self.save()

    def under_way(self, point: Point) -> Saved | None:
        """Return the state of a point's run that was under way when the batch was killed, if it is whole."""
        if not self._again:
            return None
        about, arrays = self._read(self._state(point.id))
        try:
            if not about or about["id"] != point.id:
                return None
            return Saved(
                box=about["box"],
                model=_of("model", arrays),
                clock=arrays["clock"],
                samples=arrays["samples"],
                snapshots=[
                    Snapshot(
                        snapshot_time,
                        arrays[f"{n}/x"],
                        arrays.get(f"{n}/width"),
                        _of(f"{n}/profile", arrays),
                        _of(f"{n}/fields", arrays) or None,
                    )
                    for n, snapshot_time in enumerate(about["times"])
                ],
                wall=about["wall"],
            )
        except (KeyError, TypeError):
            return None

    def save(self, point: Point | None = None, saved: Saved | None = None) -> None:
        """Write the runs that have ended, and the state of the one under way; say so where a disk refuses it.

        Parameters
        ----------
        point, saved
            The run under way, and its state.
        """
        try:
            self.folder.mkdir(exist_ok=True)
            if self._unsaved:
                self._write_runs()
            if point and saved:
                self._write_state(point, saved)
        except OSError as error:
            print(f"subslide: the state of a long run cannot be kept: {error}", flush=True)
        self._last = time.monotonic()

    def forget(self) -> None:
        """Remove the files of the batch, whose record is whole."""
        for path in (*self._groups, *map(self._state, self.by_id)):
            path.unlink(missing_ok=True)
        with contextlib.suppress(OSError):
            self.folder.rmdir()

    def _state(self, id_: str) -> Path:
        """Return the path of the state of a run under way."""
        return self.folder / f"{id_}.npz"

    def _write_state(self, point: Point, saved: Saved) -> None:
        """Write the state of a run under way."""
        arrays = {f"model/{name}": values for name, values in saved.model.items()}
        for n, snapshot in enumerate(saved.snapshots):
            arrays[f"{n}/x"] = snapshot.x
            if snapshot.width is not None:
                arrays[f"{n}/width"] = snapshot.width
            for part in ("profile", "fields"):
                arrays |= {f"{n}/{part}/{k}": values for k, values in (getattr(snapshot, part) or {}).items()}
        about = {
            "id": point.id,
            "box": saved.box,
            "times": [snapshot.time for snapshot in saved.snapshots],
            "wall": saved.wall,
        }
        self._write(self._state(point.id), about, arrays | {"clock": saved.clock, "samples": saved.samples})

    def _write_runs(self) -> None:
        """Write the runs that have ended since the last saving; their states are needed no more."""
        about: dict[str, dict[str, Any]] = {}
        arrays: dict[str, np.ndarray] = {}
        for run in self._unsaved:
            plain = about[run.point.id] = {}
            for field in dataclasses.fields(run):
                value = getattr(run, field.name)
                if isinstance(value, dict) and not any(isinstance(v, np.ndarray) for v in value.values()):
                    plain[field.name] = {k: float(v) for k, v in value.items()}
                elif isinstance(value, dict):
                    arrays |= {f"{run.point.id}/{field.name}/{k}": values for k, values in value.items()}
                elif isinstance(value, np.ndarray):
                    arrays[f"{run.point.id}/{field.name}"] = value
                elif not isinstance(value, Point):
                    plain[field.name] = value.item() if isinstance(value, np.generic) else value
        names = (self.folder / f"batch-{self.batch}-{number:04d}.npz" for number in itertools.count())
        path = next(name for name in names if not name.exists())
        self._write(path, {"runs": about}, arrays)
        self._groups.append(path)
        for run in self._unsaved:
            self._state(run.point.id).unlink(missing_ok=True)
        self._unsaved = []

    def _runs(self, path: Path) -> dict[str, Run]:
        """Return the runs of a file, by id, of the batch's points."""
        about, arrays = self._read(path, self.by_id.keys())
        runs = {}
        if about and self.by_id.keys() >= about["runs"].keys():
            self._groups.append(path)
        for id_, plain in about.get("runs", {}).items():
            if id_ not in self.by_id:
                continue
            values: dict[str, Any] = dict(plain)
            for name, array in _of(id_, arrays).items():
                field, _, key = name.partition("/")
                if key:
                    values.setdefault(field, {})[key] = array
                else:
                    values[field] = array
            with contextlib.suppress(KeyError, TypeError):
                runs[id_] = Run(point=self.by_id[id_], **values)
        return runs

    def _write(self, path: Path, about: dict, arrays: dict[str, np.ndarray]) -> None:
        """Write arrays, and what is no array, whole or not at all."""
        text = json.dumps({"mark": self.mark, **about}).encode()
        named: dict[str, Any] = {**arrays, ABOUT: np.frombuffer(text, np.uint8)}
        with replacing(path) as temporary, open(temporary, "wb") as file:
            np.savez(file, **named)

    def _read(self, path: Path, among: Collection[str] = ()) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
        """Return what is no array in a file, and its arrays; nothing if it is not whole, or of other sources.

        Nothing either of one that has runs by id, and none among those given.
        """
        try:
            with np.load(path, allow_pickle=False) as file:
                about = json.loads(file[ABOUT].tobytes())
                if about["mark"] != self.mark or (among and not set(among) & about["runs"].keys()):
                    return {}, {}
                return about, {name: file[name] for name in file.files if name != ABOUT}
        except Exception:  # a damaged file has numpy and zipfile raise whatever they come to
            return {}, {}


def _of(part: str, arrays: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Return the arrays of a part, by their names in it."""
    return {
        name.removeprefix(f"{part}/"): array for name, array in arrays.items() if name.startswith(f"{part}/")
    }
