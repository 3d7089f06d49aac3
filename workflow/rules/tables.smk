# Tables: they depend on the list of points and on the batches that those are in.

SERIES = "series.parquet" if len(STUDY.points) > 1000 else "series.csv"
TABLES = [RESULTS / "tables" / name for name in ("runs.csv", "timing.csv", SERIES)]
if STUDY.bands:
    TABLES.append(RESULTS / "tables/bands.csv")


rule tables:
    input:
        points=RESULTS / "points.json",
        records=RECORDS,
    output:
        report(
            TABLES[0], caption="../report/runs.rst", category="5 Tables", labels={"figure": "Table of runs"}
        ),
        TABLES[1:],
    log:
        RESULTS / "logs/tables.log",
    benchmark:
        RESULTS / "benchmarks/tables.tsv"
    resources:
        mem_mb=2000,
        runtime=60,
    params:
        sources=source_hash(),
        results=RESULTS,
    shell:
        "subslide tables {params.results:q} > {log:q} 2>&1"


# What the paper says, held against both kinds of numerics.
CLAIMS = []
if {"paper", "resolved"} <= {label for label, _ in STUDY.runs}:
    CLAIMS = [RESULTS / f"tables/claims.{kind}" for kind in ("html", "csv")]

    rule claims:
        input:
            TABLES,
        output:
            report(
                CLAIMS[0],
                caption="../report/claims.rst",
                category="6 The paper's claims",
                labels={"figure": "The paper's claims, held against this study"},
            ),
            report(
                CLAIMS[1],
                caption="../report/claims.rst",
                category="6 The paper's claims",
                labels={"figure": "Table of claims"},
            ),
        log:
            RESULTS / "logs/claims.log",
        benchmark:
            RESULTS / "benchmarks/claims.tsv"
        resources:
            mem_mb=1000,
            runtime=10,
        params:
            sources=source_hash("figure"),
            results=RESULTS,
        shell:
            "subslide claims {params.results:q} > {log:q} 2>&1"


# Errors, where a scene has an exact solution.
if any(point.scene in exact.NAMES for point in STUDY.points):

    rule errors:
        input:
            points=RESULTS / "points.json",
            records=RECORDS,
        output:
            report(
                RESULTS / "tables/errors.csv",
                caption="../report/errors.rst",
                category="5 Tables",
                labels={"figure": "Errors against exact solutions"},
            ),
        log:
            RESULTS / "logs/errors.log",
        benchmark:
            RESULTS / "benchmarks/errors.tsv"
        resources:
            mem_mb=2000,
            runtime=60,
        params:
            sources=source_hash(),
            results=RESULTS,
        shell:
            "subslide errors {params.results:q} > {log:q} 2>&1"

    TABLES = [*TABLES, RESULTS / "tables/errors.csv"]


# Error against seconds, where one column is solved by many numerics and to a converged answer.
if problems(STUDY.points):

    rule work_precision:
        input:
            points=RESULTS / "points.json",
            records=RECORDS,
        output:
            report(
                RESULTS / "tables/work_precision.csv",
                caption="../report/work_precision.rst",
                category="5 Tables",
                labels={"figure": "Error and seconds of every choice of numerics"},
            ),
            report(
                RESULTS / "tables/cheapest.csv",
                caption="../report/work_precision.rst",
                category="5 Tables",
                labels={"figure": "Cheapest choices of numerics"},
            ),
        log:
            RESULTS / "logs/work_precision.log",
        benchmark:
            RESULTS / "benchmarks/work_precision.tsv"
        resources:
            mem_mb=2000,
            runtime=30,
        params:
            sources=source_hash("figure"),
            results=RESULTS,
        shell:
            "subslide work-precision {params.results:q} > {log:q} 2>&1"

    TABLES = [*TABLES, *rules.work_precision.output]
