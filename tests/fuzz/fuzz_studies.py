"""A tiny finished study, and copies of it of which one file is damaged: records, points.json, tables, batches."""

import json
import math
import os
import random
import shutil
from collections.abc import Callable
from pathlib import Path

import netCDF4
from fuzz_calling import ANY, BAD, FAULT, GOOD, KEPT, LACKING, Input

from subslide import points
from subslide.keys.entries import ENTRIES
from subslide.points import RUN_KEYS

STUDY = """study: t
figures: none
bands: true
model: radial
cells: 40
t_end: 0.05
snapshot_times: [0, 0.02]
cases:
  - {numerics: [paper, resolved], a_H: [1, 2], r: [0, 0.4]}
  - {scene: dam_break, model: line, boundary: wall, delta: 0, r: 0}
"""
RECORDS_READ_BY = {
    "points": (("table", "runs"), ("table", "series"), ("table", "timing")),
    "companions": (("table", "bands"), ("tables",)),
}
"""Verbs by the part of points.json whose records they read; the latter read both."""

TABLES_READ_BY = {
    "runs": (("claims",), ("table", "claims"), ("figure", "fig06_fronts"), ("figure", "fig08_max_eta")),
    "series": (
        ("claims",),
        ("figure", "fig06_fronts"),
        ("figure", "fig08_max_eta"),
    ),
    "bands": (("claims",), ("table", "runs"), ("figure", "fig06_fronts")),
    "errors": (("verify",),),
}


def finish(folder: Path) -> Path:
    """Solve the study in a folder by the commands of its jobs, and return its results."""
    from subslide import catalogue, tables
    from subslide.__main__ import main
    from subslide.study import config, plan, staging

    def command(*words: object) -> None:
        assert main([str(word) for word in words]) == 0

    (folder / "study.yaml").write_text(STUDY)
    study, results = config.read_study(folder / "study.yaml"), folder / "t"
    staged = staging.stage(plan.plan(study, results), folder / "staged", {}, [])
    for name in ("records", "batches"):
        (results / name).mkdir(parents=True)
    for name, spec in staged.specs.items():
        ledger = results / f"batches/{name}.json"
        command("batch", spec, "-o", results / f"records/{name}.nc", "--ledger", ledger)
    command("keep", staged.points_file, "-o", results / "points.json")
    wanted = [name for name in catalogue.names("tables") if not tables.load(name).needs(study)]
    while wanted:
        name = next(one for one in wanted if not set(catalogue.table(one).reads) & set(wanted))
        command("table", name, results)
        wanted.remove(name)
    return results


def words_of(verb: tuple[str, ...]) -> list[str]:
    """Words of the command line for a verb on the copy."""
    return ["figure", verb[1], "--results", "t", "-o", "f"] if verb[0] == "figure" else [*verb, "t"]


Damage = Callable[[bytes], bytes]


def flips(rng: random.Random, count: int) -> Damage:
    """Function that changes some bits."""
    seed = rng.randrange(1 << 30)

    def damage(content: bytes) -> bytes:
        dice, changed = random.Random(seed), bytearray(content)
        for _ in range(count):
            changed[dice.randrange(len(changed))] ^= 1 << dice.randrange(8)
        return bytes(changed)

    return damage


def blanked(rng: random.Random) -> Damage:
    """Function that sets a block to zero."""
    start, size = rng.random(), rng.randrange(16, 4096)
    return lambda content: (
        content[: int(start * len(content))] + bytes(size) + content[int(start * len(content)) + size :]
    )


def cut(share: float) -> Damage:
    """Function that keeps the first part."""
    return lambda content: content[: min(len(content) - 1, int(share * len(content)))]


ANYWHERE: dict[str, Damage] = {
    "empty": lambda content: b"",
    "one byte": lambda content: content[:1],
    "text": lambda content: b"nothing of the kind\n",
    "binary": lambda content: bytes(range(256)) * 8,
    "utf-16": lambda content: content.decode("latin-1").encode("utf-16"),
    "png": lambda content: b"\x89PNG\r\n\x1a\n" + content,
    "zeros": lambda content: bytes(len(content)),
    "html": lambda content: b"<html>404</html>",
    "reversed": lambda content: content[::-1],
    "half": cut(0.5),
    "less a byte": cut(1.0),
}
"""What may become of any file."""


