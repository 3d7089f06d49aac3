"""What the stability atlas says of each method, and of runs that fail where no caution speaks of it."""

from typing import TYPE_CHECKING

from subslide.keys import schema
from subslide.naming import FINISHED
from subslide.points import Point
from subslide.records.energy import GAINED
from subslide.study import cautions

if TYPE_CHECKING:
    import pandas as pd

    from subslide.results import Results

VARIANTS = (
    *(key for key in schema.with_role("method") if key not in ("model", "scheme", "order", "cells")),
    "friction",
)
"""Keys whose defaults the table of methods keeps to."""


def methods(table: "pd.DataFrame") -> "pd.DataFrame":
    """Return how each scheme and order did on the columns that the atlas solves by all of them.

    Parameters
    ----------
    table
        The atlas.

    Returns
    -------
    DataFrame
        A row for each scheme and order: runs, how many failed or gained energy, and errors in words.
    """
    import pandas as pd

    usual = {key: getattr(Point(), key) for key in VARIANTS}
    chosen = table[(table["scene"] == "cylinder") & (table["model"] == "radial") & (table["t_end"] == "rest")]
    for key, value in usual.items():
        chosen = chosen[chosen[key] == value]
    column = ["cells", "a_H", "a_2", "r", "delta", "boundary"]
    everywhere = chosen.groupby(column)["scheme"].transform("nunique") == chosen["scheme"].nunique()
    rows = []
    for (scheme, order), runs in chosen[everywhere].groupby(["scheme", "order"], sort=False):
        ended = runs["status"].isin(FINISHED)
        rows.append(
            {
                "method": f"{scheme.upper()}, order {order}",
                "runs": len(runs),
                "failed": int((~ended & (runs["status"] != "left_domain")).sum()),
                "gained energy": int((ended & (runs["energy_rise"] > GAINED)).sum()),
                "left the box": int((runs["status"] == "left_domain").sum()),
                "judged": int(runs["L_f_error"].notna().sum()),
                **{
                    f"{name} of {quantity}": _quantile(runs[column], share)
                    for quantity, column in (("L_f", "L_f_error"), ("max abs eta", "max_abs_eta_error"))
                    for name, share in (("median error", 0.5), ("9 in 10 within", 0.9))
                },
            }
        )
    return pd.DataFrame(rows)


def text(results: "Results") -> str:
    """Return what the atlas says: statuses, the table of methods, and failures that no caution speaks of."""
    table = results.atlas
    counts = ", ".join(f"{status}: {count}" for status, count in table["status"].value_counts().items())
    missed = unguarded(results)
    names = f": {' '.join(missed)}" if missed else ""
    return (
        f"{len(table)} runs; {counts}\n\n{methods(table).to_string(index=False)}\n\n"
        f"{len(missed)} runs failed or gained energy outside every region that `subslide check` cautions of{names}"
    )


def unguarded(results: "Results") -> list[str]:
    """Return the ids of the runs that failed or gained energy and lie in no region of the cautions."""
    points = {run.id: run.point for run in results.runs_of_study}
    table = results.atlas
    harmed = ~table["status"].isin([*FINISHED, "hyperbolicity_lost"]) | (table["energy_rise"] > GAINED)
    return [name for name in table.loc[harmed, "id"] if not cautions.regions_of(points[name])]


def _quantile(values: "pd.Series", share: float) -> str:
    """Return a quantile of the values that are known, in per cent; '' if none is."""
    values = values.dropna()
    return f"{values.quantile(share):.1%}" if len(values) else ""
