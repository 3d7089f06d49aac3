# Records: one job solves the points of one batch. Which batch has which points stands in the plan.
from shlex import quote

# Jobs find the commands of the virtual environment that Snakemake itself runs in; what a failed one said last is shown.
shell.prefix(
    f"set -euo pipefail; export PATH={quote(str(Path(sys.executable).parent))}:$PATH; "
    'logged() {{ log=$1; shift; "$@" > "$log" 2>&1 || '
    '{{ code=$?; echo "$log:" >&2; tail -n 5 "$log" >&2; exit $code; }}; }}; '
)


def sealed(*paths):
    """Return the paths of files, each with that of its checksum."""
    return [file for path in paths for file in (path, checksums.beside(path))]


def stamp(name, outputs, whole, rank=0):
    """Return the input by which a job starts again where what it made is not whole, as `whole()` tells."""
    if CARRIED:
        return []
    return staging.stamp(HOME, name, outputs, whole(), rank) if workflow.is_main_process else HOME / name


def remembered(path, part="record", name=""):
    """Return a path and a hash of sources as Snakemake remembers them of a job, if no stamp tells when to do it again.

    It remembers texts of params, and no paths.
    """
    return (str(path), source_hash(part, name)) if CARRIED else (path, None)


RECORDS = [RESULTS / f"records/{batch}.nc" for batch in STAGED.specs]
SEALED_RECORDS = sealed(*RECORDS)
POINTS = sealed(RESULTS / "points.json")

for rank, batch in enumerate(reversed(STAGED.specs)):  # the costliest of new batches are the first of them
    stamp(f"batch-{batch}", [RESULTS / f"records/{batch}.nc"], lambda: not PLAN.batches[batch].text, rank)


# The runs of the study and their order: tables follow from it.
rule points:
    input:
        stamp(
            "points",
            [RESULTS / "points.json"],
            lambda: staging.holds(RESULTS / "points.json", PLAN.points_text),
        ),
    output:
        POINTS,
    log:
        RESULTS / "logs/points.log",
    params:
        text=remembered(STAGED.points_file),
    shell:
        "logged {log:q} subslide keep {params.text[0]:q} -o {output[0]:q}"


rule batch:
    input:
        [] if CARRIED else HOME / "batch-{batch}",
    output:
        record=RESULTS / "records/{batch}.nc",
        checksum=RESULTS / "records/{batch}.nc.sha256",
        ledger=RESULTS / "batches/{batch}.json",
    log:
        RESULTS / "logs/batch-{batch}.log",
    benchmark:
        RESULTS / "benchmarks/batch-{batch}.tsv"
    wildcard_constraints:
        batch=r"\d+(p\d+)?",
    threads: 1
    resources:
        mem_mb=lambda wildcards, attempt: attempt * STAGED.needs[wildcards.batch].mem_mb,
        runtime=lambda wildcards, attempt: attempt * STAGED.needs[wildcards.batch].runtime,
    params:
        spec=lambda wildcards: remembered(STAGED.specs[wildcards.batch]),
        counts=lambda wildcards: progress.counter_path(HOME, wildcards.batch),
    shell:
        "logged {log:q} subslide batch {params.spec[0]:q} --threads {threads} -o {output.record:q} --ledger {output.ledger:q} --counts {params.counts:q}"
