"""Runs made up without a solver, so that files and tables are tested apart from numerics."""

import json
import signal
from pathlib import Path

import numpy as np
import pytest

from subslide import naming
from subslide.checksums import seal
from subslide.files import write_text
from subslide.jobs import keep_batch
from subslide.points import Point
from subslide.results import Results
from subslide.solver.run import Run
from subslide.study import plan
from subslide.tables import _write


def made_up_run(point: Point, steps: int = 20, grown: int = 0, **changes) -> Run:
    """Result as `solver.solve` returns it, of simple formulas: the front goes from R to 2 R in a second."""
    cells = round(4.2553 * point.radius / point.dx) + grown
    plane = point.model == "plane"
    x = (np.arange(-cells if plane else 0, cells) + 0.5) * point.dx
    height = point.a_2 * point.radius
    time = np.linspace(0, 1, steps + 1)
    front = np.outer([1.2, 1.1, 1.0], point.radius * (1 + time))
    snapshots = np.array([0, 0.5, 1.0])
    series = {name: np.zeros(steps + 1) for name in naming.SERIES} | {
        "x_front": front,
        "max_abs_eta": height * np.sin(np.pi * time),
        "max_abs_eta_outside": height * np.sin(np.pi * time) / 2,
        "eta_gauge": -height * np.sin(np.pi * time) / 3,
        "sediment_volume": np.full(steps + 1, 2.0),
        "water_volume": np.full(steps + 1, 3.0),
        "energy": 3 - time,
        "hyperbolic_margin": np.ones(steps + 1),
    }
    values = dict.fromkeys(naming.SCALARS, 0.0) | dict(
        point=point,
        model="radial" if point.model == "auto" else point.model,
        model_reason="made up",
        grid="uniform",
        grid_reason="made up",
        dx=point.dx,
        x=x,
        width=None,
        time=time,
        snapshot_time=snapshots,
        h2=np.tile(height * np.exp(-(x**2)), (3, 1)),
        eta=np.zeros((3, len(x))),
        h2_diagonal=np.zeros((3, len(x))) if plane else None,
        h2_field=np.ones((3, len(x), len(x)), np.float32) if point.fields else None,
        eta_field=np.zeros((3, len(x), len(x)), np.float32) if point.fields else None,
        L_f=front[:, -1],
        time_of_arrest=np.full(3, 0.99),
        status="ok",
        status_detail="at rest",
        steps=steps,
        wall_seconds=0.5,
        time_at_rest=1.0,
        box_half_width=cells * point.dx,
    )
    series |= {name: changes.pop(name) for name in naming.SERIES if name in changes}
    return Run(series=series, **values | changes)


@pytest.fixture(scope="session")
def make_run():
    """Function that makes up the result of a point."""
    return made_up_run


@pytest.fixture(scope="session")
def solve_study():
    """Function that leaves a study in a folder as its jobs would; `solve(points)` gives the runs of a batch."""

    def finish(study, folder, solve):
        planned = plan.plan(study, folder)
        for name in ("records", "batches"):
            (folder / name).mkdir(parents=True, exist_ok=True)
        for name, batch in planned.batches.items():
            if batch.text:
                keep_batch(
                    solve(list(batch.points)),
                    str(plan.record_path(folder, name)),
                    str(folder / "batches" / f"{name}.json"),
                    study.keep,
                    json.loads(batch.text)["first_run"],
                )
        write_text(folder / "points.json", planned.points_text)
        seal(folder / "points.json")

    return finish


@pytest.fixture
def write_tables():
    """Function that writes tables of the study in a folder, all that every study has unless named, and reads it."""

    def write(folder, *names):
        of_bands = ("bands",) if Results(folder).has_bands else ()
        for name in names or (*of_bands, "runs", "timing", "series"):
            _write.write(name, Results(folder))
        return Results(folder)

    return write


@pytest.fixture
def write_yaml(tmp_path):
    """Function that writes text to a configuration and returns its path."""

    def write(text: str, name: str = "study.yaml"):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return write


@pytest.fixture
def signals_of_a_terminal():
    """No signal that a test's commands start by ignoring, though the suite itself may (`nohup`, or `&` in a script)."""
    numbers = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
    ignored = [number for number in numbers if signal.getsignal(number) == signal.SIG_IGN]
    for number in ignored:
        signal.signal(number, signal.SIG_DFL)
    yield
    for number in ignored:
        signal.signal(number, signal.SIG_IGN)


@pytest.fixture(scope="session")
def root() -> Path:
    """Folder of the repository."""
    return Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def trained():
    """What 64 columns taught an emulator."""
    from learned import columns, measured

    from subslide.emulator import training

    return training.learn(measured(columns(64)), {"study": "formulas"})


@pytest.fixture
def saved(trained, tmp_path):
    """File of an emulator of 64 columns."""
    trained.emulator.save(tmp_path / "emulator.json")
    return tmp_path / "emulator.json"