class Copies:
    """Inputs that are a copy of the study with one file damaged."""

    def __init__(self, source: Path, rng: random.Random):
        """Keep the finished study."""
        self.source, self.rng = source, rng
        self.tables = {f"t/tables/{path.name}": path.read_bytes() for path in (source / "tables").iterdir()}

    def changed(
        self, name: str, file: str, verb: tuple[str, ...], damage: Damage, ends: str = FAULT
    ) -> Input:
        """Input whose copy has other bytes in a file."""

        def edit(path: Path) -> None:
            path.write_bytes(damage(path.read_bytes()))

        return self.edited(name, file, verb, edit, ends)

    def edited(
        self, name: str, file: str, verb: tuple[str, ...], edit: Callable[[Path], object], ends: str = FAULT
    ) -> Input:
        """Input whose copy has a file edited."""

        def fill(folder: Path) -> None:
            shutil.copytree(self.source, folder / "t")
            edit(folder / "t" / file)

        makes = ("t/tables/", "f")
        return Input(
            f"{file}: {name}", words_of(verb), ends, (file, Path(file).name), fill, makes, self.tables
        )

    def replaced(self, file: str, verb: tuple[str, ...]) -> list[Input]:
        """Inputs whose file is something else than a file."""

        def remake(make: Callable[[Path], object]) -> Callable[[Path], object]:
            return lambda path: (path.unlink(), make(path))

        others = {
            "missing": (lambda path: None, LACKING),
            "folder": (lambda path: path.mkdir(), LACKING),
            "pipe": (os.mkfifo, LACKING),
            "dangling": (lambda path: path.symlink_to("nowhere"), LACKING),
        }
        return [self.edited(name, file, verb, remake(make), ends) for name, (make, ends) in others.items()]


def records(source: Path, rng: random.Random, count: int) -> list[Input]:
    """Damaged records."""
    copies, inputs = Copies(source, rng), []
    held = json.loads((source / "points.json").read_text())
    batches = {part: sorted({row["batch"] for row in held[part]}) for part in RECORDS_READ_BY}

    def any_of(name: str, damage: Damage, ends: str = FAULT) -> Input:
        part = rng.choice(sorted(batches))
        verb = rng.choice([*RECORDS_READ_BY[part], *RECORDS_READ_BY["companions"]])
        return copies.changed(name, f"records/{rng.choice(batches[part])}.nc", verb, damage, ends)

    inputs = [any_of(name, damage) for name, damage in ANYWHERE.items()]
    file, other = (f"{batches[part][0]}.nc" for part in ("points", "companions"))
    inputs += copies.replaced(f"records/{file}", ("tables",))

    def swap(path: Path) -> None:
        beside = path.with_name(other)
        first, second = path.read_bytes(), beside.read_bytes()
        path.write_bytes(second)
        beside.write_bytes(first)

    def foreign(path: Path) -> None:
        with netCDF4.Dataset(os.fspath(path), "w") as data:
            data.createDimension("x", 3)
            data.createVariable("h2", "f8", ("x",))[:] = 1

    for verb in (("table", "runs"), ("table", "series"), ("tables",)):
        edits = {"swapped with another": swap, "foreign NetCDF": foreign}
        edits |= {
            f"without {name}": lambda path, name=name: older(path, name) for name in ("x_front", "time", "id")
        }
        inputs += [copies.edited(name, f"records/{file}", verb, edit) for name, edit in edits.items()]
    while len(inputs) < count:
        kinds = [
            (flips(rng, 1), "a bit flipped", KEPT),
            (flips(rng, 20), "bits flipped", KEPT),
            (blanked(rng), "a block of zeros", KEPT),
            (cut(rng.random()), "cut", FAULT),
        ]
        damage, name, ends = rng.choice(kinds)
        inputs.append(any_of(name, damage, ends))
    return inputs


def older(path: Path, missing: str) -> None:
    """Write a record without one of its variables, its checksum right: as another version might have written it."""
    from subslide.records import netcdf

    variables, attrs = netcdf.read(path)
    variables.pop(missing)
    attrs[netcdf.CHECKSUM] = netcdf.digest(variables, attrs)
    netcdf._store(path, variables, attrs, small=False)


