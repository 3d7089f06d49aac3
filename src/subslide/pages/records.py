"""The page on records, docs/records.md: statuses, and every variable with its dimensions and unit."""

from subslide import naming
from subslide.pages._rows import row
from subslide.records import scalars, thinning

PATH = "docs/records.md"
INTRODUCTION = """# Records

<!-- written by `make docs` from src/subslide/naming.py -->

`subslide run` writes one run, a study one file for each batch of runs, in one layout (NetCDF-4, CF-1.11): every
variable of a run has the dimension `run`, of length 1 for a single run. Runs that are shorter, or lie in a smaller box,
than others of their batch end in NaN. [opening.md](opening.md) says how to open the records of a study as one dataset;
`results/<study>/points.json` which batch holds which `id`:

```python
from subslide.results import Results

Results("results/paper").record("p0123456789ab")  # one run by its id, as an xarray dataset without padding
```

Lengths are in m from the axis of the scene, times in s from its release. Front and deposit are measured along the x
axis. In scenes on a line volumes and energy are per metre of width. With `boundary: open` a radius or line is a sea
without an edge: it is lengthened before a wave comes to its end, with the bits of one that was long from the start.
Of it `box_half_width`, volumes, energy and profiles are those of the paper's box, with what has gone beyond it:
volumes and energy count it less still water, and profiles reach as far as any grains went.

`grid` says what a run was solved on. Cells of a `fitted` grid differ in size and move with the grains: `dx` is missing,
and so is the wave (`max_abs_eta`, `max_abs_eta_outside`, `eta_gauge`, `eta`), which the coarse cells far away reflect.
A file whose runs do not all lie on one uniform grid has the dimension `cell` in place of `x`, and each run its own
positions `x(run, snapshot, cell)` and widths `cell_width(run, snapshot, cell)`, so that a volume on a radius is the sum
of 2 pi x cell_width h2; of a slab a fitted grid has the right half, so that it is twice the sum of cell_width h2.
Fronts are sampled at each step, volumes, energy and hyperbolicity at every eighth and at the end, and are missing
between. `Results.record` gives a fitted run `x(snapshot, cell)` and `cell_width`, a uniform one `x(x)`
whatever else is in its file; `subslide.results.positions(record, snapshot)` the positions of either.

What a run is asked for by keys of its own is there where a run of the file has it, and missing of the others. A gauge
is linear between centres of cells, in the plane between four: along x it sees what the profiles show, elsewhere what
fields do. On a radius it stands at its distance from the axis, and velocities are parts of the radial one; a quarter is
mirrored. Between snapshots friction of grains is half a step ahead of the sample (it is even at each snapshot). Runout
is taken along rays from the axis, with a point between cells as the front has it, so that along x it is `L_f` (unless
no grain ever moved: then `L_f` is the scene's own edge). Its points are the outline of a deposit that each ray leaves
once, and `deposit_area` is that of any deposit:

```python
angle = np.deg2rad(record["direction"])
outline = record["runout"][0] * np.cos(angle), record["runout"][0] * np.sin(angle)  # 1 % of H2
```

Footprints are of the run's steps, the start among them: in a cell whose `arrival_h2` is missing h2 never was 1 % of H2.
`keep: series` keeps gauges and runout, `summary` runout alone. Where a run is so long that its series are thinned,
gauges have the same samples.

The attribute `keep` says what a record holds beside the numbers of each run, which follow from all of its samples in
any case. `all`: series and profiles. `series`: no profiles. `summary`: of {summary} the samples between which
straight lines pass those of every step within {share:g} of the range of the series (or {least:g} of its largest size),
with each local extreme that stands out by more, in single precision. There a value is missing where another series
alone has a sample, and infinite where the run has none; `subslide.results` gives them filled in, as those of other
records. `config` of a summary states the values that all its runs share.

Texts are tables of characters (CF 2.2). Each key of a study is a coordinate along `run`, as is each option of the
runs' scenes, such as `elongation` ([config/README.md](../config/README.md)); attributes hold the configuration,
versions and a checksum that readers verify. `status` is one of:

"""


def text() -> str:
    """Return the page."""
    series = ", ".join(f"`{name}`" for name in thinning.SUMMARY)
    words = {"{summary}": series, "{share:g}": f"{thinning.SHARE:g}", "{least:g}": f"{thinning.LEAST:g}"}
    introduction = INTRODUCTION
    for mark, word in words.items():
        introduction = introduction.replace(mark, word)
    return introduction + variables()


def variables() -> str:
    """Return tables (Markdown) of the statuses and the variables of a record."""
    lines = [f"- `{name}`: {text}" for name, text in naming.STATUSES.items()]
    parts = {
        "Series, a sample each time step": naming.SERIES,
        "Profiles along the x axis, at each snapshot": naming.PROFILES,
        "Fields, at each snapshot (`fields: true`, in the plane)": naming.FIELDS_2D,
        "At gauges, a sample each time step (`gauges`)": naming.GAUGES,
        "Footprints: of each cell over all steps (`footprints: true`)": naming.FOOTPRINTS,
        "Runout by direction, at the end of the run (`runout_directions`)": naming.RUNOUT,
        "A value a run": naming.SCALARS | scalars.NAMES,
        "Coordinates": naming.COORDINATES,
    }
    for title, table in parts.items():
        lines += ["", f"## {title}", "", "| name | dimensions | unit | meaning |", "|---|---|---|---|"]
        lines += [
            row(f"`{name}`", ", ".join(field.dims), field.unit, field.long_name)
            for name, field in table.items()
        ]
    return "\n".join(lines) + "\n"
