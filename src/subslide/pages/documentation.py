"""Pages of documentation that follow from the code, so that each fact has one place."""

from subslide import naming, scenes
from subslide.keys import published, schema, words
from subslide.records import thinning
from subslide.tables import _convergence as convergence
from subslide.tables import atlas, bands, cheapest, claims, errors, work_precision
from subslide.tables import cfl as courant
from subslide.tables import runs as tables

CONFIG_PAGE, TABLES_PAGE, RECORDS_PAGE = "config/README.md", "docs/tables.md", "docs/records.md"
SCHEMA_PAGE = "config/study.schema.json"

CONFIG_TEXT = """# Studies

<!-- written by `make docs` from src/subslide/keys/entries.py and src/subslide/scenes -->

One YAML file is one study. Run it with

    make study CONFIG=config/mine.yaml CORES=2

or, in the virtual environment that `make setup` makes, `snakemake --configfile config/mine.yaml --cores 2`.
Results go to `results/<study>/`. Without a file Snakemake runs `config/paper.yaml`; files are never merged.

An editor that knows YAML completes and checks a file that begins with

```yaml
# yaml-language-server: $schema=study.schema.json
```

and lies beside config/study.schema.json, a JSON Schema of all that follows.

Keys are flat. A key that is marked as an axis takes one value or a list; the runs are the product of all lists, and a
point that comes up twice runs once. `subslide check config/mine.yaml` tells what a file holds, or what is wrong.

```yaml
study: mine
a_H: [1, 2, 4]
r: [0, 0.4]
delta: [25, 30, 35]
model: radial
```

A study that is no single product is a list of `cases`, each the product of its own lists; the keys beside `cases` are
the defaults of all, and a case's own key wins. Messages count the cases from 0.

```yaml
study: joined
model: radial
delta: 25
cases:
  - {a_H: [1, 2, 4], r: 0.4}
  - {a_H: 1, r: [0, 0.2, 0.6], delta: [25, 35]}
```

`bands: true` solves each run on two coarser grids as well, and estimates from the three what the finest leaves
uncertain; see `bands.csv` in docs/tables.md. Adding or removing it computes the coarser runs alone, or nothing.

Changing the lists computes only what is new: each point has a name that depends on its values alone (`1` and `1.0`
are the same), a ledger in `results/<study>/batches/` remembers which record holds it, and points that are no longer
asked for stay there unused. A change of the package's code computes everything again.

## Keys

"""

SCENES_TEXT = """
## Scenes

`scene` names the initial state, and `scene_options` its options, each an axis if it has a list:

```yaml
scene: ellipse
scene_options:
  elongation: [1, 1.5, 2]
  angle: 30
```

On the command line: `--scene ellipse --scene-options elongation=2,angle=30`. Lengths are in units of R, depths of H2,
and speeds of sqrt(g H2). With `model: auto` a scene is solved in the cheapest geometry that gives its answer, and a
model that cannot give it is refused; a record and the line of `subslide run` say which one was chosen and why.

"""

TABLES_TEXT = """# Tables

<!-- written by `make docs` from src/subslide/tables.py -->

Written to `results/<study>/tables/`. Rows follow the order of the study's lists; an empty entry is a value that the run
does not have. Runs that failed are rows too: see `status`.

"""


RECORDS_TEXT = """# Records

<!-- written by `make docs` from src/subslide/naming.py -->

`subslide run` writes one run, a study one file for each batch of runs, in one layout (NetCDF-4, CF-1.11): every
variable of a run has the dimension `run`, of length 1 for a single run. Runs that are shorter, or lie in a smaller box,
than others of their batch end in NaN. `results/<study>/points.json` says which batch holds which `id`:

```python
from subslide.results import Results

Results("results/paper").record("p0123456789ab")  # one run by its id, as an xarray dataset without padding
```

Lengths are in m from the axis of the scene, times in s from its release. Front and deposit are measured along the x
axis. In scenes on a line volumes and energy are per metre of width. Each key of a study is a variable too
([config/README.md](../config/README.md)); attributes hold the configuration, versions and a checksum that readers
verify. `status` is one of:

"""


def pages() -> dict[str, str]:
    """Text of each generated page, by its path from the root of the repository."""
    return {
        CONFIG_PAGE: CONFIG_TEXT + keys() + presets() + all_scenes(),
        TABLES_PAGE: TABLES_TEXT + columns(),
        RECORDS_PAGE: RECORDS_TEXT + variables(),
        SCHEMA_PAGE: published.text({name: scenes.load(name).OPTIONS for name in scenes.NAMES}),
    }


