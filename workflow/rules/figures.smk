# Figures: each is drawn from the tables and records alone.

CAPTIONS = Path(workflow.basedir, "workflow/report")
FIGURES = [RESULTS / f"figures/{name}.{kind}" for name in STUDY.figures for kind in ("png", "svg")]


def caption(name):
    """Path of a figure's caption, or None."""
    path = CAPTIONS / f"{name}.rst"
    return str(path) if path.exists() else None


for name in STUDY.figures:

    rule:
        name:
            f"figure_{name}"
        input:
            TABLES,
            records=RECORDS,
        output:
            report(
                RESULTS / f"figures/{name}.png",
                caption=caption(name),
                category=catalogue.figure(name).category,
                labels={"figure": catalogue.figure(name).title},
            ),
            RESULTS / f"figures/{name}.svg",
        log:
            RESULTS / f"logs/figure-{name}.log",
        benchmark:
            RESULTS / f"benchmarks/figure-{name}.tsv"
        resources:
            mem_mb=2000,
            runtime=30,
        params:
            sources=source_hash("figure", name),
            name=name,
            results=RESULTS,
            folder=RESULTS / "figures",
        shell:
            "subslide figure {params.name:q} --results {params.results:q} -o {params.folder:q} > {log:q} 2>&1"
