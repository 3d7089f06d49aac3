# Records: one job solves the points of one batch.

import re
import sys
from shlex import quote

RECORDS = [RESULTS / f"records/{batch}.nc" for batch in PLAN.batches]
CHECKSUMS = [f"{record}.sha256" for record in RECORDS]
DRY_RUN = any(re.fullmatch("-n[a-z]*|--dry-?run", word) for word in sys.argv)

# Jobs find the commands of the virtual environment that Snakemake itself runs in.
shell.prefix(f"set -euo pipefail; export PATH={quote(str(Path(sys.executable).parent))}:$PATH; ")

if workflow.is_main_process:
    for record in batches.damaged(RESULTS, PLAN.batches):
        print(f"{record} does not match its checksum: it is deleted and solved again", file=sys.stderr)
        if not DRY_RUN:
            record.unlink()


# One job compiles what several would otherwise compile at once. A batch names its kernels for good, and they change
# with their sources alone, so this input never asks for a batch that need not run again. It must not be `ancient`:
# when Snakemake (9.27) runs this rule it then leaves out the batches, although their own sources have changed.
rule warm:
    output:
        touch(RESULTS / "kernels/{kernels}.done"),
    log:
        RESULTS / "logs/kernels-{kernels}.log",
    benchmark:
        RESULTS / "benchmarks/kernels-{kernels}.tsv"
    resources:
        mem_mb=1500,
        runtime=30,
    params:
        sources=source_hash("solver"),
        kernels=lambda wildcards: wildcards.kernels.replace("_", ":"),
    shell:
        "subslide warm {params.kernels:q} > {log:q} 2>&1"


rule batch:
    input:
        spec=RESULTS / "batches/{batch}.json",
        kernels=lambda wildcards: RESULTS / f"kernels/{PLAN.batches[wildcards.batch].replace(':', '_')}.done",
    output:
        record=RESULTS / "records/{batch}.nc",
        checksum=RESULTS / "records/{batch}.nc.sha256",
    log:
        RESULTS / "logs/batch-{batch}.log",
    benchmark:
        RESULTS / "benchmarks/batch-{batch}.tsv"
    wildcard_constraints:
        batch=r"\d+",
    threads: 1
    resources:
        mem_mb=2000,
        runtime=120,
    params:
        sources=source_hash(),
    shell:
        "subslide batch {input.spec:q} --threads {threads} -o {output.record:q} > {log:q} 2>&1"
