"""The command line, `subslide`: its verbs, and the exit status and one line that each way to fail has."""

import importlib
import io
import os
import signal
import sys

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
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except OSError as error:
        return _complain(f"{error.filename or 'output'}: {error.strerror or error}", FAULT)


def _complain(message: str, code: int) -> int:
    """Print a message as one line on stderr, and return the exit status."""
    print(words.printable(f"subslide: {message}"), file=sys.stderr)
    return code


def entry() -> None:
    """End the process at once with the status of `main`: tearing down compiled code takes longer than a radial run."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")  # a locale may lack the letters of a line
    interrupts.listen()
    status = main()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)


if __name__ == "__main__":
    entry()
