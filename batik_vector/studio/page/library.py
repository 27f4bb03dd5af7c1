"""The left of the page: patterns of the library, found by words and features, and one's versions."""

from __future__ import annotations

from typing import TYPE_CHECKING
from urllib.parse import quote

from nicegui import background_tasks, ui

from batik_vector.errors import BatikError
from batik_vector.studio.page.parts import group, report, say, telling, text, word_button

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

    from batik_vector.library.values import Version
    from batik_vector.studio.page.session import Session

CONDITION = ("<", ">", "=", "..")
"""What a search holds where it is a condition on features."""
SHOWN_AT_ONCE, MOST_SHOWN = 60, 1000
"""Patterns shown at first, and once all are asked for: more would keep the page busy."""


class Thumb(ui.element, component="thumb.js"):
    """The small picture of a version, asked for once it is seen."""

    def __init__(self, reference: str) -> None:
        super().__init__()
        self._props["address"] = f"/studio/thumbnail?name={quote(reference)}"


def card(name: str, label: str, said: str, action: Callable[..., Any], version: int) -> ui.element:
    """Return a pattern's picture with its name below, as a button."""
    made = ui.element("button").classes("pattern").props(f'type=button title="{_attribute(said)}"')
    with made:
        Thumb(f"{name}@{version}")
        text(label, "name")
    return made.on("click", action)


def mark(button: ui.element, on: bool) -> None:
    """Show whether a card is that of what is open."""
    if on != ("aria-current" in button._props):
        button.classes(add="open" if on else "", remove="" if on else "open")
        button.props("aria-current=true") if on else button.props(remove="aria-current")


def _attribute(words: str) -> str:
    return words.replace("&", "&amp;").replace('"', "&quot;")


class LibraryPanel:
    """Patterns of the library."""

    def __init__(self, session: Session) -> None:
        self.session = session
        self._asked = 0
        self._most = SHOWN_AT_ONCE
        self._cards: dict[str, ui.element] = {}
        with group("column"):
            with group("searching"):
                self.words = (
                    ui.input(placeholder="Search: kawung, petals = 8")
                    .props('dense outlined clearable debounce=200 aria-label="Search the library"')
                    .on_value_change(self.refresh)
                )
                with self.words.add_slot("prepend"):
                    ui.icon("search", size="18px")
                with group("line"):
                    self.own = (
                        ui.checkbox("Mine only", on_change=self.refresh)
                        .props("dense size=sm")
                        .classes("small")
                    )
                    self.said = text("", "quiet small").props("role=status")
            with group("scroll grow"):
                self.shelf = group("shelf")
                self.more = word_button("Show all", self._show_all).classes("more")
        self.more.set_visibility(False)
        ui.context.client.on_delete(session.on_library(self.refresh))
        self.refresh()

    def _show_all(self) -> None:
        self._most = MOST_SHOWN
        self.refresh()

    def refresh(self) -> None:
        """Look again."""
        background_tasks.create(self._find())

    async def _find(self) -> None:
        self._asked += 1
        mine = self._asked
        words = (self.words.value or "").strip()
        where = words if any(each in words for each in CONDITION) else ""
        try:
            found = await self.session.shelf.find("" if where else words, where, own=bool(self.own.value))
        except BatikError as error:
            say(self.said, str(error))
            return
        if mine != self._asked:
            return
        say(self.said, "" if found else "Nothing found.")
        # Own patterns first: they are what one comes back for. Then what one begins with.
        found.sort(key=lambda hit: (hit.included, hit.included and not hit.name.startswith("starter/")))
        self.shelf.clear()
        self._cards = {}
        with self.shelf:
            for hit in found[: self._most]:
                label = hit.title or hit.name
                self._cards[hit.name] = card(
                    hit.name,
                    label,
                    f"{label} ({hit.name})",
                    telling(lambda hit=hit: self.session.open_pattern(hit.name)),
                    hit.version,
                )
        self.mark()
        # What is shown answers these words: whoever drives the page waits for it.
        self.shelf.props(f'data-words="{_attribute(words)}"')
        self.more.set_visibility(self._most < min(len(found), MOST_SHOWN))
        if len(found) > self._most:
            say(self.said, f"{self._most} of {len(found)} patterns")
        elif found:
            say(self.said, f"{len(found)} pattern{'s' if len(found) > 1 else ''}")

    def mark(self) -> None:
        """Show which of the patterns is open."""
        for name, button in self._cards.items():
            mark(button, name == self.session.pattern)


class VersionsPanel:
    """Versions of the pattern that is open, the newest first."""

    def __init__(self, session: Session) -> None:
        self.session = session
        self._seen = False
        self._drawn: tuple[str, int] | None = None
        self._cards: dict[str, ui.element] = {}
        with group("scroll"):
            words = "Save the pattern to the library, and its versions are kept here, side by side."
            self.words = text(words, "quiet small pad", "p")
            self.shelf = group("shelf")
        ui.context.client.on_delete(session.on_library(self.refresh))

    def shown(self, seen: bool) -> None:
        """Tell whether it is looked at."""
        self._seen = seen
        self.refresh()

    def refresh(self) -> None:
        """Look again, where it is looked at."""
        if self._seen:
            background_tasks.create(self._list())

    async def _list(self) -> None:
        name = self.session.pattern
        found = await self.session.shelf.versions(name) if name else []
        state = name, len(found)
        if state != self._drawn:
            self._drawn = state
            self.words.set_visibility(not found)
            self.shelf.clear()
            self._cards = {}
            with self.shelf:
                for number, each in enumerate(found):
                    self._card(each, newest=number == 0)
        for reference, button in self._cards.items():
            mark(button, reference == self.session.reference)

    def _card(self, version: Version, *, newest: bool) -> None:
        when = version.saved[:16].replace("T", " ")
        reference = f"{version.name}@{version.number}"
        with group("versioned"):
            said = f"{reference}, saved {when}"
            open_it = telling(lambda: self.session.open_pattern(reference))
            label = f"Version {version.number}"
            self._cards[reference] = card(version.name, label, said, open_it, version.number)
            text(when, "quiet small")
            if newest:
                text("the newest", "quiet small")
            else:
                word_button("Restore", telling(lambda: self._restore(reference)), icon="history")

    async def _restore(self, reference: str) -> None:
        report(await self.session.restore(reference))
