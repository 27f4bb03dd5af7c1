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
import time
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import field
from multiprocessing.connection import Connection
from typing import Any

from batik_vector.errors import Fault
from batik_vector.making.pool import deaf
from batik_vector.studio.asking import View, Wishes
from batik_vector.studio.drafts import Draft
from batik_vector.studio.worker import BEGUN, Answer, answer_of, request_of, serve
from batik_vector.values import frozen

LIMIT = 30.0
"""Seconds that a picture may take, unless an ask says otherwise."""
STARTING = 60.0
"""Seconds besides that its process may take to start: that is no fault of the picture."""
EXPORT_LIMIT = 600.0
"""Seconds that an export may take."""
FRONT, BACK, DETAIL, EXPORTING = "front", "back", "detail", "export"
EXPORT = "\0export"
"""The lane of exports, for :meth:`Pictures.cancel`."""
PATIENCE, USUAL = 2.0, 3.0
"""Seconds after which what is under way makes room for a newer ask of its lane, or so many times what the
last one took: on a machine that has much to do, whoever is ended sooner would never be done."""


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


@frozen(eq=False)
class Export:
    """The files of a draft by their names, the command's report of them, or why there are none."""

    files: Mapping[str, bytes] = field(default_factory=dict)
    report: Mapping[str, Any] = field(default_factory=dict)
    faults: tuple[Fault, ...] = ()
    seconds: float = 0.0