def tables(source: Path, rng: random.Random, count: int) -> list[Input]:
    """Damaged tables."""
    copies, inputs = Copies(source, rng), []

    def lines(change: Callable[[list[bytes]], list[bytes]]) -> Damage:
        return lambda content: b"\n".join(change(content.split(b"\n")))

    damages: dict[str, Damage] = {
        **ANYWHERE,
        "header alone": lines(lambda rows: [rows[0], b""]),
        "no header": lines(lambda rows: rows[1:]),
        "a row less": lines(lambda rows: [*rows[:-2], b""]),
        "a row twice": lines(lambda rows: [*rows[:2], *rows[1:]]),
        "a column less": lines(lambda rows: [row.partition(b",")[2] for row in rows]),
        "a column renamed": lines(lambda rows: [rows[0].replace(b"id", b"name", 1), *rows[1:]]),
        "texts for numbers": lambda content: content.replace(b"0.", b"o."),
        "no numbers": lambda content: content.replace(b"0.", b"nan"),
        "semicolons": lambda content: content.replace(b",", b";"),
        "quotes": lambda content: content.replace(b",", b',"', 1),
        "nul": lambda content: content[:40] + b"\0" + content[40:],
        "another run": lambda content: content.replace(b"\np", b"\nq"),
    }  # fmt: skip
    for name, damage in damages.items():
        table = rng.choice(sorted(TABLES_READ_BY))
        inputs.append(copies.changed(name, f"tables/{table}.csv", rng.choice(TABLES_READ_BY[table]), damage))
    for table, verbs in TABLES_READ_BY.items():
        inputs += copies.replaced(f"tables/{table}.csv", verbs[0])
    while len(inputs) < count:
        table = rng.choice(sorted(TABLES_READ_BY))
        name, damage = rng.choice(
            [*damages.items(), ("a bit flipped", flips(rng, 1)), ("cut", cut(rng.random()))]
        )
        verb = rng.choice(TABLES_READ_BY[table])
        inputs.append(copies.changed(name, f"tables/{table}.csv", verb, damage))
    return inputs


JSONS = {
    **{text: text.encode() for text in ("[]", "{}", "null", "3", '"points"', "[1]", "NaN", "{", "true")},
    **{
        text: text.encode()
        for text in ('{"points": 3}', '{"points": []}', '{"points": [3]}', '{"points": [{}]}')
    },
    **{
        text: text.encode()
        for text in ('{"points": null}', '{"points": {}}', '{"points": [[]]}', '{"points": "p"}')
    },
    "deep": b"[" * 100_000,
    "deep and closed": b'{"points": ' + b"[" * 50_000 + b"]" * 50_000 + b"}",
    "a number of 5,000 digits": b'{"points": ' + b"9" * 5000 + b"}",
    "deep map": b'{"points":' * 50_000,
    "surrogate": b'{"points": [{"id": "\\ud800"}]}',
    "control": b'{"points": [{"id": "\x07\x1b[31m"}]}',
}
HOSTILE = (
    "x",
    "",
    None,
    True,
    [],
    {},
    [1],
    math.nan,
    math.inf,
    1e300,
    -1,
    10**400,
    "\x1b[31m",
    "x" * 5000,
    0.5,
    "../x",
    5e-324,
)


def row_edits(rng: random.Random, rows: list[dict]) -> tuple[str, Callable[[list[dict]], None], bool]:
    """An edit of one key of one row, in words and as a function, and whether the id was made to match."""
    row, key = rng.randrange(len(rows)), rng.choice([*RUN_KEYS, "id"])
    value = rng.choice([other for other in HOSTILE if other != rows[row].get(key)])
    match = rng.random() < 0.5 and key != "id"

    def edit(these: list[dict]) -> None:
        these[row][key] = value
        if match:
            with_id(these[row])

    return f"{key}: {str(value)[:20]!r}{', id made to match' if match else ''}", edit, match


def with_id(row: dict) -> None:
    """Give a row the id that its values have, if such values have any."""
    try:
        row["id"] = points.from_dict({key: row[key] for key in RUN_KEYS}).id
    except (TypeError, ValueError, AttributeError, OverflowError, KeyError):
        return


def allowed(key: str, value: object) -> bool:
    """Whether a hostile value is one that a key may have (text of a free form, an option's mapping)."""
    from subslide.keys import schema
    from subslide.keys.schema import ConfigError

    try:
        schema.checked(key, value)
    except ConfigError:
        return False
    return True


def _as_json(edit: Callable[[dict], None]) -> Damage:
    """Function that edits what a file holds as JSON."""

    def damage(content: bytes) -> bytes:
        held = json.loads(content)
        edit(held)
        return json.dumps(held, indent=1).encode()

    return damage


