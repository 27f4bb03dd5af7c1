"""Pictures of drafts, made by processes of their own so that a page never waits for geometry.

    async with Pictures() as pictures:
        picture = await pictures.ask(draft, View("three"))
        if picture is not None and picture.svg: ...

Of several asks in one lane the newest counts: what waits before it is dropped, and answered with None. What
is under way is finished, so that a slider that is dragged shows pictures as it goes, unless it takes long. A
process that dies costs one picture, and is made again; so it is with one that was asked to stop, or took too
long. Processes hear nothing of Ctrl-C, and end where this one does.
"""

from __future__ import annotations

import asyncio
import contextlib
import multiprocessing
import signal
import time
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import field
from multiprocessing.connection import Connection
from typing import Any

from batik_vector.errors import Fault
from batik_vector.studio.drafts import Draft
from batik_vector.studio.views import View
from batik_vector.studio.worker import Answer, answer_of, request_of, serve
from batik_vector.values import frozen

LIMIT = 30.0
"""Seconds that a picture may take, unless an ask says otherwise."""
PATIENCE = 2.0
"""Seconds after which what is under way makes room for a newer ask of its lane."""


@frozen(eq=False)
class Picture:
    """What came of an ask: a picture, or why there is none.

    Args:
        draft, view: what was asked for.
        svg: the picture, in UTF-8; empty where there are faults.
        facts: what is known of the pattern: ``title``, ``cell_mm``, ``vertices``, ``layers`` with ``ink``,
            ``colour``, ``areas``, ``lines``; ``size_mm`` that the picture shows; ``warnings``.
        verdict: the certificate as ``check --json`` has it (``passed``, ``faults``), where it was asked for.
        faults: what is wrong, with keys and lines.
        seconds: the compiling process was at it.
        waited: seconds from the ask to the answer.
    """

    draft: Draft
    view: View
    svg: bytes = b""
    facts: Mapping[str, Any] = field(default_factory=dict)
    verdict: Mapping[str, Any] = field(default_factory=dict)
    faults: tuple[Fault, ...] = ()
    seconds: float = 0.0
    waited: float = 0.0


class Pictures:
    """Makes pictures; close it at the end, or use it with ``async with``."""

    def __init__(self, *, limit: float = LIMIT) -> None:
        """Make ready; processes are started by the first ask, or by :meth:`warm`.

        Args:
            limit: seconds that a picture may take.
        """
        self._limit = limit
        self._threads = ThreadPoolExecutor(4, thread_name_prefix="batik-pictures")
        # One process serves what is looked at, the other one all that may wait.
        self._hands = {False: _Hand(), True: _Hand()}
        self._turns: dict[bool, asyncio.Lock] = {}
        self._newest: dict[str, int] = {}
        self._running: dict[str, tuple[_Hand, float]] = {}
        self._closed = False

    async def warm(self) -> None:
        """Start the process that serves what is looked at, and wait until it is ready."""
        await self.ask(Draft(""), View(), lane="\0warm")

    async def ask(
        self,
        draft: Draft,
        view: View | None = None,
        *,
        lane: str = "",
        background: bool = False,
        limit: float | None = None,
        tell: Callable[[str], None] | None = None,
    ) -> Picture | None:
        """Return the picture of a draft, or None where a newer ask of the lane came before it was begun.

        Args:
            draft: to be looked at.
            view: how; the tile when left out.
            lane: asks of one lane follow one another; the newest counts.
            background: for what may wait, such as a sheet of thumbnails: nothing that is looked at waits for
                it.
            limit: seconds that it may take.
            tell: called with the stage of work that takes long, in the loop of the caller.
        """
        view = view or View()
        begun = time.perf_counter()
        ticket = self._newest[lane] = self._newest.get(lane, 0) + 1
        self._make_room(lane)
        turn = self._turns.setdefault(background, asyncio.Lock())
        async with turn:
            if self._newest[lane] != ticket or self._closed:
                return None
            hand = self._hands[background]
            self._running[lane] = hand, time.perf_counter()
            try:
                answer = await self._answered(hand, draft, view, limit or self._limit, tell)
            finally:
                del self._running[lane]
        faults = answer.faults
        if answer.defect:
            faults = (Fault("could not be drawn, by a defect of this program: " + _last(answer.defect)),)
        return Picture(
            draft,
            view,
            answer.svg,
            answer.facts,
            answer.verdict,
            faults,
            answer.seconds,
            time.perf_counter() - begun,
        )

    def cancel(self, lane: str = "") -> None:
        """Stop what is under way in a lane, which is answered with a fault, and drop what waits."""
        self._newest[lane] = self._newest.get(lane, 0) + 1
        if lane in self._running:
            self._running[lane][0].stop("cancelled")

    def _make_room(self, lane: str) -> None:
        """See to it that what takes long does not keep a newer ask waiting."""
        if lane not in self._running:
            return
        hand, since = self._running[lane]
        left = PATIENCE - (time.perf_counter() - since)
        number = hand.number
        loop = asyncio.get_running_loop()
        loop.call_later(max(left, 0), lambda: hand.stop("a newer one was asked for", number))

    async def _answered(
        self, hand: _Hand, draft: Draft, view: View, limit: float, tell: Callable[[str], None] | None
    ) -> Answer:
        loop = asyncio.get_running_loop()

        def say(stage: str) -> None:
            if tell is not None:
                loop.call_soon_threadsafe(tell, stage)

        hand.number += 1
        number = hand.number
        words = f"took longer than {limit:g} s and was stopped"
        alarm = loop.call_later(limit, lambda: hand.stop(words, number))
        work = loop.run_in_executor(self._threads, hand.exchange, request_of(draft, view), say)
        try:
            return await asyncio.shield(work)
        except asyncio.CancelledError:
            hand.stop("cancelled", number)
            with contextlib.suppress(asyncio.CancelledError):
                await work
            raise
        finally:
            alarm.cancel()
            hand.number += 1

    def close(self) -> None:
        """End all processes, at once."""
        self._closed = True
        for hand in self._hands.values():
            hand.end()
        self._threads.shutdown(wait=False)

    async def __aenter__(self) -> Pictures:
        return self

    async def __aexit__(self, *_: object) -> None:
        self.close()


