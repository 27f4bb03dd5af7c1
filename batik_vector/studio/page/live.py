"""The short way between a slider and the picture: a WebSocket of our own, beside that of the page's elements.

What a page made of elements is told goes through its whole tree, which takes longer than a picture. So a
slider that is dragged tells its values here, and pictures come back here: of several that wait for a browser
the newest is sent, and the next one once that is shown.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from starlette.routing import WebSocketRoute
from starlette.websockets import WebSocket, WebSocketDisconnect

if TYPE_CHECKING:
    from fastapi import FastAPI

PATIENCE = 2.0
"""Seconds to wait for a browser to show a picture before it is sent the next one: a hidden tab shows none."""
VERDICT = "verdict"
"""The part that tells what was found out of the picture."""
LONGEST = 400
"""Characters of what a page says here."""

Slid = Callable[[int, float, bool], None]
"""Told the number of a slider, its value, and whether it was let go."""


class Live:
    """The server's end of one tab."""

    def __init__(self, slid: Slid) -> None:
        self._slid = slid
        self._parts: dict[str, tuple[dict[str, Any], bytes]] = {}
        self._due: dict[str, None] = {}
        self._fresh = asyncio.Event()
        self._shown = asyncio.Event()

    def put(self, head: Mapping[str, Any], svg: bytes, part: str = "") -> None:
        """Send a picture as soon as the browser takes one; one of the same part that still waits is dropped.

        Args:
            head: what is known of it.
            svg: the picture.
            part: "motif" for that of a motif alone, nothing for the whole.
        """
        if not part:
            # What was found out of the one before is no news of this one.
            self._due.pop(VERDICT, None)
        self._parts[part] = {**head, "part": part}, svg
        self._due[part] = None
        self._fresh.set()

    def amend(self, more: Mapping[str, Any]) -> None:
        """Add to what is known of the whole picture, for browsers that have it and for those to come.

        It goes by the same way as the picture, which by another one it might overtake.
        """
        if "" in self._parts:
            head, svg = self._parts[""]
            self._parts[""] = {**head, **more}, svg
            self.put(more, b"", VERDICT)

    def _frame(self, part: str) -> bytes:
        head, svg = self._parts[part]
        told = json.dumps(head).encode()
        return len(told).to_bytes(4, "big") + told + svg

    async def serve(self, socket: WebSocket) -> None:
        """Serve a browser until it goes; what it missed is sent at once."""
        await socket.accept()
        if "" in self._parts:
            self._due[""] = None
            self._fresh.set()
        self._shown.set()
        sending = asyncio.create_task(self._send(socket))
        try:
            with contextlib.suppress(WebSocketDisconnect):
                while True:
                    self._hear(await socket.receive_text())
        finally:
            sending.cancel()

    async def _send(self, socket: WebSocket) -> None:
        while True:
            await self._fresh.wait()
            with contextlib.suppress(TimeoutError):
                await asyncio.wait_for(self._shown.wait(), PATIENCE)
            self._shown.clear()
            # A browser that comes back may have another socket for a moment, which took it.
            part = next(iter(self._due), None)
            if part is not None:
                del self._due[part]
            if not self._due:
                self._fresh.clear()
            if part is None:
                continue
            await socket.send_bytes(self._frame(part))

    def _hear(self, words: str) -> None:
        try:
            said = json.loads(words) if len(words) <= LONGEST else None
        except ValueError:
            said = None
        if said == "shown":
            self._shown.set()
        elif isinstance(said, list) and len(said) == 3:
            number, value, let_go = said
            if isinstance(number, int) and isinstance(value, int | float) and math.isfinite(value):
                self._slid(number, value, bool(let_go))


def add_route(app: FastAPI, tabs: Mapping[str, Live]) -> None:
    """Add the address of the short way; tabs are known by the names of their clients."""

    async def live(socket: WebSocket) -> None:
        tab = tabs.get(socket.query_params.get("tab", ""))
        if tab is None:
            await socket.close(4404)
        else:
            await tab.serve(socket)

    app.router.routes.append(WebSocketRoute("/studio/live", live))
