"""The short way between a slider and the picture, without a browser."""

from __future__ import annotations

import asyncio
import json
from typing import Any

import pytest

pytest.importorskip("nicegui", reason="the studio is an extra")

from starlette.websockets import WebSocketDisconnect

from batik_vector.studio.page.fields import read, shown
from batik_vector.studio.page.live import Live


class Socket:
    """A browser that says what it is told to, and goes."""

    def __init__(self) -> None:
        self.says: asyncio.Queue[str | None] = asyncio.Queue()
        self.seen: list[tuple[dict[str, Any], bytes]] = []

    async def accept(self) -> None: ...

    async def receive_text(self) -> str:
        said = await self.says.get()
        if said is None:
            raise WebSocketDisconnect(1000)
        return said

    async def send_bytes(self, data: bytes) -> None:
        length = int.from_bytes(data[:4], "big")
        self.seen.append((json.loads(data[4 : 4 + length]), data[4 + length :]))


async def rest() -> None:
    for _ in range(20):
        await asyncio.sleep(0)


def test_of_pictures_that_wait_for_a_browser_the_newest_is_sent() -> None:
    async def run() -> None:
        live, socket = Live(lambda *_: None), Socket()
        live.put({"n": 0}, b"before anybody looked")
        serving = asyncio.create_task(live.serve(socket))  # type: ignore[arg-type]
        await rest()
        for number in range(1, 6):
            live.put({"n": number}, b"<svg/>")
            await rest()
        assert [head["n"] for head, _ in socket.seen] == [0]
        socket.says.put_nowait('"shown"')
        await rest()
        assert [head["n"] for head, _ in socket.seen] == [0, 5]
        assert socket.seen[1][1] == b"<svg/>"
        socket.says.put_nowait(None)
        await serving
        # Who comes back is shown what there is.
        again = Socket()
        serving = asyncio.create_task(live.serve(again))  # type: ignore[arg-type]
        await rest()
        assert [head["n"] for head, _ in again.seen] == [5]
        again.says.put_nowait(None)
        await serving

    asyncio.run(run())


def test_who_takes_a_picture_late_is_told_its_verdict_with_it() -> None:
    async def run() -> None:
        live, socket = Live(lambda *_: None), Socket()
        live.put({"n": 0}, b"<svg/>")
        live.amend({"verdict": "passed"})
        serving = asyncio.create_task(live.serve(socket))  # type: ignore[arg-type]
        await rest()
        assert [head.get("verdict") for head, _ in socket.seen] == ["passed"]
        live.put({"n": 1}, b"<svg/>")
        socket.says.put_nowait('"shown"')
        await rest()
        assert [head.get("verdict") for head, _ in socket.seen] == ["passed", None]
        socket.says.put_nowait(None)
        await serving

    asyncio.run(run())


def test_a_verdict_follows_its_picture_and_never_comes_after_a_newer_one() -> None:
    async def run() -> list[tuple[str, int | None, str | None]]:
        live, socket = Live(lambda *_: None), Socket()
        serving = asyncio.create_task(live.serve(socket))  # type: ignore[arg-type]
        await rest()
        live.put({"n": 0}, b"<svg/>")
        await rest()
        # The browser has yet to show it.
        live.amend({"verdict": "passed"})
        await rest()
        assert len(socket.seen) == 1
        socket.says.put_nowait('"shown"')
        await rest()
        live.put({"n": 1}, b"<svg/>")
        await rest()
        live.amend({"verdict": "late"})
        live.put({"n": 2}, b"<svg/>")
        for _ in range(3):
            socket.says.put_nowait('"shown"')
            await rest()
        socket.says.put_nowait(None)
        await serving
        return [(head["part"], head.get("n"), head.get("verdict")) for head, _ in socket.seen]

    assert asyncio.run(run()) == [("", 0, None), ("verdict", None, "passed"), ("", 2, None)]


def test_a_motif_alone_does_not_take_the_place_of_the_pattern() -> None:
    async def run() -> list[tuple[str, bytes]]:
        live, socket = Live(lambda *_: None), Socket()
        serving = asyncio.create_task(live.serve(socket))  # type: ignore[arg-type]
        await rest()
        for part, svg in (("motif", b"1"), ("motif", b"2"), ("", b"whole"), ("motif", b"3"), ("", b"newer")):
            live.put({}, svg, part)
            await rest()
        for _ in range(3):
            socket.says.put_nowait('"shown"')
            await rest()
        socket.says.put_nowait(None)
        await serving
        # Who comes back is shown the pattern; what was held in a hand then is past.
        again = Socket()
        serving = asyncio.create_task(live.serve(again))  # type: ignore[arg-type]
        again.says.put_nowait(None)
        await serving
        return [(head["part"], svg) for head, svg in socket.seen]

    assert asyncio.run(run()) == [("motif", b"1"), ("motif", b"3"), ("", b"newer")]


def test_what_is_no_value_of_a_slider_is_passed_over() -> None:
    async def run() -> list[tuple[int, float, bool]]:
        told: list[tuple[int, float, bool]] = []
        live, socket = Live(lambda *said: told.append(said)), Socket()
        for words in (
            "[7, 0.5, false]", "[7, NaN, false]", "[7, 1e999, true]", '["7", 1, true]', "[7, 1]", "{}", "[",
            "", '[7, "1", true]', "[" * 100_000, f"[7, {'1' * 500}, true]", "[7, 2, true]",
        ):  # fmt: skip
            socket.says.put_nowait(words)
        socket.says.put_nowait(None)
        await live.serve(socket)  # type: ignore[arg-type]
        return told

    assert asyncio.run(run()) == [(7, 0.5, False), (7, 2, True)]


@pytest.mark.parametrize(
    ("value", "words"), [(10_000_000, "1e7"), (1_234_567, "1234567"), (12, "12"), (0.02, "0.02")]
)
def test_a_number_is_shown_by_its_figures(value: float, words: str) -> None:
    assert shown(value) == words
    assert float(words) == value


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (["leaf", "petal"], "leaf, petal"),
        (["F -> F[+F]F[-F]F"], "F -> F[+F]F[-F]F"),
        (["[F]"], '["[F]"]'),
        (["true"], '["true"]'),
        ([], "[]"),
        (["A(x, y) -> F"], '["A(x, y) -> F"]'),
        ([1, 2.5], "[1, 2.5]"),
        ([[0, 1], [2, 3]], "[[0, 1], [2, 3]]"),
    ],
)
def test_a_list_is_shown_as_it_is_typed(value: Any, words: str) -> None:
    assert shown(value) == words
    assert read(words) == value


def test_lists_are_typed_as_people_do() -> None:
    assert read("1, 2.5") == [1, 2.5]
    assert read("[leaf, petal]") == read('"leaf", "petal"') == read(" leaf,petal ") == ["leaf", "petal"]
    assert read(" ") is None
