# What rules share: shell, checksums, and when a job starts again.
from shlex import quote

# Jobs find the commands of the virtual environment that Snakemake itself runs in; what a failed one said last is shown.
shell.prefix(
    f"set -euo pipefail; export PATH={quote(str(Path(sys.executable).parent))}:$PATH; "
    'logged() {{ log=$1; shift; "$@" > "$log" 2>&1 || '
    '{{ code=$?; echo "$log:" >&2; tail -n 5 "$log" >&2; exit $code; }}; }}; '
)


def sealed(*paths):
    """Return the paths of files, each with that of its checksum."""
    return [file for path in paths for file in (path, checksums.beside(path))]


def stamp(name, outputs, whole, rank=0):
    """Return the input by which a job starts again where what it made is not whole, as `whole()` tells."""
    if CARRIED:
        return []
    return staging.stamp(HOME, name, outputs, whole(), rank) if workflow.is_main_process else HOME / name


def remembered(path, part="record", name=""):
    """Return a path and a hash of sources as Snakemake remembers them of a job, if no stamp tells when to do it again.

    It remembers texts of params, and no paths.
    """
    return (str(path), source_hash(part, name)) if CARRIED else (path, None)
