"""The studio in Firefox, driven by its own protocol (Marionette): no other driver comes with Debian."""

from __future__ import annotations

import contextlib
import os
import shutil
import socket
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("nicegui", reason="make test-clients installs the studio")

from tests.clients.studio import SECONDS, studio
from tests.clients.test_studio import PETAL, ROOT

pytestmark = [
    pytest.mark.clients,
    # The driver leaves sockets open by which it looks whether Firefox listens.
    pytest.mark.filterwarnings("ignore::ResourceWarning", "ignore::pytest.PytestUnraisableExceptionWarning"),
]

DRAWN = """
const { state } = window.studio;
return state.shown > 0 && [...state.host.shadowRoot.querySelectorAll(".stage > svg:not(.over) path")]
  .map((each) => each.getAttribute("d")).join();
"""


@contextlib.contextmanager
def firefox(folder: Path) -> Iterator[Any]:
    """Start the system's Firefox without a window."""
    driver = pytest.importorskip("marionette_driver.marionette", reason="make test-clients installs it")
    found = next(filter(None, map(shutil.which, ("firefox-esr", "firefox"))), None)
    if found is None:
        pytest.skip("Firefox is not installed: make test-clients installs it")
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    profile = folder / "profile"
    profile.mkdir()
    (profile / "user.js").write_text(f'user_pref("marionette.port", {port});\n')
    call = [found, "--headless", "--marionette", "--no-remote", "--profile", str(profile)]
    mine = os.environ | {"HOME": str(folder)}
    process = subprocess.Popen(call, env=mine, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        made = driver.Marionette(host="127.0.0.1", port=port, startup_timeout=SECONDS / 1000)
        made.start_session(timeout=SECONDS / 1000)
        yield made
    finally:
        process.terminate()
        process.wait(timeout=30)


def test_a_slider_moves_the_picture_and_undo_has_it_back(tmp_path: Path) -> None:
    with (
        studio(tmp_path / "own", str(ROOT / "samples" / "four-square.toml")) as made,
        firefox(tmp_path) as page,
    ):
        from marionette_driver import By, Wait
        from marionette_driver.keys import Keys

        def drawn() -> str:
            return str(page.execute_script(DRAWN, sandbox=None) or "")

        patient = Wait(page, timeout=SECONDS / 1000)
        page.navigate(made.address)
        patient.until(lambda _: page.execute_script("return !!window.studio", sandbox=None))
        patient.until(lambda _: drawn())
        slider = f'[data-path="{PETAL}"] .q-slider [tabindex="0"]'
        patient.until(lambda _: page.find_elements(By.CSS_SELECTOR, slider))
        first = drawn()
        page.find_element(By.CSS_SELECTOR, slider).send_keys(Keys.ARROW_LEFT * 5)
        patient.until(lambda _: drawn() != first)
        field = page.find_element(By.CSS_SELECTOR, f'[data-path="{PETAL}"] .q-field input')
        patient.until(lambda _: float(field.get_property("value")) < 1)
        undo = page.find_element(By.CSS_SELECTOR, 'button[aria-label="Undo"]')
        patient.until(lambda _: undo.get_attribute("disabled") is None)
        undo.click()
        patient.until(lambda _: drawn() == first)
        patient.until(lambda _: float(field.get_property("value")) == 1)
