"""The page on studies, config/README.md: every key, named numerics, and every scene with its options."""

from subslide import catalogue, scenes
from subslide.keys import schema, words
from subslide.pages._rows import row

PATH = "config/README.md"
INTRODUCTION = """# Studies

<!-- written by `make docs` from src/subslide/keys/entries.py and src/subslide/scenes -->

One YAML file is one study. Run it with

    make study CONFIG=config/mine.yaml CORES=2

or, wherever the package is installed, `subslide study mine.yaml --cores 2` (docs/workflow.md), or, in the virtual
environment that `make setup` makes, `snakemake --configfile config/mine.yaml --cores 2`.
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

A list of numbers may be `{linspace: [first, last, count]}`, `{geomspace: [first, last, count]}` or
`{arange: [first, last, step]}`. Points whose values are chosen together (side by side, from a CSV file, a Latin
hypercube, a Sobol' sequence, Saltelli's blocks) are a `design`, one more axis of the product: docs/designs.md.

```yaml
study: sampled
r: {linspace: [0, 0.8, 5]}
design:
  sobol: {points: 64, seed: 1, over: {a_H: [0.5, 10], m: {log_uniform: [0.4, 2]}}}
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

Files are read strictly, since much of YAML is read in several ways. A number is decimal (`200`, `0.5`, `1e-3`):
`0200`, `1:30`, `1_000`, `0x1F` and dates are refused. Only `true` and `false` are booleans; what stands in quotes is
text. A key comes once. Anchors, aliases and `<<` may join keys of cases; tags and several documents may not stand in a
file. It is a regular file in UTF-8 of at most 1 MB and 200,000 values. Options of `subslide run` follow the same
rules.

What a study costs is estimated before it starts: `subslide check` says it, and one that needs more than
`max_core_hours`, `max_memory` or `max_disk` is refused until its file sets that key higher. A run to rest is taken to
end when friction stops its grains, and a box to grow as far as they may go; a run whose step collapses takes longer.
`subslide run` has these limits too, as keys of its file and as options. Of the other keys of a study it checks
`study`, `figures`, `bands` and `keep`, whose values say nothing of one run, says that `bands: true`, or a `keep` that
drops something, is left out, and refuses `cases` and `design`.

`bands: true` solves each run on two coarser grids as well, and estimates from the three what the finest leaves
uncertain; see `bands.csv` in docs/tables.md. Adding or removing it computes the coarser runs alone, or nothing. Runs on
fitted grids need none.

Changing the lists computes only what is new: each point has a name that depends on its values alone (`1` and `1.0`
are the same), a ledger in `results/<study>/batches/` remembers which record holds it, and points that are no longer
asked for stay there unused. A change of the package's code computes everything again. A study that was killed or
damaged is mended by making it again: docs/disturbed.md.

## Keys

"""

SCENES = """
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


def text() -> str:
    """Return the page."""
    sections = "\n".join(scene(name) for name in catalogue.names("scenes"))
    return INTRODUCTION + keys() + presets() + SCENES + sections


def keys() -> str:
    """Return the table (Markdown) of all keys of a study."""
    rows = ["| key | meaning | unit | default | allowed | axis |", "|---|---|---|---|---|---|"]
    for key, about in schema.properties().items():
        default = words.show(about["default"]) if "default" in about else "needed"
        axis = "yes" if schema.is_axis(key) else ""
        entries = (f"`{key}`", about["description"], words.unit(key), default, words.allowed(key), axis)
        rows.append(row(*entries))
    return "\n".join(rows) + "\n"


def presets() -> str:
    """Return the list (Markdown) of what each value of `numerics` sets."""
    lines = ["", "## Named numerics", ""]
    for name, values in schema.properties()["numerics"]["presets"].items():
        text = (
            ", ".join(f"`{key}: {value}`" for key, value in values.items()) or "nothing: the defaults above"
        )
        lines.append(f"- `{name}` sets {text}")
    return "\n".join(lines) + "\n"


def scene(name: str) -> str:
    """Return the section (Markdown) on a scene and its options."""
    module = scenes.load(name)
    lines = [f"### {name}", "", (module.__doc__ or "").strip().replace("\n", " ").replace("  ", "\n\n"), ""]
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
        lines.append(row(*entries))
    return "\n".join(lines) + ("\n" if module.OPTIONS else "")
