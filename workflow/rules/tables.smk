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
