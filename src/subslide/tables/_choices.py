"""The tables of numerics in words: cheapest choices, and the paper's method against the default at equal error."""

import math
from typing import TYPE_CHECKING

from subslide.tables import work_precision as runs_of
from subslide.tables._aligned import aligned
from subslide.tables._problems import DEFAULT, METHOD

if TYPE_CHECKING:
    import pandas as pd

HEADINGS = {
    "L_f": "L_f",
    "x_front": "x_front(t)",
    "max_abs_eta": "max\\|eta\\|(t)",
    "max_abs_eta_outside": "the same beyond R",
}
UNUSUAL = {
    "front_flux": "{} flux at fronts",
    "wave_speeds": "{} wave speeds",
    "order": "order {}",
    "grid": "{} grid",
    "cfl": "CFL {:g}",
    "treatment": "{} where hyperbolicity is lost",
    "as_printed": "{} as printed",
    "friction_in_viscosity": "friction not in the viscosity",
}
"""Words on values that are not the default."""
SOLVERS = {"rusanov": "Rusanov", "roe": "Roe"}
"""Names of solvers that are no abbreviations."""


def text(runs: "pd.DataFrame", chosen: "pd.DataFrame") -> str:
    """Return the tables of cheapest choices and of equal accuracy as aligned text.

    Parameters
    ----------
    runs, chosen
        The tables `work_precision` and `cheapest`.
    """
    return "\n\n".join(aligned(rows) for rows in (choices(chosen), equal(runs)))


def choices(chosen: "pd.DataFrame") -> list[tuple[str, ...]]:
    """Return rows, headings first: the cheapest run for each target and column, an entry for each quantity.

    chosen: table of `cheapest`. The last entry is what the paper's method takes beside the default numerics.
    """
    head = ("error at most", "a_H", *HEADINGS.values(), "paper's method in the plane, L_f")
    rows = []
    for (target, *place), group in chosen.groupby(["target", *runs_of.PLACE], sort=False):
        kinds = {name: some.set_index("quantity") for name, some in group.groupby("numerics")}
        entries = [choice(*(kinds[kind].loc[name] for kind in ("any", "default"))) for name in HEADINGS]
        beside = paper(kinds["default"].loc["L_f"])
        rows.append((place, -target, (f"{100 * target:g} %", f"{place[0]:g}", *entries, beside)))
    return [head, *(words for *_, words in sorted(rows))]


def choice(best: "pd.Series", default: "pd.Series") -> str:
    """Return words on the cheapest run of all, and on the cheapest by the default numerics where that is another.

    best, default: rows of the table of cheapest choices.
    """
    if not isinstance(best["id"], str):
        return "none known"
    words = ", ".join([*unusual(best), *_cost(best)])
    if best["id"] == default["id"]:
        return words
    return (
        f"{words} (default: {', '.join(_cost(default)) if isinstance(default['id'], str) else 'none known'})"
    )


def _cost(row: "pd.Series") -> tuple[str, str]:
    """Return cells and time of a row, in words."""
    return f"{row['cells']:.0f} cells", seconds(row["seconds"])


def unusual(row: "pd.Series") -> list[str]:
    """Return words on the numerics of a row that are not the default."""
    usual = dict(zip(METHOD, DEFAULT, strict=True))
    words = []
    for key, value in usual.items():
        if row[key] != value:
            name = SOLVERS.get(row[key], row[key].upper()) if key == "scheme" else row[key]
            words.append(UNUSUAL.get(key, "{}").format(int(name) if key == "order" else name))
    return words


def paper(row: "pd.Series") -> str:
    """Return what the paper's method takes for the same error, and how many times as long that is."""
    if not isinstance(row["id"], str) or math.isnan(row["paper_cells"]):
        return ""
    reached = bool(row["paper_reaches"])
    factor = f"{'' if reached else 'over '}{rounded(row['factor'])} times as long"
    where = f"{row['paper_cells']:.0f} cells, {seconds(row['paper_seconds'])}"
    return f"{where}: {factor}" if reached else f"not with {where}: {factor}"


def equal(runs: "pd.DataFrame") -> list[tuple[str, ...]]:
    """Return rows, headings first: runs of the paper's method that reach their error in L_f, beside the default."""
    rows: list[tuple[str, ...]] = [
        ("a_H", "paper's method: cells", "time", "error in L_f", "default: cells", "time", "error", "factor")
    ]
    for _, row in runs_of.reached(runs[runs["quantity"] == "L_f"]).iterrows():
        same = runs[(runs["method"] == "default") & (runs["quantity"] == row["quantity"])]
        same = same[(same[list(runs_of.PLACE)] == row[list(runs_of.PLACE)]).all(axis=1)]
        best = runs_of.cheapest(same.to_dict("records"), row["sure_error"])
        beside = (
            (
                f"{best['cells']:.0f}",
                seconds(best["seconds"]),
                percent(best["sure_error"]),
                rounded(row["factor"]),
            )
            if best
            else ("none",) * 4
        )
        about = (
            f"{row['a_H']:g}",
            f"{row['cells']:.0f}",
            seconds(row["seconds"]),
            percent(row["sure_error"]),
        )
        rows.append((*about, *beside))
    return rows


def seconds(value: float) -> str:
    """Return a time (s) to two digits, in ms below a second."""
    number, unit = (1e3 * value, "ms") if value < 0.995 else (value, "s")
    number = float(f"{number:.2g}")
    return f"{number:.0f} {unit}" if number >= 10 else f"{number:.2g} {unit}"


def percent(value: float) -> str:
    """Return a share in per cent, to two digits."""
    return f"{100 * value:.2g} %" if value < 0.1 else f"{100 * value:.0f} %"


def rounded(value: float) -> str:
    """Return a factor to two digits, rounded down."""
    step = 10 ** max(math.floor(math.log10(value)) - 1, 0)
    return f"{math.floor(value / step) * step:,}"
