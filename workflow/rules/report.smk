# Report: one page of what the study found, for a browser without a network.


rule report:
    input:
        POINTS,
        SEALED_TABLES,
        SEALED_FIGURES,
        stamp=stamp(
            "report",
            [RESULTS / "report.html"],
            lambda: staging.are_whole([RESULTS / "report.html"], sources=source_hash("page", "report")),
        ),
    output:
        page=RESULTS / "report.html",
        checksum=checksums.beside(RESULTS / "report.html"),
    log:
        RESULTS / "logs/report.log",
    benchmark:
        RESULTS / "benchmarks/report.tsv"
    resources:
        mem_mb=1000,
        runtime=30,
    params:
        results=subpath(output[0], parent=True),
        sources=remembered("", "page", "report"),
    shell:
        "logged {log:q} subslide report {params.results:q} -o {output.page:q}"