def indices(source: Path, rng: random.Random, count: int) -> list[Input]:
    """Damaged points.json."""
    copies, file = Copies(source, rng), "points.json"
    held = json.loads((source / file).read_text())
    verbs = (
        ("table", "runs"),
        ("table", "series"),
        ("tables",),
        ("claims",),
        ("figure", "fig05_h2_by_r"),
        ("errors",),
    )
    inputs = [
        copies.changed(name, file, rng.choice(verbs), damage)
        for name, damage in ANYWHERE.items()
        if name != "less a byte"
    ]
    inputs += [
        copies.changed(name, file, rng.choice(verbs), lambda _, text=text: text)
        for name, text in JSONS.items()
    ]
    inputs += copies.replaced(file, ("tables",))

    def swap(key: str) -> Callable[[dict], None]:
        def edit(held: dict) -> None:
            first, last = held["points"][0], held["companions"][-1]
            first[key], last[key] = last[key], first[key]

        return edit

    def put(part: str, key: str, value: object) -> Callable[[dict], None]:
        return lambda held: held[part][0].update({key: value})

    def less(part: str, key: str) -> Callable[[dict], None]:
        return lambda held: lose(held, part, key)

    edits: dict[str, Callable[[dict], None]] = {
        **{f"{key} swapped": swap(key) for key in ("id", "batch", "cells")},
        **{f"a run without {key}": less("points", key) for key in ("id", "batch", "numerics", "r", "scene")},
        **{f"a companion without {key}": less("companions", key) for key in ("of", "role", "batch")},
        **{
            f"batch {value!r}": put("points", "batch", value)
            for value in (None, 3, "../../x", "9999", "\0", [])
        },
        **{f"role {value!r}": put("companions", "role", value) for value in (None, "cells/3", [])},
        "a run twice": lambda held: held["points"].append(held["points"][0]),
        "companions are text": lambda held: held.update(companions="none"),
        "numerics by a long name": put("points", "numerics", "x" * 5000),
        "numerics by another name": put("points", "numerics", "best"),
    }
    inputs += [copies.changed(name, file, ("tables",), _as_json(edit)) for name, edit in edits.items()]
    rng.shuffle(inputs)
    inputs = inputs[: 3 * count // 4]
    while len(inputs) < count:
        name, edit, _ = row_edits(rng, held["points"])
        damage = _as_json(lambda held, edit=edit: edit(held["points"]))
        inputs.append(copies.changed(name, file, rng.choice(verbs[:3]), damage))
    return inputs


def lose(held: dict, part: str, key: str) -> None:
    """Take a key from the first row of a part of a file, or from what all rows share."""
    (held[part][0] if key in held[part][0] else held["shared"]).pop(key)


def spelt_out(content: bytes) -> bytes:
    """Return a batch file that states each point whole, as they were before points shared values."""
    held = json.loads(content)
    shared = held.pop("shared")
    held["points"] = [{**shared, **row} for row in held["points"]]
    return json.dumps(held).encode()


def specs(source: Path, rng: random.Random, count: int) -> list[Input]:
    """Batch files, damaged, by `batch`."""
    path = sorted((source / "batches").glob("*.json"))[-1]
    content = path.read_bytes()
    whole = spelt_out(content)
    rows = json.loads(whole)["points"]

    def one(name: str, text: bytes, ends: str = BAD) -> Input:
        words, makes = ["batch", "b.json", "-o", "o.nc"], ("o.nc",) if ends in (GOOD, ANY) else ()
        return Input(
            f"batch: {name}",
            words,
            ends,
            ("b.json",),
            lambda folder: (folder / "b.json").write_bytes(text),
            makes,
        )

    inputs = [one("as it is", content, GOOD), one("spelt out", whole, GOOD)]
    inputs += [one(name, damage(content)) for name, damage in ANYWHERE.items() if name != "less a byte"]
    inputs += [one(name, text) for name, text in JSONS.items()]
    edits: dict[str, Callable[[dict], None]] = {
        "no points": lambda held: held.pop("points"),
        "a point twice": lambda held: held["points"].append(held["points"][0]),
        **{f"without {key}": lambda held, key=key: lose(held, "points", key) for key in ("id", "r", "scene")},
        "another key": lambda held: held["points"][0].update(nope=1),
    }
    of_shared: dict[str, Callable[[dict], None]] = {
        "nothing shared": lambda held: held.pop("shared"),
        "shared is text": lambda held: held.update(shared="none"),
        "another shared key": lambda held: held["shared"].update(nope=1),
        "a key in both": lambda held: held["points"][0].update(scene=held["shared"]["scene"]),
        "another shared value": lambda held: held["shared"].update(g=3.7),
    }
    inputs += [one(name, _as_json(edit)(content)) for name, edit in {**edits, **of_shared}.items()]
    inputs += [one(f"{name}, spelt out", _as_json(edit)(whole)) for name, edit in edits.items()]
    rng.shuffle(inputs)
    inputs = inputs[: count // 2]
    while len(inputs) < count:
        name, edit, match = row_edits(rng, rows)
        key, text = name.split(":")[0], _as_json(lambda held, edit=edit: edit(held["points"]))(whole)
        changed = next(
            new[key]
            for new, old in zip(json.loads(text)["points"], rows, strict=True)
            if str(new[key]) != str(old[key])
        )
        free = match and key in ENTRIES and allowed(key, changed)
        inputs.append(one(name, text, ANY if free else BAD))
    return inputs
