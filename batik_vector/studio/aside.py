"""A process beside the studio for what may take long or crash: small pictures, and files from outside.

What is asked runs there, one thing after the other, and has a time limit. A process that dies, or is past its
limit, costs what it was at, and is made again.
"""

from __future__ import annotations

import asyncio
import multiprocessing
import os
import signal
import threading
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from typing import ParamSpec, TypeVar

from batik_vector.errors import BatikError

P = ParamSpec("P")
T = TypeVar("T")


class Aside:
    """One process, started when it is first needed."""

    def __init__(self, *, yields: bool = False) -> None:
        """Make ready.

        Args:
            yields: whether it works when no other process wants to, where the system can tell.
        """
        self._yields = yields
        self._pool: ProcessPoolExecutor | None = None
        self._turn = asyncio.Lock()
        self._ended = False

    async def run(self, patience: float, function: Callable[P, T], *args: P.args, **kwargs: P.kwargs) -> T:
        """Return what a function of a module returns there.

        Args:
            patience: seconds that it may take.
            function: with arguments that can be sent.

        Raises:
            BatikError: where it takes longer, or the process dies, or what the function raises.
        """
        async with self._turn:
            if self._ended:
                raise BatikError("the studio was closed")
            if self._pool is None:
                context = multiprocessing.get_context("spawn")
                self._pool = ProcessPoolExecutor(1, context, _begin, (self._yields,))
            work = asyncio.wrap_future(self._pool.submit(function, *args, **kwargs))
            try:
                return await asyncio.wait_for(work, patience)
            except TimeoutError as error:
                self.close()
                raise BatikError(f"took longer than {patience:g} s and was stopped") from error
            except BrokenProcessPool as error:
                self.close()
                raise BatikError("could not be read: the process that read it ended") from error

    def close(self) -> None:
        """End the process, whatever it is at."""
        pool, self._pool = self._pool, None
        if pool is not None:
            for process in list((pool._processes or {}).values()):
                process.kill()
            pool.shutdown(wait=False, cancel_futures=True)

    def end(self) -> None:
        """End the process for good."""
        self._ended = True
        self.close()


def _begin(yields: bool) -> None:
    """Be deaf to Ctrl-C, and end with the studio, however that ends."""
    if yields and hasattr(os, "nice"):
        os.nice(5)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()

    def wait() -> None:
        # Whoever holds a queue never hears that the other end has gone.
        if parent is not None:
            parent.join()
            os._exit(0)

    threading.Thread(target=wait, daemon=True).start()
