"""Which column a front belongs to: best fit, posterior, profiles, and the solver's word at the best fit."""

from typing import Any, NamedTuple

import numpy as np

from subslide.emulator import descent, posterior
from subslide.emulator.observed import FREE, Model, weights_of
from subslide.naming import FINISHED
from subslide.points import Point

RISE = 3.84
"""By which -2 ln of a profile lies above its least on the edge of a 95 % interval: chi-squared of one degree."""

NARROW = 0.5
"""Share of the prior's interval below which data tell a parameter."""

CELLS = 256
"""Of the fitted grid on which the best fit is checked."""

FEW = 200
"""Effective points below which quantiles at 2.5 and 97.5 % are rough: five of them lie beyond each."""

UNITS = {"a_H": "", "r": "", "delta": " degree"}


class Parameter(NamedTuple):
    """What data say of a parameter.

    Attributes
    ----------
    best, median, low, high
        Best fit; median and 95 % interval of the posterior.
    prior
        Least and greatest value that could be.
    profile
        Values, and by how much -2 ln of the likelihood of the best other parameters lies above its least.
    verdict
        Whether the data tell it, in words.
    """

    best: float
    median: float
    low: float
    high: float
    prior: tuple[float, float]
    profile: tuple[np.ndarray, np.ndarray]
    verdict: str


class Calibration(NamedTuple):
    """What data say of a column.

    Attributes
    ----------
    model
        What they were held against.
    parameters
        By name, the free ones.
    correlation
        Of the posterior, (free, free).
    chi_square
        Sum of squared residuals of the best fit over their standard deviations.
    residuals
        Data less the best fit, over the standard deviations.
    posterior
        Its points.
    solver
        Place (m) of each front at the best fit by the solver; None if it was not asked, or its run failed.
    """

    model: Model
    parameters: dict[str, Parameter]
    correlation: np.ndarray
    chi_square: float
    residuals: np.ndarray
    posterior: posterior.Posterior
    solver: np.ndarray | None

    @property
    def point(self) -> Point:
        """The best fit."""
        values = {key: one.best for key, one in self.parameters.items()} | self.model.fixed
        return self.model.column.with_values(**values)

    def holds(self, parameters: dict[str, float]) -> bool:
        """Return whether parameters by name lie in the 95 % region: the smallest part that has this share."""
        return bool(self.model.log_likelihood(self.model.unit(parameters))[0] >= self.posterior.level)


def calibrate(model: Model, check: bool = True) -> Calibration:
    """Return what data say of a column.

    Parameters
    ----------
    model
        Data, emulator and what is known.
    check
        Whether the solver is asked at the best fit.

    Returns
    -------
    Calibration
        Best fit, posterior and profiles.
    """
    seen = posterior.sample(model)
    best, best_log = descent.best_fit(model, seen)
    values = model.parameters(seen.unit)
    at_best = dict(zip(FREE, model.parameters(best[None])[0].tolist(), strict=True))
    parameters = {}
    for k, key in enumerate(model.free):
        grid, deviance = descent.profile(model, seen, best, k)
        units = np.tile(best, (len(grid), 1))
        units[:, k] = grid
        column = FREE.index(key)
        along = model.parameters(units)[:, column]
        rise = deviance + 2 * max(best_log, -0.5 * float(deviance.min()))
        low, median, high = seen.quantiles(values[:, column], (0.025, 0.5, 0.975))
        share = float(np.diff(seen.quantiles(seen.unit[:, k], (0.025, 0.975)))[0])
        verdict = _verdict(share, rise)
        parameters[key] = Parameter(
            at_best[key], float(median), float(low), float(high), model.ends[key], (along, rise), verdict
        )
    mean = seen.weight @ seen.unit
    apart = seen.unit - mean
    covariance = apart.T @ (apart * seen.weight[:, None])
    root = np.sqrt(np.maximum(np.diag(covariance), 1e-300))
    place, deviation = model.fronts(best[None])
    residuals = (model.data.place - place[0]) / deviation[0]
    answer = Calibration(
        model,
        parameters,
        covariance / np.outer(root, root),
        float(residuals @ residuals),
        residuals,
        seen,
        None,
    )
    return answer._replace(solver=by_solver(model, answer.point)) if check else answer


