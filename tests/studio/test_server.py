"""The studio as a server: who may ask it, what it takes, how it ends. Its page is in tests/clients."""

from __future__ import annotations

import contextlib
import http.client
import os
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from batik_vector.command.cli import cli
from batik_vector.errors import BatikError
from batik_vector.studio.aside import Aside
from batik_vector.studio.server import StudioError, listening
from tests.calling import runner

RECIPE = Path(__file__).parents[2] / "samples" / "kawung.toml"


class Running:
    """A studio that was started by its command."""

    def __init__(self, folder: Path) -> None:
        environment = os.environ | {
            "BATIK_LIBRARY": str(folder / "library"),
            "BATIK_STUDIO": str(folder / "state"),
            "PYTHONUNBUFFERED": "1",
        }
        call = [sys.executable, "-m", "batik_vector", "studio", str(RECIPE), "--no-browser", "--port", "0"]
        self.process = subprocess.Popen(call, stdout=subprocess.PIPE, text=True, env=environment)
        assert self.process.stdout is not None
        self.address = self.process.stdout.readline().strip()
        self.port = int(self.address.split(":")[2].split("/")[0])
        self.token = self.address.partition("token=")[2]

    @property
    def cookie(self) -> dict[str, str]:
        return {"cookie": f"batik-studio-{self.port}={self.token}"}

    def ask(
        self, method: str, path: str, headers: dict[str, str] | None = None, body: bytes | None = None
    ) -> tuple[int, str, bytes]:
        """Return the status, the cookie that is set, and what is answered."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        connection.request(method, path, body, headers or {})
        answer = connection.getresponse()
        found = answer.status, answer.getheader("set-cookie", ""), answer.read()
        connection.close()
        return found

    def knock(self, head: str) -> str:
        """Return the first line that is answered to a request's head alone."""
        with socket.create_connection(("127.0.0.1", self.port), timeout=60) as line:
            line.sendall(head.replace("\n", "\r\n").encode() + b"\r\n\r\n")
            return line.recv(100).decode().partition("\r\n")[0]


@pytest.fixture(scope="module")
def running(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Running]:
    pytest.importorskip("nicegui", reason="the studio's extra is not installed")
    made = Running(tmp_path_factory.mktemp("studio"))
    yield made
    made.process.send_signal(signal.SIGINT)
    assert made.process.wait(timeout=60) in (0, 130)
    assert made.process.stdout is not None
    made.process.stdout.close()


def test_the_page_is_for_whoever_has_the_address(running: Running) -> None:
    status, cookie, page = running.ask("GET", f"/?token={running.token}")
    assert status == 200
    assert cookie.startswith(f"batik-studio-{running.port}={running.token};")
    assert b"display.js" in page
    assert running.ask("GET", "/", running.cookie)[0] == 200
    for path in ("/", "/studio/picture/1", "/studio/static/display.js", "/_nicegui_ws/socket.io/?EIO=4"):
        assert running.ask("GET", path)[0] == 403, path


def test_only_this_machine_is_listened_to(running: Running) -> None:
    assert running.address.startswith("http://127.0.0.1:")
    others = set()
    # A bare system may not know its own name.
    with contextlib.suppress(OSError):
        others = {each[4][0] for each in socket.getaddrinfo(socket.gethostname(), None, socket.AF_INET)}
    for address in sorted(str(each) for each in others if not str(each).startswith("127.")):
        with pytest.raises(OSError, match=r".*"):
            socket.create_connection((address, running.port), timeout=2).close()


def test_other_pages_may_not_post_nor_open_a_socket(running: Running) -> None:
    foreign = running.cookie | {"origin": "http://evil.example"}
    assert running.ask("POST", "/studio/drop?name=a.toml", foreign, b"title = 'x'")[0] == 403
    head = (
        f"GET /_nicegui_ws/socket.io/?EIO=4&transport=websocket HTTP/1.1\nHost: 127.0.0.1:{running.port}\n"
        "Upgrade: websocket\nConnection: Upgrade\nSec-WebSocket-Version: 13\n"
        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\n"
    )
    cookie = f"Cookie: {running.cookie['cookie']}"
    own = f"Origin: http://127.0.0.1:{running.port}"
    assert " 403 " in running.knock(f"{head}{cookie}\nOrigin: http://evil.example")
    assert " 403 " in running.knock(f"{head}{own}")
    assert " 101 " in running.knock(f"{head}{cookie}\n{own}")


def test_200_megabytes_are_refused_before_they_are_sent(running: Running) -> None:
    head = f"POST /studio/drop?name=a.svg HTTP/1.1\nHost: 127.0.0.1:{running.port}\n"
    said = running.knock(f"{head}Cookie: {running.cookie['cookie']}\nContent-Length: 200000000")
    assert " 413 " in said


def test_files_are_taken_in_whatever_they_call_themselves(running: Running, tmp_path: Path) -> None:
    cookie = running.cookie
    text = RECIPE.read_bytes().replace(b"title", b"# dropped\ntitle", 1)
    status, _, words = running.ask("POST", "/studio/drop?name=../../../evil.toml", cookie, text)
    assert (status, words) == (200, b"evil.toml opened")
    assert not list(tmp_path.parent.rglob("evil*"))
    bomb = b'<!DOCTYPE s [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;&a;&a;">]><svg>&b;</svg>'
    for name, data in (("bomb.svg", bomb), ("a.exe", b"MZ"), ("a.pdf", b"%PDF-1.4"), ("a.toml", b"\xff\xfe")):
        status, _, words = running.ask("POST", f"/studio/drop?name={name}", cookie, data)
        assert status == 422, name
        assert words.strip()
    for path in ("/studio/static/../session.py", "/studio/static/%2e%2e/guard.py", "/studio/download/9"):
        assert running.ask("GET", path, cookie)[0] == 404, path


def test_thumbnails_are_of_the_library_alone(running: Running) -> None:
    status, _, picture = running.ask("GET", "/studio/thumbnail?name=starter/kawung@1", running.cookie)
    assert status == 200
    assert picture.startswith(b"\x89PNG") or b"<svg" in picture[:200]
    for name in ("no-such", "../../etc/passwd", "starter/kawung@99", ""):
        assert running.ask("GET", f"/studio/thumbnail?name={name}", running.cookie)[0] == 404, name


def test_a_port_that_is_taken_is_told() -> None:
    with listening(0) as door:
        port = door.getsockname()[1]
        with pytest.raises(StudioError, match=rf"port {port} is taken.*--port"):
            listening(port)


def test_without_its_library_the_studio_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    done = runner().invoke(cli, ["studio", "--no-browser"])
    assert done.exit_code == 2
    assert "pip install 'batik-vector[studio]'" in done.stderr


def too_long() -> None:
    import time

    time.sleep(60)


def gone() -> None:
    os._exit(3)


def test_what_runs_aside_has_a_limit_and_may_die() -> None:
    import asyncio

    async def tried() -> None:
        aside = Aside()
        try:
            with pytest.raises(BatikError, match="longer than"):
                await aside.run(1.5, too_long)
            with pytest.raises(BatikError, match="ended"):
                await aside.run(60, gone)
            assert await aside.run(60, os.path.basename, "a/b") == "b"
        finally:
            aside.close()

    asyncio.run(tried())
