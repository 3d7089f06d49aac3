# Report: Snakemake's own, made by a second Snakemake once everything it shows is there.
import os

CONFIG_FILES = workflow.overwrite_configfiles or ["config/paper.yaml"]  # no parameter: its form may vary


rule shown:
    input:
        ALL_TABLES,
        FIGURES,


rule report:
    input:
        rules.shown.input,
        captions=[os.path.relpath(path) for path in sorted(CAPTIONS.glob("*.rst"))],
    output:
        RESULTS / "report.html",
    log:
        RESULTS / "logs/report.log",
    benchmark:
        RESULTS / "benchmarks/report.tsv"
    resources:
        mem_mb=1000,
        runtime=30,
    shell:
        "snakemake --nolock --cores 1 --configfile {CONFIG_FILES:q} --report {output:q} -- shown > {log:q} 2>&1"
