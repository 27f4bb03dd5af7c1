"""Ctrl-C and SIGTERM, heard at once whatever the program is at.

Python lets a handler run between two steps of its own code, and an overlay of GEOS is one step, which may
take minutes. So a thread listens too: the system writes each signal into a pipe that it reads, and where the
handler has not ended the process in ``GRACE`` seconds the thread does. GEOS, NumPy and cairo let threads run
while they work.
"""

from __future__ import annotations

import _thread
import contextlib
import os
import signal
import sys
import time
from collections.abc import Callable
from typing import NoReturn

EXITS = {signal.SIGINT: 130, signal.SIGTERM: 143}
"""What the process ends with, as shells have it: 128 and the signal's number."""

GRACE = 0.5
"""Seconds in which the main thread may end the process in its own way."""


def end_on_sigterm() -> None:
    """Make SIGTERM an exception as Ctrl-C is, so that what is half done can be cleared away."""
    signal.signal(signal.SIGTERM, _terminated)


def _terminated(_number: int, _frame: object) -> NoReturn:
    raise SystemExit(EXITS[signal.SIGTERM])


def listen(say: Callable[[int], None]) -> None:
    """End the process soon after a signal, even where the main thread cannot hear it.

    Args:
        say: called with the number of the signal before the process is ended from here.
    """
    heard, told = os.pipe()
    os.set_blocking(told, False)
    signal.set_wakeup_fd(told, warn_on_full_buffer=False)
    # Threads that ``threading`` counts may import what others are importing; this one imports nothing.
    _thread.start_new_thread(_listen, (heard, say))


def _listen(heard: int, say: Callable[[int], None]) -> None:
    while True:
        for number in os.read(heard, 64):
            if number in EXITS:
                time.sleep(GRACE)
                _end(number, say)


def _end(number: int, say: Callable[[int], None]) -> NoReturn:
    # Where that has not been imported nothing is being written, and to import may wait for what works.
    files = sys.modules.get("batik_vector.export.files")
    with files.abandoned() if files else contextlib.nullcontext():
        say(number)
        os._exit(EXITS[signal.Signals(number)])
