# Reads the configuration, plans the study, includes the rules and names the targets.
import os
import sys
from pathlib import Path

from snakemake.exceptions import WorkflowError

from subslide import catalogue, checksums, source_hash, tables
from subslide.keys.schema import ConfigError
from subslide.keys.words import printable
from subslide.study import asked, locks, numbering, plan, progress, staging
from subslide.study.config import make_study
from subslide.tables._write import remove as remove_table


report: "workflow/report/workflow.rst"


BASE = Path(os.path.relpath(str(workflow.current_basedir)))  # a study may be moved with its workflow

PREFIX = workflow.modifier.path_modifier
ARGUMENTS = workflow.config_settings.config_args

MOST_AT_ONCE = 100  # jobs that new points are shared out to; Snakemake's number has no end on some clusters

# Where nothing is shared with them, jobs are sent what they read with the sources, and times tell nothing.
CARRIED = workflow.storage_settings.default_storage_provider is not None

# The file is read by our own strict reader: Snakemake's takes the last of two equal keys, and 0200 for 128.
# A job that Snakemake starts elsewhere reads this file too: it has the plan that it was started with, and plans nothing.
if workflow.is_main_process:
    try:
        if workflow.modifier.skip_configfile:  # imported as a module, which has its configuration from there
            VALUES = config
        else:
            VALUES = asked.values(workflow.overwrite_configfiles, ARGUMENTS, BASE / "config/paper.yaml")
        STUDY = make_study(VALUES)
        if PREFIX.prefix or PREFIX._prefix_replacements:
            raise ConfigError(
                "prefix: is not allowed; allowed: a module without, whose results lie in results/"
            )
        RESULTS = Path("results", STUDY.name)
        HOME = Path(".snakemake/subslide", STUDY.name)
        plan.check_folders(RESULTS, HOME)
        SIZE = workflow.resource_settings
        PLAN = plan.plan(STUDY, RESULTS, min(SIZE.nodes or SIZE.cores or 1, MOST_AT_ONCE))
        STAGED = staging.stage(PLAN, HOME, tables.of_study(STUDY), STUDY.figures)
        locks.hold(HOME)
    except ConfigError as error:
        raise WorkflowError(f"configuration: {printable(str(error))}") from None
    except OSError as error:  # a full disk, say
        raise WorkflowError(f"planning: {error.filename}: {error.strerror}") from None
    workflow.config_settings.config_args = [*ARGUMENTS, f"{asked.KEY}={STAGED.path}"]
    if CARRIED:
        captions = (BASE / "workflow/report").glob("*.rst")
        carried = [STAGED.path, STAGED.points_file, *filter(Path.exists, STAGED.specs.values()), *captions]
        workflow.configfiles += map(str, carried)
    for line in PLAN.faults:
        print(line, file=sys.stderr)
else:
    STAGED = staging.staged(asked.plan_file(ARGUMENTS))
    RESULTS, HOME = Path("results", STAGED.study), STAGED.home


include: "workflow/rules/solve.smk"
include: "workflow/rules/tables.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/report.smk"


rule all:
    default_target: True
    input:
        rules.report.output,
        SEALED_TABLES,
        RECORDS,
        rules.points.output,
        SEALED_FIGURES,


# One line for the whole study takes the place of Snakemake's for each job, which its own log has.
if workflow.is_main_process:
    REPORTER = progress.Reporter(HOME, PLAN.to_solve)


onstart:
    for handler in logger.handlers:
        if handler.name == "DefaultStreamHandler" and not workflow.output_settings.verbose:
            handler.addFilter(REPORTER.shows)
            REPORTER.start()
    locks.sign(HOME)
    numbering.keep(RESULTS, PLAN.next_run)
    staging.tidy(
        RESULTS, STAGED, map(Path, [*RECORDS, *SEALED_TABLES, *SEALED_FIGURES, *rules.report.output])
    )
    staging.forget(RESULTS, (batch for batch in PLAN.batches.values() if batch.text))
    # tables that the study had before, and has no more, would be read as if they were its own
    for name in set(catalogue.names("tables")) - set(TABLES):
        remove_table(name, RESULTS)


onsuccess:
    REPORTER.stop()
    # runs of batches that were killed and shared out anew, whose files no batch has to itself
    left = (
        batch for name, batch in PLAN.batches.items() if not (RESULTS / f"batches/{name}.json").exists()
    )
    staging.forget(RESULTS, left)


onerror:
    REPORTER.stop()
