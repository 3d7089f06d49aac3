"""The command line, `subslide`: its verbs, and the exit status and one line that each way to fail has."""

import contextlib
import errno
import importlib
import io
import os
import signal
import sys
import traceback

import click

from subslide.commands import MODULES, cli, interrupts
from subslide.files import RecordError, Stopped
from subslide.keys import words
from subslide.keys.schema import ConfigError

BAD_INPUT, FAULT = 2, 1
SIGNALLED = 128
"""Exit status of a command that a signal ends, less the signal's number, as in a shell."""

for module in MODULES:
    importlib.import_module(module)


def main(arguments: list[str] | None = None) -> int:
    """Run the command line.

    Parameters
    ----------
    arguments
        Words after `subslide`; those of the process if None.

    Returns
    -------
    int
        Exit status: 0 done, 2 bad input (one line on stderr), 1 a fault, such as a damaged record, 128 and its number
        after a signal.
    """
    try:
        code = cli.main(arguments, prog_name="subslide", standalone_mode=False)
        return code if isinstance(code, int) else 0
    except click.ClickException as error:
        return _complain(error.format_message(), BAD_INPUT)
    except ConfigError as error:
        return _complain(str(error), BAD_INPUT)
    except RecordError as error:
        return _complain(str(error), FAULT)
    except Stopped as stopped:
        return _complain(stopped.said, SIGNALLED + stopped.signal)
    except click.Abort as abort:
        if isinstance(
            abort.__cause__, EOFError
        ):  # a fault of some file, which click takes for the end of input
            raise abort.__cause__ from None
        return _complain("interrupted; nothing was written", SIGNALLED + signal.SIGINT)
    except OSError as error:
        if error.errno in (errno.ENAMETOOLONG, errno.ELOOP):  # no name that a study gives is so
            return _complain(f"{words.show(error.filename)}: {error.strerror}", BAD_INPUT)
        return _complain(f"{_subject(error)}{error.strerror or error}", FAULT)


def _subject(error: OSError) -> str:
    """Return what an error of the system is about, and a colon; '' if nothing tells."""
    if error.filename is not None:
        return f"{error.filename}: "
    if any(frame.f_code is click.echo.__code__ for frame, _ in traceback.walk_tb(error.__traceback__)):
        return "standard output: "
    try:
        os.getcwd()
    except OSError:
        return "the current folder: "
    return ""


def _complain(message: str, code: int) -> int:
    """Print a message as one line on stderr, and return the exit status."""
    print(words.printable(f"subslide: {message}"), file=sys.stderr)
    return code


class Diagnostics(io.TextIOWrapper):
    """Standard error, whose faults are nobody's to hear of: a line that cannot be written is lost."""

    def write(self, text: str) -> int:
        """Write a text if that is possible, and return its length."""
        with contextlib.suppress(OSError):
            super().write(text)
        return len(text)


def _open_streams() -> None:
    """Put /dev/null in place of closed streams, lest a file get their numbers, and print what a locale lacks as '?'."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # it gets the lowest number that is free
    if sys.stdout is None:
        sys.stdout = os.fdopen(1, "w", encoding="utf-8", closefd=False)
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="replace")
    encoding = sys.stderr.encoding if sys.stderr else "utf-8"
    raw = os.fdopen(2, "wb", buffering=0, closefd=False)
    sys.stderr = Diagnostics(raw, encoding=encoding, errors="replace", write_through=True)


def entry() -> None:
    """End the process at once with the status of `main`: tearing down compiled code takes longer than a radial run."""
    _open_streams()
    interrupts.listen()
    status = main()
    try:
        sys.stdout.flush()
    except BrokenPipeError:
        pass
    except OSError as error:
        status = _complain(f"standard output: {error.strerror}", FAULT)
    os._exit(status)


if __name__ == "__main__":
    entry()