class Pictures:
    """Makes pictures; close it at the end, or use it with ``async with``."""

    def __init__(self, *, limit: float = LIMIT) -> None:
        """Make ready; processes are started by the first ask, or by :meth:`begin`.

        Args:
            limit: seconds that a picture may take.
        """
        self._limit = limit
        self._threads = ThreadPoolExecutor(4, thread_name_prefix="batik-pictures")
        # One process serves what is looked at, one all that may wait, one draws motifs, one makes files.
        kinds = (FRONT, BACK, DETAIL, EXPORTING)
        self._hands = {which: _Hand(spare=which == FRONT) for which in kinds}
        self._turns: dict[str, asyncio.Lock] = {}
        self._newest: dict[str, int] = {}
        self._running: dict[str, _Hand] = {}
        self._took: dict[str, float] = {}
        self._closed = False

    def begin(self) -> None:
        """Start the process that serves what is looked at, so that it is ready when a page is."""
        self._hands[FRONT].begin()

    async def warm(self) -> None:
        """Start the process that serves what is looked at, and wait until it is ready."""
        await self.ask(Draft(""), View(), lane="\0warm")

    async def warm_detail(self) -> None:
        """Start the process that draws motifs alone, and wait until it is ready."""
        await self.ask(Draft(""), View(motif="none"), lane="\0warm-detail")

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
        which = DETAIL if view.motif else BACK if background else FRONT
        found = await self._taken(draft, view, lane, which, limit or self._limit, tell)
        if found is None:
            return None
        waited = time.perf_counter() - begun
        return Picture(
            draft, view, found.svg, found.facts, found.verdict, _faults(found), found.seconds, waited
        )

    async def verdict(self, draft: Draft, *, limit: float | None = None) -> Picture | None:
        """Return the tile at the recipe's own tolerance, with the certificate's verdict and its pointers."""
        view = View(tolerance=0.0, certify=True, pointers=True)
        return await self.ask(draft, view, lane="\0verdict", background=True, limit=limit)

    async def export(
        self,
        draft: Draft,
        wishes: Wishes | None = None,
        *,
        limit: float = EXPORT_LIMIT,
        tell: Callable[[str], None] | None = None,
    ) -> Export:
        """Return the files of a draft: those of the command, byte for byte.

        Args:
            draft, wishes: see :mod:`~batik_vector.studio.exports`.
            limit, tell: see :meth:`ask`; ``cancel(EXPORT)`` stops it.
        """
        wishes = wishes or Wishes()
        # Exports never follow one another by a lane: each is wanted.
        found = await self._taken(draft, wishes, EXPORT, EXPORTING, limit, tell, newest=False)
        if found is None:
            return Export(faults=(Fault("cancelled"),))
        return Export(found.files, found.facts, _faults(found), found.seconds)

    async def _taken(
        self,
        draft: Draft,
        wanted: View | Wishes,
        lane: str,
        which: str,
        limit: float,
        tell: Callable[[str], None] | None,
        newest: bool = True,
    ) -> Answer | None:
        ticket = self._newest.get(lane, 0)
        if newest:
            ticket = self._newest[lane] = ticket + 1
            self._make_room(lane)
        async with self._turns.setdefault(which, asyncio.Lock()):
            if self._newest.get(lane, 0) != ticket or self._closed:
                return None
            hand = self._hands[which]
            self._running[lane] = hand
            try:
                answer = await self._answered(hand, request_of(draft, wanted), limit, tell)
                if not answer.faults:
                    self._took[lane] = answer.seconds
                return answer
            finally:
                del self._running[lane]

    def cancel(self, lane: str = "") -> None:
        """Stop what is under way in a lane, which is answered with a fault, and drop what waits."""
        self._newest[lane] = self._newest.get(lane, 0) + 1
        if lane in self._running:
            self._running[lane].stop("cancelled")

    def _make_room(self, lane: str) -> None:
        """See to it that what takes long does not keep a newer ask waiting."""
        if lane not in self._running:
            return
        hand = self._running[lane]
        patience = max(PATIENCE, USUAL * self._took.get(lane, 0.0))
        number = hand.number
        loop = asyncio.get_running_loop()

        def look() -> None:
            if number != hand.number:
                return
            if (left := patience - hand.worked) > 0:
                loop.call_later(left, look)
            else:
                hand.stop("a newer one was asked for", number)

        look()

    async def _answered(
        self, hand: _Hand, request: bytes, limit: float, tell: Callable[[str], None] | None
    ) -> Answer:
        loop = asyncio.get_running_loop()
        hand.number += 1
        hand.begun = None
        number = hand.number
        words = f"took longer than {limit:g} s and was stopped"
        alarm = loop.call_later(limit + STARTING, lambda: hand.stop(words, number))

        def begin() -> None:
            nonlocal alarm
            if number == hand.number:
                hand.begun = time.perf_counter()
                alarm.cancel()
                alarm = loop.call_later(limit, lambda: hand.stop(words, number))

        def say(stage: str) -> None:
            if stage == BEGUN:
                loop.call_soon_threadsafe(begin)
            elif tell is not None:
                loop.call_soon_threadsafe(tell, stage)

        work = loop.run_in_executor(self._threads, hand.exchange, number, request, say)
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
    """A process and the pipe to it; it is made when it is needed, and made again where it has gone.

    With a spare another one stands ready, as to begin takes a second.
    """

    def __init__(self, spare: bool = False) -> None:
        self._context = multiprocessing.get_context("spawn")
        self._wants_spare = spare
        self._now: _Made | None = None
        self._spare: _Made | None = None
        self._stopped = (-1, "")
        self._ended = False
        self.number = 0
        """Changes with every piece of work, so that none is stopped on behalf of another."""
        self.begun: float | None = None
        """When its process set about the work."""

    @property
    def worked(self) -> float:
        """Seconds that its process has been at the work."""
        return 0.0 if self.begun is None else time.perf_counter() - self.begun

    def exchange(self, number: int, request: bytes, tell: Callable[[str], None]) -> Answer:
        """Have a picture made. Runs in a thread.

        Args:
            number: of this piece of work.
            request: what is sent.
            tell: called with the stage of work that takes long.
        """
        try:
            pipe = self._open()
            # Stopped before it was begun: the process that was ended for it may have been replaced meanwhile.
            if self._stopped[0] == number:
                return Answer(faults=(Fault(self._stopped[1]),))
            pipe.send_bytes(request)
            while (answer := answer_of(pipe)).stage:
                tell(answer.stage)
        except (EOFError, OSError):
            return Answer(faults=(Fault(self._gone(number)),))
        if self._wants_spare and self._spare is None and not self._ended:
            self._spare = self._made()
        return answer

    def begin(self) -> None:
        """Start the process, where that has not been done."""
        self._open()

    def _open(self) -> Connection:
        if self._ended:
            raise EOFError
        if self._now is None or not self._now.process.is_alive():
            self._now, self._spare = self._spare, None
        if self._now is None or not self._now.process.is_alive():
            self._now = self._made()
        return self._now.pipe

    def _made(self) -> _Made:
        mine, theirs = self._context.Pipe()
        with deaf():
            process = self._context.Process(target=serve, args=(theirs,), daemon=True)
            process.start()
        theirs.close()
        return _Made(process, mine)

    def _gone(self, number: int) -> str:
        """Return in words why there is no answer, and be ready to begin anew."""
        gone, self._now = self._now, None
        if gone is not None:
            gone.pipe.close()
            gone.process.join()
        if self._ended:
            return "the studio was closed"
        if self._stopped[0] == number:
            return self._stopped[1]
        code = gone.process.exitcode if gone is not None else None
        return f"the process that drew it ended ({code}), perhaps for want of memory; the draft is kept"

    def stop(self, reason: str, number: int | None = None) -> None:
        """End the process, unless it is at other work by now; what has yet to begin will not."""
        if number is not None and number != self.number:
            return
        self._stopped = self.number, reason
        if self._now is not None:
            self._now.process.kill()

    def end(self) -> None:
        """End the processes for good."""
        self._ended = True
        for made in (self._now, self._spare):
            if made is not None:
                made.process.kill()


@frozen(eq=False)
class _Made:
    """A process and the pipe to it."""

    process: Any
    pipe: Connection


def _faults(answer: Answer) -> tuple[Fault, ...]:
    if not answer.defect:
        return answer.faults
    last = answer.defect.strip().splitlines()[-1][:200]
    return (Fault(f"could not be drawn, by a defect of this program: {last}"),)
