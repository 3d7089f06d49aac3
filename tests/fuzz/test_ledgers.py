"""Damaged ledgers and checksums: a plan is made all the same, of every point once, and writes nothing."""

import json
import shutil
from pathlib import Path

import pytest
from fuzz_calling import SECONDS, changes, rng_of, snapshot, within
from fuzz_studies import ANYWHERE, HOSTILE, JSONS, STUDY, blanked, cut, flips

from subslide.study import config, plan

INPUTS = 60
BESIDE = (
    "0001.json.bak",
    "0001-old.json",
    "0001.json~",
    ".#0001.json",
    "1.json",
    "0001 (copy).json",
    "x.json",
    "0009.json",
    "\udcff.json",
)
"""Names of files that lie beside those of the ledger."""


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    """The study that is finished."""
    path = tmp_path_factory.mktemp("study") / "t.yaml"
    path.write_text(STUDY)
    return config.read_study(path)


def damaged(folder: Path, rng) -> str:
    """Damage a copy of the study, and say how."""
    file = rng.choice([*sorted((folder / "batches").iterdir()), *sorted((folder / "records").iterdir())])
    how = rng.choice(["bytes", "json", "row", "beside", "gone", "folder", "swapped"])
    if how == "bytes":
        name, damage = rng.choice(
            [*ANYWHERE.items(), ("flips", flips(rng, 3)), ("zeros", blanked(rng)), ("cut", cut(rng.random()))]
        )
        file.write_bytes(damage(file.read_bytes()))
        return f"{file.name}: {name}"
    if how == "gone":
        file.unlink()
    elif how == "folder":
        file.unlink()
        file.mkdir()
    elif how == "swapped":
        other = rng.choice([path for path in file.parent.iterdir() if path.suffix == file.suffix])
        first, second = file.read_bytes(), other.read_bytes()
        file.write_bytes(second)
        other.write_bytes(first)
        return f"{file.name} and {other.name} swapped"
    elif how == "beside":
        name = rng.choice(BESIDE)
        text = rng.choice([*JSONS.values(), (sorted((folder / "batches").iterdir())[0]).read_bytes()])
        (folder / "batches" / name).write_bytes(text)
        return f"beside: {name!r}"
    else:
        file = rng.choice(sorted((folder / "batches").iterdir()))
        held = json.loads(file.read_text())
        if how == "json":
            name, text = rng.choice(sorted(JSONS.items()))
            file.write_bytes(text)
            return f"{file.name}: {name}"
        key, value = rng.choice(sorted(held["points"][0])), rng.choice(HOSTILE)
        held["points"][0][key] = value
        file.write_text(json.dumps(held))
        return f"{file.name}: {key} = {str(value)[:20]}"
    return f"{file.name}: {how}"


def faults(study, folder: Path) -> list[str]:
    """What is wrong with the plan of a study in a folder; nothing if all is right."""
    before = snapshot(folder)
    try:
        with within(SECONDS):
            planned = plan.plan(study, folder)
    except BaseException as error:
        return [f"raised {type(error).__name__}: {error}"[:200]]
    ids = sorted(point.id for batch in planned.batches.values() for point in batch.points)
    wrong = [] if ids == sorted(point.id for point in study.solved) else ["a point has no batch, or two"]
    wrong += ["writes"] if changes(before, snapshot(folder)) else []
    wrong += (
        ["a line is long or unprintable"]
        if any(not line.isprintable() or len(line) > 300 for line in planned.faults)
        else []
    )
    for name, batch in planned.batches.items():
        record = plan.record_path(folder, name)
        if not batch.text and not (record.is_file() and (folder / "batches" / f"{name}.json").is_file()):
            wrong.append("takes what is not there for solved")
    return wrong


@pytest.mark.parametrize("count", [INPUTS, pytest.param(4 * INPUTS, marks=pytest.mark.long)])
def test_a_damaged_ledger_never_stops_a_study(count, study, finished, seed, tmp_path):
    rng, failed = rng_of(seed, f"ledgers {count}"), []
    assert faults(study, finished) == []
    for number in range(count):
        folder = tmp_path / str(number)
        shutil.copytree(finished, folder)
        how = damaged(folder, rng)
        if wrong := faults(study, folder):
            failed.append(f"{how}: {'; '.join(wrong)}")
        shutil.rmtree(folder)
    assert not failed, "\n".join([f"{len(failed)} of {count} (SUBSLIDE_FUZZ_SEED={seed})", *failed])


def test_only_what_is_damaged_is_solved_again(study, finished, tmp_path):
    shutil.copytree(finished, tmp_path / "t")
    records = sorted((tmp_path / "t/records").glob("*.nc"))
    records[0].write_bytes(cut(0.5)(records[0].read_bytes()))
    planned = plan.plan(study, tmp_path / "t")
    assert [name for name, batch in planned.batches.items() if batch.text] == [records[0].stem]
