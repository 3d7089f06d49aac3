"""What the stability atlas says of each method, as text and as the table of a page of documentation."""

from pathlib import Path

import pandas as pd

from subslide.pages import renewal as marks
from subslide.pages.verification import END, START
from subslide.points import RUN_KEYS, Point, from_dict
from subslide.results import Results
from subslide.study import cautions as guard
from subslide.tables import atlas


def methods(table: pd.DataFrame) -> pd.DataFrame:
    """Table of how each scheme and order did on the columns that the atlas solves by all of them: runs, how many failed
    or gained energy, and errors."""
    usual = {key: getattr(Point(), key) for key in atlas.VARIANTS}
    chosen = table[(table["scene"] == "cylinder") & (table["model"] == "radial") & (table["t_end"] == "rest")]
    for key, value in usual.items():
        chosen = chosen[chosen[key] == value]
    column = ["cells", "a_H", "a_2", "r", "delta", "boundary"]
    everywhere = chosen.groupby(column)["scheme"].transform("nunique") == chosen["scheme"].nunique()
    rows = []
    for (scheme, order), runs in chosen[everywhere].groupby(["scheme", "order"], sort=False):
        ended = runs["status"].isin(atlas.FINISHED)
        rows.append(
            {
                "method": f"{scheme.upper()}, order {order}",
                "runs": len(runs),
                "failed": int((~ended & (runs["status"] != "left_domain")).sum()),
                "gained energy": int((ended & (runs["energy_rise"] > atlas.GAINED)).sum()),
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


def report(folder: Path) -> str:
    """Text on a study with an atlas: how many runs ended in each status, the table of methods, and the runs that failed
    or gained energy although `guard` has no caution for them."""
    table = atlas.read(folder)
    counts = ", ".join(f"{status}: {count}" for status, count in table["status"].value_counts().items())
    missed = unguarded(Results(folder), table)
    names = f": {' '.join(missed)}" if missed else ""
    return (
        f"{len(table)} runs; {counts}\n\n{methods(table).to_string(index=False)}\n\n"
        f"{len(missed)} runs failed or gained energy outside every region that guard.py cautions of{names}"
    )


def unguarded(results: Results, table: pd.DataFrame) -> list[str]:
    """Ids of the runs that failed or gained energy and lie in no region of `guard`."""
    points = {row["id"]: from_dict({key: row[key] for key in RUN_KEYS}) for row in results.points}
    harmed = ~table["status"].isin([*atlas.FINISHED, "hyperbolicity_lost"]) | (
        table["energy_rise"] > atlas.GAINED
    )
    return [name for name in table.loc[harmed, "id"] if not guard.regions_of(points[name])]


def page(text: str, folder: Path) -> str:
    """The page `text` with the table of methods of a study between its two marks; ConfigError without these."""
    found = methods(atlas.read(folder))
    return marks.renewed(text, START, END, [list(found.columns), *found.astype(str).to_numpy().tolist()])


def _quantile(values: pd.Series, share: float) -> str:
    """Quantile of the values that are known, in per cent; '' if none is."""
    values = values.dropna()
    return f"{values.quantile(share):.1%}" if len(values) else ""