def variables() -> str:
    """Tables (Markdown) of the statuses and the variables of a record."""
    lines = [f"- `{name}`: {text}" for name, text in naming.STATUSES.items()]
    parts = {
        "Series, a sample each time step": naming.SERIES,
        "Profiles along the x axis, at each snapshot": naming.PROFILES,
        "Fields, at each snapshot (`fields: true`, in the plane)": naming.FIELDS_2D,
        "A value a run": naming.SCALARS,
        "Coordinates": naming.COORDINATES,
    }
    for title, table in parts.items():
        lines += ["", f"## {title}", "", "| name | dimensions | unit | meaning |", "|---|---|---|---|"]
        lines += [
            f"| `{name}` | {', '.join(field.dims)} | {field.unit} | {field.long_name} |"
            for name, field in table.items()
        ]
    return "\n".join(lines) + "\n"


def keys() -> str:
    """Table (Markdown) of all keys of a study."""
    rows = ["| key | meaning | unit | default | allowed | axis |", "|---|---|---|---|---|---|"]
    for key, about in schema.properties().items():
        default = words.show(about["default"]) if "default" in about else "needed"
        axis = "yes" if schema.is_axis(key) else ""
        entries = (f"`{key}`", about["description"], words.unit(key), default, words.allowed(key), axis)
        rows.append("| " + " | ".join(entries) + " |")
    return "\n".join(rows) + "\n"


def presets() -> str:
    """List (Markdown) of what each value of `numerics` sets."""
    lines = ["", "## Named numerics", ""]
    for name, values in schema.properties()["numerics"]["presets"].items():
        text = (
            ", ".join(f"`{key}: {value}`" for key, value in values.items()) or "nothing: the defaults above"
        )
        lines.append(f"- `{name}` sets {text}")
    return "\n".join(lines) + "\n"


def all_scenes() -> str:
    """Sections (Markdown) on each scene and its options."""
    return SCENES_TEXT + "\n".join(_scene(name) for name in scenes.NAMES)


def _scene(name: str) -> str:
    module = scenes.load(name)
    lines = [f"### {name}", "", module.__doc__.strip().replace("\n", " ").replace("  ", "\n\n"), ""]
    if module.OPTIONS:
        lines += ["| option | meaning | unit | default | allowed |", "|---|---|---|---|---|"]
    for option, about in module.OPTIONS.items():
        default = words.show(about["default"]) if "default" in about else "needed"
        entries = (
            f"`{option}`",
            about["description"],
            words.unit_of(about),
            default,
            words.range_of(about),
        )
        lines.append("| " + " | ".join(entries) + " |")
    return "\n".join(lines) + ("\n" if module.OPTIONS else "")


def columns() -> str:
    """Tables (Markdown) of the columns of each table."""
    quantities = {**{f"x_front_{t}": ("m", f"x_front at the {t[:-2]} % front") for t in tables.THRESHOLDS}}
    quantities.update(
        (name, (field.unit if field.unit != "1" else "", field.long_name))
        for name, field in naming.SERIES.items()
        if name != "x_front"
    )
    return "\n".join(
        (
            _section(
                "runs.csv", "One row a run; nothing here differs between two identical runs.", tables.COLUMNS
            ),
            _section("timing.csv", "One row a run.", tables.TIMING),
            _section(
                "series.csv",
                f"Columns `id`, `time` (s), `quantity`, `value`: one row a sample, and a sample each time step (of runs"
                f" of more than {thinning.LONGEST} steps those that keep every extreme; see docs/records.md). Above"
                f" {tables.MOST_RUNS_IN_CSV} runs it is `series.parquet` instead. Quantities:",
                quantities,
            ),
            _section("bands.csv", _bands_text(), bands.COLUMNS),
            _section("claims.csv", _claims_text(), claims.COLUMNS),
            _section("errors.csv", _errors_text(), errors.COLUMNS),
            _section("work_precision.csv", _work_precision_text(), work_precision.COLUMNS),
            _section("cheapest.csv", _cheapest_text(), cheapest.COLUMNS),
            _section("atlas.csv", _paragraphs(atlas), atlas.COLUMNS),
            _section("cfl.csv", _paragraphs(courant), courant.COLUMNS),
        )
    )


