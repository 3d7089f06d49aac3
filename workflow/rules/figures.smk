# Figures: each is drawn from the tables and records alone; tables made of other tables are for reading.

SEALED_FIGURES = [
    file
    for name in STAGED.figures
    for file in sealed(*(RESULTS / f"figures/{name}.{kind}" for kind in ("png", "svg")))
]
DRAWN = [
    file
    for name, paths in TABLES.items()
    for file in sealed(*paths)
    if "records" in catalogue.table(name).reads or not catalogue.table(name).reads
]


def drawn(name):
    """Return the files of a figure, and a function that tells whether they are whole and of the same sources."""
    files = [RESULTS / f"figures/{name}.{kind}" for kind in ("png", "svg")]
    return files, lambda: staging.are_whole(files, sources=source_hash("figure", name))


for name in STAGED.figures:

    rule:
        name:
            f"figure_{name}"
        input:
            POINTS,
            DRAWN,
            records=SEALED_RECORDS,
            stamp=stamp(f"figure-{name}", *drawn(name)),
        output:
            report(
                RESULTS / f"figures/{name}.png",
                caption=caption(name),
                category=catalogue.figure(name).category,
                labels={"figure": catalogue.figure(name).title},
            ),
            RESULTS / f"figures/{name}.svg",
            [RESULTS / f"figures/{name}.{kind}.sha256" for kind in ("png", "svg")],
        log:
            RESULTS / f"logs/figure-{name}.log",
        benchmark:
            RESULTS / f"benchmarks/figure-{name}.tsv"
        resources:
            mem_mb=2000,
            runtime=30,
        params:
            name=remembered(name, "figure", name),
            results=subpath(output[0], ancestor=2),
            folder=subpath(output[0], parent=True),
        shell:
            "logged {log:q} subslide figure {params.name[0]:q} --results {params.results:q} -o {params.folder:q}"
