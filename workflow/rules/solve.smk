# Records: one job solves the points of one batch. Which batch has which points stands in the plan.

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
        points=POINTS[0],
        checksum=POINTS[1],
    log:
        RESULTS / "logs/points.log",
    params:
        text=remembered(STAGED.points_file),
    shell:
        "logged {log:q} subslide keep {params.text[0]:q} -o {output.points:q}"


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
