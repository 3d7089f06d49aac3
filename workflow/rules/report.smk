# Report: one page of what the study found, for a browser without a network.


rule report:
    input:
        SEALED_TABLES,
        FIGURES,
        captions=sorted(CAPTIONS.glob("*.rst")),
    output:
        RESULTS / "report.html",
    log:
        RESULTS / "logs/report.log",
    benchmark:
        RESULTS / "benchmarks/report.tsv"
    resources:
        mem_mb=1000,
        runtime=30,
    params:
        sources=source_hash("page", "report"),
        results=RESULTS,
        captions=CAPTIONS,
    shell:
        "logged {log:q} subslide report {params.results:q} --captions {params.captions:q} -o {output:q}"