def by_solver(model: Model, column: Point) -> np.ndarray | None:
    """Return where the solver has the fronts of data.

    Parameters
    ----------
    model
        What the data are held against.
    column
        The column.

    Returns
    -------
    ndarray
        Places (n) in m; None if the run failed.
    """
    from subslide.solver import solve

    run = solve(column.with_values(grid="fitted", quantities="grains", cells=CELLS))
    if run.status not in FINISHED:
        return None
    rest = np.isnan(model.data.time)
    moments = np.where(rest, run.time[-1], model.data.time)
    place = np.zeros(len(rest))
    for n, weight in weights_of(model.data.threshold).items():
        place += weight * np.interp(moments, run.time, run.x_front[n])
    return place


def _verdict(share: float, rise: np.ndarray) -> str:
    """Return whether data tell a parameter, from its 95 % interval over that of the prior and from its profile."""
    below, above = rise[0] > RISE, rise[-1] > RISE
    if below and above:
        return "told" if share < NARROW else "told, but widely"
    if below or above:
        return f"bounded {'below' if below else 'above'} alone"
    return "not told"


def told(answer: Calibration, data: str) -> dict[str, Any]:
    """Return a calibration as its file states it.

    Parameters
    ----------
    answer
        The calibration.
    data
        Path of the data.

    Returns
    -------
    dict
        Numbers and words for JSON.
    """
    model = answer.model
    return {
        "data": data,
        "threshold": model.data.threshold,
        "known": {"a_2": model.column.a_2, "radius": model.column.radius, "g": model.column.g, **model.fixed},
        "model_error": model.discrepancy,
        "emulator": model.emulator.about.get("study"),
        "chi_square": answer.chi_square,
        "data_less_parameters": len(model.data.place) - len(model.free),
        "effective_points": answer.posterior.effective,
        "parameters": {
            key: one._asdict()
            | {"profile": {"value": one.profile[0].tolist(), "rise": one.profile[1].tolist()}}
            for key, one in answer.parameters.items()
        },
        "correlation": {"of": list(model.free), "values": answer.correlation.tolist()},
        "residuals": answer.residuals.tolist(),
        "solver_x_front": None if answer.solver is None else answer.solver.tolist(),
    }


def lines(answer: Calibration) -> list[str]:
    """Return a calibration in words.

    Parameters
    ----------
    answer
        The calibration.

    Returns
    -------
    list of str
        Its lines.
    """
    model = answer.model
    text = [f"{'':<8}{'best':>10}{'median':>10}{'95 % from':>11}{'to':>10}   the data tell it?"]
    for key, one in answer.parameters.items():
        numbers = f"{one.best:>10.4g}{one.median:>10.4g}{one.low:>11.4g}{one.high:>10.4g}"
        may = f"{one.prior[0]:.3g} to {one.prior[1]:.3g}{UNITS[key]}"
        text.append(f"{key:<8}{numbers}   {one.verdict} (may be {may})")
    for i, first in enumerate(model.free):
        for j, second in enumerate(model.free[:i]):
            text.append(f"correlation of {second} and {first}: {answer.correlation[i, j]:.2f}")
    freedom = max(1, len(model.data.place) - len(model.free))
    text.append(
        f"chi-squared {answer.chi_square:.3g} of {len(model.data.place)} data and {len(model.free)} parameters"
    )
    if answer.chi_square > freedom + 4 * (2 * freedom) ** 0.5:
        text.append(
            "the model does not fit these data: they are not in m and s from the release, their errors are larger than"
            " stated, or it is wrong here"
        )
    if answer.posterior.effective < FEW:
        text.append(
            f"the posterior rests on {answer.posterior.effective:.0f} effective points: its intervals are rough"
        )
    share = 100 * model.discrepancy
    text.append(
        f"the model's own error: {share:g} % of a front's place"
        if share
        else "the model's own error is not counted"
    )
    if answer.solver is not None:
        place, deviation = model.fronts(model.unit({key: one.best for key, one in answer.parameters.items()}))
        worst = float(np.max(np.abs(answer.solver - place[0]) / deviation[0]))
        text.append(f"the solver differs from the emulator there by {worst:.2g} standard deviations at most")
    else:
        text.append("the solver was not asked, or its run failed")
    return text
