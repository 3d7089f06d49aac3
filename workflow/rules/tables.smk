# Tables: a rule for each that the study is to have, made from records, from other tables, or by runs of its own.

TABLES = {
    name: [RESULTS / "tables" / file for file in tables.files(name, len(STUDY.points))]
    for name in catalogue.names("tables")
    if not tables.load(name).needs(STUDY)
}
ALL_TABLES = [path for paths in TABLES.values() for path in paths]
CAPTIONS = Path(workflow.basedir, "workflow/report")


def caption(name):
    """Return the path of the caption of a table or figure, or None."""
    path = CAPTIONS / f"{name}.rst"
    return str(path) if path.exists() else None


def made_from(name):
    """Return the files that a table is made from."""
    about = catalogue.table(name)
    records = [RESULTS / "points.json", *RECORDS] if "records" in about.reads else []
    kernels = [RESULTS / f"kernels/{kernels.replace(':', '_')}.done" for kernels in about.kernels]
    return [*records, *kernels, *(path for other in about.reads for path in TABLES.get(other, []))]


def in_report(name, path):
    """Return the path of a table's file, marked for the report if the table has a caption."""
    if not caption(name):
        return path
    about = catalogue.table(name)
    labels = {"figure": about.title if path.suffix != ".html" else f"{about.title}: page"}
    return report(path, caption=caption(name), category=about.category, labels=labels)


# Tables that the study had before, and has no more, would be read as if they were its own.
if workflow.is_main_process and not DRY_RUN:
    for name in set(catalogue.names("tables")) - set(TABLES):
        for path in (RESULTS / "tables").glob(f"{name}.*"):
            path.unlink()

for name in TABLES:

    rule:
        name:
            f"table_{name}"
        input:
            made_from(name),
        output:
            [in_report(name, path) for path in TABLES[name]],
        log:
            RESULTS / f"logs/table-{name}.log",
        benchmark:
            RESULTS / f"benchmarks/table-{name}.tsv"
        resources:
            mem_mb=2000,
            runtime=60,
        params:
            sources=source_hash("table", name),
            name=name,
            results=RESULTS,
        shell:
            "subslide table {params.name:q} {params.results:q} > {log:q} 2>&1"
