"""The studio's server: on this machine's loopback alone, behind :mod:`guard`, until it is stopped."""

from __future__ import annotations

import asyncio
import contextlib
import importlib.util
import os
import secrets
import socket
import sys
import webbrowser
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from batik_vector.errors import BatikError
from batik_vector.studio.following import follow
from batik_vector.studio.guard import Guard, House

if TYPE_CHECKING:
    from batik_vector.studio.page.session import Session
    from batik_vector.studio.watching import Watched

BEGUN = "library:starter/flower"
"""What is open where nothing was left."""
PAGE = Path(__file__).parent / "page"
LARGEST_MESSAGE = 4 << 20
"""Bytes of a message over the WebSocket: a recipe's longest text, and room for its quoting."""


class StudioError(BatikError):
    """The studio cannot be started."""


def opened_session(recipe: str | None) -> Session:
    """Return the session of a recipe, or that which was left.

    Raises:
        BatikError: where the recipe cannot be read, or the studio's libraries are missing.
    """
    if importlib.util.find_spec("nicegui") is None:
        raise StudioError("the studio needs NiceGUI: pip install 'batik-vector[studio]'")
    from batik_vector.library import Library
    from batik_vector.studio.drafts import Draft
    from batik_vector.studio.journal import InUseError, Journal
    from batik_vector.studio.page.session import Session

    journal = Journal()
    if recipe is None:
        # Two studios never work at one draft.
        for kept in journal.kept():
            if not kept.in_use:
                with contextlib.suppress(InUseError):
                    return Session(journal.restore(kept.key))
    with Library():
        # Where it was not there it is begun.
        draft = Draft.read(recipe or BEGUN)
    return Session(journal.begin(draft))


def listening(port: int) -> socket.socket:
    """Return a socket that listens on the loopback at a port, or at any that is free where it is 0.

    Raises:
        StudioError: where the port is taken.
    """
    made = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    # A studio that was killed can be opened again at its port at once.
    made.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        made.bind(("127.0.0.1", port))
    except OSError as error:
        made.close()
        why = "is taken by another program, or another studio" if error.errno in (98, 48) else f"{error}"
        raise StudioError(f"port {port} {why}: expected --port with another number, or 0 for any") from error
    made.listen(64)
    return made


def serve(
    session: Session,
    port: int | None,
    usual: int,
    browser: bool,
    say: Callable[[str], None],
    watched: Watched | None = None,
) -> None:
    """Serve the studio until it is interrupted.

    Args:
        session: what is open.
        port: of the loopback; 0 for any that is free. Where none is asked for it is the usual one, or any.
        usual: the usual port.
        browser: whether to open the page in the user's browser.
        say: told the address once the page can be opened.
        watched: the files that the page follows, where it does.

    Raises:
        StudioError: where the port is taken.
    """
    # What the server imports and what draws take a second each.
    session.images.begin()
    # It would keep a folder of its own where the command is called.
    os.environ.setdefault("NICEGUI_STORAGE_PATH", str(session.desk.path.parent / "nicegui"))
    try:
        door = listening(usual if port is None else port)
    except StudioError:
        if port is not None:
            raise
        door = listening(0)
    house = House(door.getsockname()[1], secrets.token_urlsafe(24))

    following = []

    def opened() -> None:
        if watched is not None:
            following.append(asyncio.create_task(follow(session, watched)))
        say(house.address)
        if browser:
            webbrowser.open(house.address)

    with door:
        _server(application(session, house), opened, session.end_asides).run(sockets=[door])


def application(session: Session, house: House) -> Guard:
    """Return the studio as an ASGI application."""
    import fastapi
    from nicegui import ui
    from starlette.staticfiles import StaticFiles

    from batik_vector.studio.page import live, transfers
    from batik_vector.studio.page.layout import page_of

    app = fastapi.FastAPI(openapi_url=None)
    app.mount("/studio/static", StaticFiles(directory=PAGE))
    transfers.add_routes(app, session)
    live.add_route(app, session.tabs)
    ui.run_with(
        app,
        root=page_of(session),
        title="batik_vector studio",
        favicon=PAGE / "icon.svg",
        dark=None,
        language="en-US",
        tailwind=False,
        reconnect_timeout=20,
        show_welcome_message=False,
        gzip_middleware_factory=None,
    )
    return Guard(app, house)


def _server(app: Guard, opened: Callable[[], None], closing: Callable[[], None]) -> Any:
    import uvicorn

    class Server(uvicorn.Server):
        """Tells when it can be asked."""

        async def startup(self, sockets: list[socket.socket] | None = None) -> None:
            await super().startup(sockets)
            if self.started:
                opened()

        async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
            # Who waits for a small picture is answered, and does not keep the server from ending.
            closing()
            await super().shutdown(sockets)

    config = uvicorn.Config(
        app,
        log_level="warning" if "BATIK_STUDIO_LOG" not in os.environ else "info",
        access_log=False,
        server_header=False,
        timeout_graceful_shutdown=1,
        ws_max_size=LARGEST_MESSAGE,
        # Nothing leaves this machine: to press it together takes longer than to send it.
        ws_per_message_deflate=False,
        # What comes in wheels for every system; uvloop is not for Windows.
        loop="asyncio" if sys.platform == "win32" else "auto",
    )
    return Server(config)
