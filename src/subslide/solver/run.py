"""What a run answers."""

from dataclasses import dataclass, field

import numpy as np

from subslide.points import Point


@dataclass
class Run:
    """Result of a point's run: float64 arrays in SI units.

    Series are attributes too: `run.x_front` is `run.series["x_front"]`. What a model does not have (water of one layer,
    the diagonal of a radius) is NaN or None.

    Attributes
    ----------
    point
        The run.
    model, model_reason
        Model that was solved, and why, in words.
    dx, x
        Cell size and cell centres (cells) in m from the axis. On a fitted grid NaN, and centres (snapshots, cells).
    time
        Times (samples) of the series in s.
    series
        Series by their names in `naming.SERIES`, each (samples), but for `x_front`, the front (thresholds, samples) in
        m at each of `naming.FRONT_THRESHOLDS`, NaN while no cell beyond the axis reaches it.
    snapshot_time
        Times (snapshots) in s of the profiles (snapshots, x) and of the fields (snapshots, y, x), which are float32.
    L_f
        Length of the deposit (thresholds) in m; NaN if the run failed, or none lies on the x axis.
    status, status_detail
        How the run ended, one of `naming.STATUSES`, and what ended it, in words.
    steps, wall_seconds
        Time steps, and seconds of the time loop alone.
    time_of_arrest
        Time (thresholds) in s since which the front has been within `naming.ARREST` of L_f; NaN where L_f is 0 or NaN,
        or if grains move at the end.
    time_at_rest
        Time in s since which no grain has moved; NaN if there is none.
    box_half_width
        Half-width of the box in m.
    wave_free_until
        Time in s until which no wave can have been at the open edge of the box; NaN without one.
    width
        Widths (snapshots, cells) in m of the cells of a fitted grid, whose edges move; None on a uniform one.
    scalars
        What `records.scalars` made of the samples, by name; None before it is asked for.
    measured
        What the point asks for beside all that, by its names in `naming.MEASURED`, such as gauges (gauges, samples).
    grid, grid_reason
        Grid that was solved on, `uniform` or `fitted`, and why, in words.
    """

    point: Point
    model: str
    model_reason: str
    dx: float
    x: np.ndarray
    time: np.ndarray
    series: dict[str, np.ndarray]
    snapshot_time: np.ndarray
    h2: np.ndarray
    eta: np.ndarray
    h2_diagonal: np.ndarray | None
    h2_field: np.ndarray | None
    eta_field: np.ndarray | None
    L_f: np.ndarray
    status: str
    status_detail: str
    steps: int
    wall_seconds: float
    wave_free_until: float
    time_of_arrest: np.ndarray
    time_at_rest: float
    box_half_width: float
    width: np.ndarray | None = None
    scalars: dict[str, float] | None = None
    measured: dict[str, np.ndarray] = field(default_factory=dict)
    grid: str = "uniform"
    grid_reason: str = "asked for"

    @property
    def directions(self) -> np.ndarray:
        """Directions (degree) of `runout`, at equal angles from the x axis on: the same number for the same one."""
        return 360.0 * np.arange(self.point.runout_directions) / max(1, self.point.runout_directions)

    def all_series(self) -> dict[str, np.ndarray]:
        """Return the series by name, as attributes give them, in the time of one."""
        values = vars(self)
        return self.series | {name: values[name] for name in self.series if name in values}

    def copied(self) -> "Run":
        """Return a run with the same values, in less time than `copy` takes."""
        other: Run = object.__new__(Run)
        vars(other).update(vars(self))
        return other

    def __getattr__(self, name: str) -> np.ndarray:
        """Return the series of that name."""
        series = self.__dict__.get("series", {})
        if name not in series:
            raise AttributeError(f"a run has no {name}")
        return series[name]
