# For whoever starts Snakemake here; the workflow lies where Snakemake's catalogue looks for it.
include: "workflow/Snakefile"


workflow.default_target = "all"  # what is included gives none
