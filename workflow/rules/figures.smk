# Figures: each is drawn from the tables and records alone; tables made of other tables are for reading.

FIGURES = [RESULTS / f"figures/{name}.{kind}" for name in STUDY.figures for kind in ("png", "svg")]
DRAWN = [
    path
    for name, paths in TABLES.items()
    for path in paths
    if "records" in catalogue.table(name).reads or not catalogue.table(name).reads
]


for name in STUDY.figures:

    rule:
        name:
            f"figure_{name}"
        input:
            DRAWN,
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
            "logged {log:q} subslide figure {params.name:q} --results {params.results:q} -o {params.folder:q}"