class _Hand:
    """A process and the pipe to it; it is made when it is needed, and made again where it has gone."""

    def __init__(self) -> None:
        self._context = multiprocessing.get_context("spawn")
        self._process: Any = None
        self._pipe: Connection | None = None
        self._reason = ""
        self._ended = False
        self.number = 0
        """Changes with every piece of work, so that none is stopped on behalf of another."""

    def exchange(self, request: bytes, tell: Callable[[str], None]) -> Answer:
        """Have a picture made. Runs in a thread."""
        self._reason = ""
        try:
            pipe = self._open()
            pipe.send_bytes(request)
            while (answer := answer_of(pipe)).stage:
                tell(answer.stage)
        except (EOFError, OSError):
            return Answer(faults=(Fault(self._gone()),))
        return answer

    def _open(self) -> Connection:
        if self._ended:
            raise EOFError
        if self._pipe is None or self._process is None or not self._process.is_alive():
            mine, theirs = self._context.Pipe()
            with _deaf():
                self._process = self._context.Process(target=serve, args=(theirs,), daemon=True)
                self._process.start()
            theirs.close()
            self._pipe = mine
        return self._pipe

    def _gone(self) -> str:
        """Return in words why there is no answer, and be ready to begin anew."""
        process, self._process = self._process, None
        pipe, self._pipe = self._pipe, None
        if pipe is not None:
            pipe.close()
        if process is not None:
            process.join()
        if self._reason:
            return self._reason
        code = process.exitcode if process is not None else None
        return f"the process that drew it ended ({code}), perhaps for want of memory; the draft is kept"

    def stop(self, reason: str, number: int | None = None) -> None:
        """End the process, unless it is at other work by now."""
        if self._process is None or (number is not None and number != self.number):
            return
        self._reason = reason
        self._process.kill()

    def end(self) -> None:
        """End the process for good."""
        self._ended = True
        self.stop("the studio was closed")


@contextlib.contextmanager
def _deaf() -> Iterator[None]:
    """Let what is started inside not hear Ctrl-C, which goes to all processes of a terminal."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _last(defect: str) -> str:
    return defect.strip().splitlines()[-1][:200]
