# Validates the configuration, plans the study, includes the rules and names the targets.
from pathlib import Path

from snakemake.exceptions import WorkflowError

from subslide import catalogue, source_hash, tables
from subslide.keys.schema import ConfigError
from subslide.study import batches
from subslide.study.config import make_study


report: "workflow/report/workflow.rst"


if not workflow.overwrite_configfiles:  # never merged with a file that the user gives

    configfile: "config/paper.yaml"


try:
    STUDY = make_study(config)
except ConfigError as error:
    raise WorkflowError(f"configuration: {error}") from None

RESULTS = Path("results", STUDY.name)
PLAN = batches.plan(STUDY, RESULTS, extend=workflow.is_main_process)


include: "workflow/rules/solve.smk"
include: "workflow/rules/tables.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/report.smk"


rule all:
    default_target: True
    input:
        rules.report.output,
        ALL_TABLES,
        RECORDS,
        CHECKSUMS,
        FIGURES,
