"""Signals that end a command soon and cleanly: Ctrl-C, SIGTERM and SIGHUP, wherever it is.

Python hears a signal in the main thread, between two of its instructions. A compiler or a compiled loop may keep it
from that for long, so a second thread is woken by the signal itself; it gives the main thread time to unwind, and ends
the process if that does not happen.
"""

import contextlib
import os
import signal
import sys
import threading
import time
from types import FrameType
from typing import Any, NoReturn

from subslide import _early
from subslide.files import Stopped, unfinished

GRACE = 2.0
"""Seconds in which the main thread must hear of a signal."""

UNWINDING = 8.0
"""Seconds in which it must end after it has heard."""

WRITING = 60.0
"""Seconds that it has instead while it writes a file, such as what a batch has solved."""

_heard = threading.Event()


def listen() -> None:
    """Make SIGTERM and SIGHUP exceptions of the main thread, as Ctrl-C is, and see that the process ends soon.

    A signal that the parent has made this process ignore, as `nohup` does, stays ignored.
    """
    reader, writer = os.pipe()
    os.set_blocking(writer, False)
    signal.set_wakeup_fd(writer, warn_on_full_buffer=False)
    for number in _early.SIGNALS:
        if signal.getsignal(number) in (*_early.PYTHONS_OWN, _early.end):
            signal.signal(number, _hear)
    sys.unraisablehook = _lost
    threading.Thread(target=_watch, args=(reader,), daemon=True).start()


def end_with_input() -> None:
    """End as after SIGTERM once standard input ends: the program that holds it is gone, and nobody waits."""
    threading.Thread(target=_listen_to_input, daemon=True).start()


def _listen_to_input() -> None:
    """Wait for the end of standard input."""
    with contextlib.suppress(OSError):
        while os.read(0, 1024):
            pass
    os.kill(os.getpid(), signal.SIGTERM)


def _hear(number: int, frame: FrameType | None) -> NoReturn:
    """Raise what a signal means."""
    _heard.set()
    raise KeyboardInterrupt if number == signal.SIGINT else Stopped(number)


def _lost(unraisable: Any) -> None:
    """Raise a signal once more whose exception was lost in a callback, which nothing can leave."""
    error = unraisable.exc_value
    if isinstance(error, KeyboardInterrupt | Stopped):
        number = error.signal if isinstance(error, Stopped) else signal.SIGINT
        main = threading.main_thread().ident or 0
        threading.Timer(0.05, signal.pthread_kill, (main, number)).start()
    else:
        sys.__unraisablehook__(unraisable)


def _watch(reader: int) -> None:
    """Wait for a signal; end the process if it still runs some time later."""
    number = os.read(reader, 1)[0]
    if _heard.wait(GRACE):
        started = time.monotonic()
        while time.monotonic() - started < (WRITING if unfinished else UNWINDING):
            time.sleep(0.1)
    for path in list(unfinished):
        with contextlib.suppress(OSError):
            path.unlink()
    with contextlib.suppress(OSError):
        os.write(2, b"subslide: interrupted; nothing was written\n")
    os._exit(128 + number)
