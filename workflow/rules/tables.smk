# Tables: a rule for each that the study is to have, made from records, from other tables, or by runs of its own.

TABLES = {name: [RESULTS / "tables" / file for file in files] for name, files in STAGED.tables.items()}
SEALED_TABLES = [file for paths in TABLES.values() for file in sealed(*paths)]


def caption(name):
    """Return the path of the caption of a table or figure, or None."""
    path = CAPTIONS / f"{name}.rst"
    return str(path) if path.exists() else None


def made_from(name):
    """Return the files that a table is made from, with their checksums."""
    about = catalogue.table(name)
    files = [path for other in about.reads for path in TABLES.get(other, [])]
    return [*POINTS, *(SEALED_RECORDS if "records" in about.reads else []), *sealed(*files)]


def in_report(name, path):
    """Return the path of a table's file, marked for Snakemake's report if the table has a caption."""
    if not caption(name):
        return path
    about = catalogue.table(name)
    part = "page" if path.suffix == ".html" else path.stem
    labels = {"figure": about.title if part == name else f"{about.title}: {part}"}
    return report(path, caption=caption(name), category=about.category, labels=labels)


def whole(name):
    """Return whether the files of a table are as they were written, by the same sources."""
    return staging.are_whole(TABLES[name], sources=source_hash("table", name))


for name in TABLES:

    rule:
        name:
            f"table_{name}"
        input:
            made_from(name),
            stamp=stamp(f"table-{name}", TABLES[name], lambda: whole(name)),
        output:
            [in_report(name, path) for path in TABLES[name]],
            [checksums.beside(path) for path in TABLES[name]],
        log:
            RESULTS / f"logs/table-{name}.log",
        benchmark:
            RESULTS / f"benchmarks/table-{name}.tsv"
        resources:
            mem_mb=2000,
            runtime=60,
        params:
            name=remembered(name, "table", name),
            results=subpath(output[0], ancestor=2),
        shell:
            "logged {log:q} subslide table {params.name[0]:q} {params.results:q}"
