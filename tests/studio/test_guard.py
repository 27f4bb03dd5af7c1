"""The guard of the studio: a page of another site, a rebound name and a flood come to nothing."""

from __future__ import annotations

import asyncio
from collections.abc import MutableMapping
from typing import Any

import pytest

from batik_vector.studio.guard import LARGEST_BODY, Guard, House

HOUSE = House(8642, "secret-token")
MINE = {"host": "127.0.0.1:8642", "cookie": "batik-studio-8642=secret-token"}


async def inside(scope: Any, receive: Any, send: Any) -> None:
    """Stand for the studio: says that it was reached."""
    if scope["type"] == "websocket":
        await send({"type": "websocket.accept"})
        return
    await send({"type": "http.response.start", "status": 200, "headers": [(b"x-inside", b"1")]})
    await send({"type": "http.response.body", "body": b"reached"})


def asked(
    headers: dict[str, str], path: str = "/", query: str = "", kind: str = "http"
) -> list[MutableMapping[str, Any]]:
    """Return what the guard answers."""
    said: list[MutableMapping[str, Any]] = []

    async def send(message: MutableMapping[str, Any]) -> None:
        said.append(message)

    async def receive() -> MutableMapping[str, Any]:
        raise AssertionError("nothing of a body may be read by the guard")

    scope = {
        "type": kind,
        "path": path,
        "query_string": query.encode(),
        "headers": [(name.encode(), value.encode("latin-1")) for name, value in headers.items()],
    }
    asyncio.run(Guard(inside, HOUSE)(scope, receive, send))
    return said


def status(headers: dict[str, str], path: str = "/", query: str = "") -> int:
    return int(asked(headers, path, query)[0]["status"])


def test_the_address_with_its_token_opens_the_door_and_leaves_a_cookie() -> None:
    assert HOUSE.address == "http://127.0.0.1:8642/?token=secret-token"
    first = asked({"host": "127.0.0.1:8642"}, query="token=secret-token")
    headers = dict(first[0]["headers"])
    cookie = headers[b"set-cookie"].decode()
    assert first[0]["status"] == 200
    assert cookie.startswith("batik-studio-8642=secret-token;")
    assert {"HttpOnly", "SameSite=Strict"} <= set(cookie.split("; "))
    assert b"frame-ancestors 'none'" in headers[b"content-security-policy"]
    again = dict(asked(MINE)[0]["headers"])
    assert b"set-cookie" not in again


@pytest.mark.parametrize("host", ["127.0.0.1:8642", "localhost:8642", "[::1]:8642"])
def test_names_of_this_machine_are_known(host: str) -> None:
    assert status(MINE | {"host": host, "origin": f"http://{host}"}) == 200


@pytest.mark.parametrize(
    "headers",
    [
        MINE | {"host": "evil.example:8642"},
        MINE | {"host": "127.0.0.1"},
        MINE | {"host": "127.0.0.1:8643"},
        MINE | {"host": "127.0.0.1.nip.io:8642"},
        {"cookie": MINE["cookie"]},
    ],
)
def test_another_name_is_refused(headers: dict[str, str]) -> None:
    assert status(headers) == 400
    assert asked(headers, kind="websocket")[0]["type"] == "websocket.close"


@pytest.mark.parametrize(
    "origin", ["http://evil.example", "null", "http://127.0.0.1:9", "https://127.0.0.1:8642", ""]
)
@pytest.mark.parametrize("path", ["/", "/studio/drop", "/_nicegui_ws/socket.io/"])
def test_a_page_of_another_site_is_refused_even_with_the_cookie(origin: str, path: str) -> None:
    headers = MINE | {"origin": origin}
    assert status(headers, path) == 403
    assert asked(headers, path, kind="websocket")[0]["type"] == "websocket.close"


@pytest.mark.parametrize("token", ["", "secret-toke", "secret-token2", "geheim-äöü"])
def test_without_the_token_nothing_is_answered(token: str) -> None:
    headers = {"host": "127.0.0.1:8642", "cookie": f"other=1; batik-studio-8642={token}"}
    assert status(headers) == 403
    assert status({"host": "127.0.0.1:8642"}, query=f"token={token}") == 403
    assert asked(headers, kind="websocket")[0]["type"] == "websocket.close"


def test_the_token_in_the_address_opens_the_page_alone() -> None:
    bare = {"host": "127.0.0.1:8642"}
    assert status(bare, "/studio/picture/1", "token=secret-token") == 403
    assert asked(bare, "/", "token=secret-token", kind="websocket")[0]["type"] == "websocket.close"
    assert asked(MINE, "/_nicegui_ws/socket.io/", kind="websocket")[0]["type"] == "websocket.accept"


@pytest.mark.parametrize(
    ("length", "expected"), [(LARGEST_BODY, 200), (LARGEST_BODY + 1, 413), (200_000_000, 413)]
)
def test_a_flood_is_refused_before_any_of_it_is_read(length: int, expected: int) -> None:
    assert status(MINE | {"content-length": str(length)}, "/studio/drop") == expected


def test_a_body_of_unknown_length_is_refused() -> None:
    assert status(MINE | {"content-length": "-1"}, "/studio/drop") == 413
    assert status(MINE | {"transfer-encoding": "chunked"}, "/studio/drop") == 411
