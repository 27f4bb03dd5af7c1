"""The guard before the studio: who may ask it anything, and how much may be sent to it.

It stands before every request, WebSockets and files included, and reads none of their bodies. A page of
another site must not drive a program on this machine: so the name that the browser asked for must be this
machine's (which a rebound DNS name is not), a page that asks must be the studio's own, and whoever asks must
know the token that stands in the address which the command prints.
"""

from __future__ import annotations

import hmac
from collections.abc import Awaitable, Callable, Iterator, MutableMapping
from typing import Any, TypeAlias
from urllib.parse import parse_qs

from batik_vector.values import frozen

LARGEST_BODY = 24_000_000
"""Bytes of a request past which it is refused before any of it is read: twice the largest drawing."""

Scope: TypeAlias = MutableMapping[str, Any]
Receive: TypeAlias = Callable[[], Awaitable[MutableMapping[str, Any]]]
Send: TypeAlias = Callable[[MutableMapping[str, Any]], Awaitable[None]]
App: TypeAlias = Callable[[Scope, Receive, Send], Awaitable[None]]


class RefusedError(Exception):
    """Why a request is refused: a status of HTTP, and words for whoever reads it."""

    def __init__(self, status: int, words: str) -> None:
        super().__init__(words)
        self.status, self.words = status, words


@frozen
class House:
    """The door that the studio listens at, and its key.

    Args:
        port: of the loopback interface.
        token: which every request carries, in the address or as the cookie that the first answer sets.
        hosts: names of this machine that a browser may have asked for.
    """

    port: int
    token: str
    hosts: tuple[str, ...] = ("127.0.0.1", "localhost", "[::1]")

    @property
    def address(self) -> str:
        """The address to open."""
        return f"http://{self.hosts[0]}:{self.port}/?token={self.token}"

    @property
    def cookie(self) -> str:
        """The cookie's name. Cookies are shared by all ports of a machine, so that two studios need two."""
        return f"batik-studio-{self.port}"

    def check(self, scope: Scope) -> bool:
        """Return whether the cookie must be set, for a request that may pass.

        Raises:
            RefusedError: where it may not.
        """
        headers = [(name.decode("latin-1"), value.decode("latin-1")) for name, value in scope["headers"]]
        names = {f"{host}:{self.port}" for host in self.hosts}
        if [value for name, value in headers if name == "host"] not in [[name] for name in names]:
            raise RefusedError(400, "this studio answers to 127.0.0.1 alone")
        origins = [value for name, value in headers if name == "origin"]
        if any(each not in {f"http://{name}" for name in names} for each in origins):
            raise RefusedError(403, "a page of another site may not ask the studio for anything")
        if any(self._is_token(value) for value in self._cookies(headers)):
            return False
        asked = parse_qs(scope.get("query_string", b"").decode("latin-1")).get("token", [])
        if scope["type"] == "http" and scope["path"] == "/" and any(map(self._is_token, asked)):
            return True
        raise RefusedError(403, "open the address that batik-vector studio printed, with its token")

    def _is_token(self, text: str) -> bool:
        return hmac.compare_digest(text.encode(), self.token.encode())

    def _cookies(self, headers: list[tuple[str, str]]) -> Iterator[str]:
        for name, value in headers:
            for part in value.split(";") if name == "cookie" else ():
                key, _, found = part.strip().partition("=")
                if key == self.cookie:
                    yield found


class Guard:
    """The ASGI application that asks :class:`House` before it lets anything through."""

    def __init__(self, app: App, house: House) -> None:
        self.app, self.house = app, house
        policy = (
            "default-src 'self'; script-src 'self' 'unsafe-inline' 'unsafe-eval'; "
            "style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; font-src 'self' data:; "
            f"connect-src 'self' ws://127.0.0.1:{house.port} ws://localhost:{house.port}; "
            "object-src 'none'; base-uri 'self'; form-action 'self'; frame-ancestors 'none'"
        )
        self._added = [
            (b"content-security-policy", policy.encode()),
            (b"x-content-type-options", b"nosniff"),
            (b"referrer-policy", b"no-referrer"),
            (b"cross-origin-resource-policy", b"same-origin"),
            (b"cross-origin-opener-policy", b"same-origin"),
        ]

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Let a request through, or refuse it."""
        if scope["type"] == "lifespan":
            await self.app(scope, receive, send)
            return
        try:
            fresh = self.house.check(scope)
            _check_length(scope)
        except RefusedError as refusal:
            await _refuse(scope, send, refusal)
            return
        if scope["type"] == "websocket":
            await self.app(scope, receive, send)
            return
        await self.app(scope, receive, self._adding(send, fresh))

    def _adding(self, send: Send, fresh: bool) -> Send:
        added = list(self._added)
        if fresh:
            cookie = f"{self.house.cookie}={self.house.token}; Path=/; HttpOnly; SameSite=Strict"
            added.append((b"set-cookie", cookie.encode()))

        async def adding(message: MutableMapping[str, Any]) -> None:
            if message["type"] == "http.response.start":
                message["headers"] = [*message.get("headers", ()), *added]
            await send(message)

        return adding


def _check_length(scope: Scope) -> None:
    headers = dict(scope["headers"])
    length = headers.get(b"content-length", b"0")
    if not length.isdigit() or int(length) > LARGEST_BODY:
        raise RefusedError(413, f"too large: at most {LARGEST_BODY / 1e6:.0f} MB are taken")
    if b"transfer-encoding" in headers:
        raise RefusedError(411, "say how long it is: a body in pieces is not taken")


async def _refuse(scope: Scope, send: Send, refusal: RefusedError) -> None:
    if scope["type"] == "websocket":
        # Before it was accepted, this becomes an answer of 403.
        await send({"type": "websocket.close", "code": 1008, "reason": refusal.words})
        return
    headers = [(b"content-type", b"text/plain; charset=utf-8"), (b"connection", b"close")]
    await send({"type": "http.response.start", "status": refusal.status, "headers": headers})
    await send({"type": "http.response.body", "body": f"{refusal.words}\n".encode()})
