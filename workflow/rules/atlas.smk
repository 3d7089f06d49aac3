# The stability atlas and the largest stable Courant numbers, in studies that draw them.

if any(name.startswith("stability_") for name in STUDY.figures):

    rule atlas:
        input:
            TABLES,
            points=RESULTS / "points.json",
            records=RECORDS,
        output:
            report(
                RESULTS / "tables/atlas.csv",
                caption="../report/atlas.rst",
                category="5 Tables",
                labels={"figure": "Stability atlas"},
            ),
        log:
            RESULTS / "logs/atlas.log",
        benchmark:
            RESULTS / "benchmarks/atlas.tsv"
        resources:
            mem_mb=2000,
            runtime=30,
        params:
            sources=source_hash(),
            results=RESULTS,
        shell:
            "subslide atlas {params.results:q} > {log:q} 2>&1"

    # Solves runs of its own, whose Courant numbers follow from each other.
    rule cfl:
        input:
            [
                RESULTS / f"kernels/{model}_float64{kind}.done"
                for model in ("radial", "quarter")
                for kind in ("", "_general")
            ],
        output:
            report(
                RESULTS / "tables/cfl.csv",
                caption="../report/cfl.rst",
                category="5 Tables",
                labels={"figure": "Largest stable Courant numbers"},
            ),
        log:
            RESULTS / "logs/cfl.log",
        benchmark:
            RESULTS / "benchmarks/cfl.tsv"
        resources:
            mem_mb=2000,
            runtime=60,
        params:
            sources=source_hash(),
            results=RESULTS,
        shell:
            "subslide cfl {params.results:q} > {log:q} 2>&1"

    TABLES = [*TABLES, RESULTS / "tables/atlas.csv", RESULTS / "tables/cfl.csv"]
