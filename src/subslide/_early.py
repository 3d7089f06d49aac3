"""Signals that come while a command still loads: they end it with the line that it would say later.

The package imports this module before any other, and it imports nothing that takes time.
"""

import os
import signal
import sys
from types import FrameType

SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
PYTHONS_OWN = (signal.SIG_DFL, signal.default_int_handler)


def end(number: int, frame: FrameType | None) -> None:
    """End the process at once: nothing has been done.

    Parameters
    ----------
    number
        The signal.
    frame
        Where it came.
    """
    os.write(2, b"subslide: interrupted; nothing was written\n")
    os._exit(128 + number)


def listen() -> None:
    """End the process at a signal from here on if it is a command of ours, and not a program that imports us."""
    if os.path.basename(sys.argv[0]) not in ("subslide", "-m"):
        return
    for number in SIGNALS:
        if signal.getsignal(number) in PYTHONS_OWN:
            signal.signal(number, end)


listen()
