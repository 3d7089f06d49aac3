"""What a run is asked for beside its samples and snapshots: it is looked at after every step, or at its end."""

import numpy as np

from subslide.models.model import Model
from subslide.points import Point
from subslide.solver import runout
from subslide.solver.footprints import Footprints
from subslide.solver.gauges import Gauges
from subslide.solver.run import Run


class Watchers:
    """Gauges and footprints of a run, which see its state after every step; without them nothing is looked at.

    Parameters
    ----------
    point
        The run.
    model
        What is run, in its first state.
    profiles
        Whether profiles are kept, and footprints with them.
    """

    def __init__(self, point: Point, model: Model, profiles: bool) -> None:
        """Make those that the point asks for."""
        self.gauges = Gauges(point) if point.gauges else None
        self.footprints = Footprints(model) if point.footprints and profiles else None
        self.present = tuple(one for one in (self.gauges, self.footprints) if one is not None)

    def observe(self, model: Model, sample: int, now: float) -> None:
        """Give all of them the state of a model.

        Parameters
        ----------
        model
            What is run.
        sample
            Number of the sample that was taken of that state; it may be shown again.
        now
            Scaled time.
        """
        for one in self.present:
            one.observe(model, sample, now)

    def state(self) -> dict[str, np.ndarray]:
        """Return what `resume` takes, by name."""
        return {name: values for one in self.present for name, values in one.state().items()}

    def resume(self, state: dict[str, np.ndarray]) -> None:
        """Put a state back.

        Parameters
        ----------
        state
            What `state` returned, and what other things go on from.
        """
        for one in self.present:
            one.resume(state)

    def measured(self, run: Run, model: Model) -> dict[str, np.ndarray]:
        """Return all that a run is asked for beside samples and snapshots, at its end.

        Parameters
        ----------
        run
            The run, but for this.
        model
            What was run, in its last state.

        Returns
        -------
        dict
            Values in SI units by the names of `naming.MEASURED`.
        """
        values = self.gauges.series(run.point) if self.gauges else {}
        if self.footprints:
            values |= self.footprints.fields(run.point, run.x)
        if run.point.runout_directions:
            values |= runout.measured(run, model)
        return values