def _bands_text() -> str:
    """What the table of bands holds, and how its estimates are made."""
    quantities = "\n".join(f"- `{name}`: {text}" for name, text in bands.QUANTITIES.items())
    low, safety = convergence.LOWEST_ORDER, convergence.SAFETY
    return f"""One row for each run, quantity and time, in studies with `bands: true` only. Each run has two companions,
equal but for their coarser grids, which have no rows elsewhere. From the values f1 (the run), f2 (cells/2) and f3
(cells/4) follow the observed order p = log2((f3 - f2)/(f2 - f1)), the limit f1 + (f1 - f2)/(2^p - 1) of Richardson's
extrapolation, and the band {safety} |f1 - f2|/(2^p - 1): the grid convergence index times the value (Roache 1994;
Celik et al. 2008). Fronts and waves that come of a jump converge at first order in either scheme; where p > 1, f1 and
f2 agree by chance, and the band is {safety} |f3 - f2|/2, what the coarser pair leaves at first order. So the band
estimates, with a factor of safety of {safety}, how far the value lies from that on ever finer grids. It is an
estimate of the error of discretisation alone (on the paper's columns 94 in 100 bands held the answer of a finer grid),
and says nothing of the model's own error, its parameters, or the threshold that defines a front.

`{convergence.NOT_CONVERGED}`: the differences change sign, grow, or shrink with an order below {low}, or one of the
three runs failed. Then there is no limit, and the band is thrice the range of the three values (Eca and Hoekstra 2014),
or empty if a run failed. Where f1
and f2 agree to round-off the limit is f1 and no order is given. Times are those of the run's `snapshot_times` after the
start.

Quantities:

{quantities}"""


def _claims_text() -> str:
    """What the table of claims holds, and how its verdicts are made."""
    return f"""One row for each thing that sections 4 and 5 of the source paper say of its results, in studies with
both numerics `paper` and `resolved`; `subslide claims results/<study>` writes it, claims.html beside it, and prints the
same. Each is broken down into comparisons, such as L_f at one r against the next. `{claims.SUPPORTED}`: every one
holds by more than the bands of the values compared; `{claims.REFUTED}`: one fails by more than that (or all fail, where
the paper says that something happens somewhere); else `{claims.OPEN}`, also where a value that decides is not
converged. Without bands numbers count as they are. A claim is left out where the study lacks what it needs. Judged are
the runs that differ from the first of their numerics in a_H and r alone. Times have no bands of their own: that of the
front's arrival is what the band of L_f moves it by."""


def _errors_text() -> str:
    """What the table of errors holds."""
    quantities = "\n".join(f"- `{name}`: {text}" for name, text in errors.QUANTITIES.items())
    verdicts = "\n".join(f"- `{name}`: {text}" for name, text in errors.VERDICTS.items())
    return f"""One row for each run, quantity and time with a known answer, in studies that have a scene with an exact
solution. Times are those of `snapshot_times` after the start, and `t_end` where it is a time. Reasons for the expected
orders: docs/verification.md.

Quantities:

{quantities}

Verdicts:

{verdicts}"""


def _work_precision_text() -> str:
    """What the table of errors and seconds holds."""
    quantities = "\n".join(f"- `{name}`: {text}" for name, text in work_precision.QUANTITIES.items())
    return f"""One row for each run and quantity, in studies that solve a column in the plane and, by the default
numerics, on three grids on a radius of which each has twice the cells of the next. The three finest of these give the
truth: Richardson's limit, with the band of bands.csv about it. The error is the mean of |value - truth| over the mean
of the truth: of one length, or of a series at {work_precision.TIMES} times. docs/work_precision.md has the reasons.

Quantities:

{quantities}"""


def _cheapest_text() -> str:
    """What the table of cheapest choices holds."""
    targets = ", ".join(f"{100 * target:g}" for target in cheapest.TARGETS)
    return f"""One row for each column, quantity, error that is asked for ({targets} %) and choice, of the runs in
work_precision.csv: the cheapest run whose `sure_error` is no larger. No value is interpolated between runs."""


def _paragraphs(module) -> str:
    """Docstring of a module whose table is in studies with figures of stability, names of its constants with values."""
    names = {
        f"`{name}`": f"{value}" for name, value in vars(module).items() if isinstance(value, int | float)
    }
    text = module.__doc__.strip()
    for name, value in names.items():
        text = text.replace(name, value)
    return f"In studies with figures of stability.\n\n{text}"


def _section(title: str, text: str, rows: dict[str, tuple[str, str]]) -> str:
    lines = [f"## {title}", "", text, "", "| name | unit | meaning |", "|---|---|---|"]
    lines += [f"| `{name}` | {unit} | {meaning} |" for name, (unit, meaning) in rows.items()]
    return "\n".join(lines) + "\n"
