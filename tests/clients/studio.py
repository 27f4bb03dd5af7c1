"""A studio that a test has started, and the page of it in a browser without a window."""

from __future__ import annotations

import base64
import contextlib
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

SECONDS = 90_000
"""Milliseconds that the page has for anything: a machine at its limits is slow."""


class Studio:
    """The command, running, with a library and a state of its own."""

    def __init__(
        self, folder: Path, *arguments: str, library: Path | None = None, watch: bool = False
    ) -> None:
        environment = os.environ | {
            "BATIK_LIBRARY": str(library or folder / "library"),
            "BATIK_STUDIO": str(folder / "state"),
            "PYTHONUNBUFFERED": "1",
            # Whatever would open a page of the desktop's own.
            "BROWSER": "true",
        }
        options = ["watch", "--page"] if watch else ["studio", "--no-browser", "--port", "0"]
        call = [sys.executable, "-m", "batik_vector", *options, *arguments]
        said = folder / "said"
        with said.open("w") as told:
            # Of `watch` reports are alone on stdout.
            out = told if watch else subprocess.PIPE
            self.process = subprocess.Popen(call, stdout=out, stderr=told, text=True, env=environment)
        self.address = self._told_in(said) if watch else self._told()
        if not self.address:
            raise AssertionError(said.read_text())

    def _told(self) -> str:
        assert self.process.stdout is not None
        return str(self.process.stdout.readline().strip())

    def _told_in(self, said: Path) -> str:
        until = time.monotonic() + SECONDS / 1000
        while self.process.poll() is None and time.monotonic() < until:
            found = re.search(r"^http://\S+$", said.read_text(), re.M)
            if found:
                return found[0]
            time.sleep(0.1)
        return ""

    @property
    def port(self) -> int:
        return int(self.address.split(":")[2].split("/")[0])

    @property
    def token(self) -> str:
        return self.address.partition("token=")[2]

    def end(self, number: int = signal.SIGTERM) -> None:
        """End it, and wait until it is gone."""
        self.process.send_signal(number)
        self.process.wait(timeout=30)


@contextlib.contextmanager
def studio(
    folder: Path, *arguments: str, library: Path | None = None, watch: bool = False
) -> Iterator[Studio]:
    """Start a studio, and end it; it has a library of its own where none is given.

    With ``watch`` it is the page of ``batik-vector watch --page``.
    """
    folder.mkdir(exist_ok=True)
    made = Studio(folder, *arguments, library=library, watch=watch)
    try:
        yield made
    finally:
        if made.process.poll() is None:
            made.end(signal.SIGKILL)
        if made.process.stdout is not None:
            made.process.stdout.close()


@contextlib.contextmanager
def browser() -> Iterator[Any]:
    """Start the system's Chromium."""
    api = pytest.importorskip("playwright.sync_api", reason="make test-clients installs what drives browsers")
    names = ("chromium", "chromium-browser", "google-chrome")
    found = next(filter(None, map(shutil.which, names)), None)
    if found is None:
        pytest.skip("Chromium is not installed: make test-clients installs it")
    with api.sync_playwright() as driver:
        made = driver.chromium.launch(executable_path=found)
        try:
            yield made
        finally:
            made.close()


class Page:
    """The studio's page, with words for what a person does on it."""

    def __init__(
        self, browser: Any, address: str, size: tuple[int, int] = (1440, 900), dark: bool = False
    ) -> None:
        scheme = "dark" if dark else "light"
        width, height = size
        context = browser.new_context(viewport={"width": width, "height": height}, color_scheme=scheme)
        context.set_default_timeout(SECONDS)
        context.grant_permissions(["clipboard-read", "clipboard-write"])
        self.page = context.new_page()
        self.errors: list[str] = []
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.goto(address)
        self.page.wait_for_function("window.studio && studio.state.shown > 0")
        self.page.wait_for_selector(".control")

    def picture(self) -> str:
        """Return the picture's paths as the browser has them."""
        found = self.page.evaluate(
            "[...studio.state.host.shadowRoot.querySelectorAll('.stage > svg:not(.over) path')]"
            ".map(each => each.getAttribute('d')).join()"
        )
        return str(found)

    def settled(self, before: str = "") -> str:
        """Return the picture once it is another one than it was."""
        deadline = 400
        while (now := self.picture()) == before and deadline:
            self.page.wait_for_timeout(100)
            deadline -= 1
        assert now != before, "the picture stays as it was"
        return now

    def menu(self, title: str, item: str) -> None:
        """Choose from a menu of the bar."""
        self.page.locator(".bar").get_by_role("button", name=title, exact=True).click()
        self.page.get_by_role("menuitem", name=item).click()

    def save_as(self, name: str) -> None:
        """Save to the library under a name."""
        self.menu("File", "Save as")
        self.page.get_by_label("Name", exact=True).fill(name)
        self.page.get_by_role("button", name="Save", exact=True).click()

    def set(self, path: str, value: object) -> None:
        """Type a value into the field of a key."""
        self.field(path).fill(str(value))
        self.field(path).press("Enter")

    def tab(self, name: str) -> None:
        """Turn to a tab of either side."""
        self.page.get_by_role("tab", name=name).click()

    def slider(self, path: str) -> Any:
        """Return the slider of a key."""
        return self.page.locator(f'[data-path="{path}"] .q-slider')

    def field(self, path: str) -> Any:
        """Return the field of a key."""
        return self.page.locator(f'[data-path="{path}"] input').last

    def says(self, path: str, value: object) -> None:
        """Wait until the field of a key says something: panels follow the picture."""
        sought = f'[data-path="{path}"] input'
        self.page.wait_for_function(
            "([sought, value]) => [...document.querySelectorAll(sought)].at(-1)?.value === value",
            arg=[sought, str(value)],
        )

    def choose(self, words: str, title: str) -> None:
        """Search the library, and open what is found."""
        self.page.get_by_label("Search the library").fill(words)
        self.page.locator(f'.left .shelf[data-words="{words}"]').wait_for()
        self.page.locator(".left .pattern", has_text=title).first.click()
        self.page.locator(".bar .title", has_text=title).wait_for()

    def drop(self, name: str, data: str | bytes) -> None:
        """Drop a file on the page."""
        sent = base64.b64encode(data.encode() if isinstance(data, str) else data).decode()
        handle = self.page.evaluate_handle(
            "([name, sent]) => { const data = new DataTransfer();"
            " const bytes = Uint8Array.from(atob(sent), (each) => each.charCodeAt(0));"
            " data.items.add(new File([bytes], name)); return data; }",
            [name, sent],
        )
        self.page.dispatch_event("body", "drop", {"dataTransfer": handle})

    def download(self, *formats: str) -> Path:
        """Export in some formats; return the file that is handed over."""
        self.menu("File", "Export")
        dialog = self.page.locator(".dialog")
        dialog.get_by_role("checkbox", name="Recipe (TOML)").wait_for()
        for box in dialog.get_by_role("checkbox").all():
            name = (box.get_attribute("aria-label") or box.inner_text()).strip()
            wanted = name.lower() in formats
            if (box.get_attribute("aria-checked") == "true") != wanted:
                box.click()
            dialog.get_by_role("checkbox", name=name, exact=True, checked=wanted).wait_for()
        with self.page.expect_download() as found:
            dialog.get_by_role("button", name="Download").click()
        return Path(str(found.value.path()))
