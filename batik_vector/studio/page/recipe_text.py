"""The recipe's text beside the display: what sliders change is seen in it, and what is typed is drawn."""

from __future__ import annotations

from typing import TYPE_CHECKING

from nicegui import ui

from batik_vector.studio.page.parts import group

if TYPE_CHECKING:
    from batik_vector.studio.page.session import Session

PAUSE = 0.25
"""Seconds without a key after which what was typed is read."""


class RecipeText:
    """The editor."""

    def __init__(self, session: Session) -> None:
        self.session = session
        self._seen = self._dark = False
        self._typed = ""
        self.box = group("column")
        self._timer: ui.timer | None = None
        self.editor: ui.codemirror | None = None

    def shown(self, seen: bool) -> None:
        """Tell whether it is looked at; it is made when that is so for the first time."""
        self._seen = seen
        if seen and self.editor is None:
            with self.box:
                self._typed = self.session.text
                self.editor = ui.codemirror(
                    self._typed, language="TOML", line_wrapping=True, on_change=self._changed
                )
                self.editor.classes("grow")
                self.darken(self._dark)
        self.refresh()

    def darken(self, dark: bool) -> None:
        """Take a theme for a light or a dark page."""
        self._dark = dark
        if self.editor is not None:
            self.editor.theme = "githubDark" if dark else "githubLight"

    def refresh(self) -> None:
        """Show the text as it is now, unless it is this editor that says so."""
        if self.editor is not None and self._seen and self.editor.value != self.session.text:
            if self._timer is not None:
                return
            self.editor.value = self.session.text

    def _changed(self) -> None:
        if self.editor is None or self.editor.value == self.session.text:
            return
        if self._timer is not None:
            self._timer.cancel()
        with self.box:
            self._timer = ui.timer(PAUSE, self._read, once=True)

    def _read(self) -> None:
        self._timer = None
        if self.editor is not None and self.editor.value != self.session.text:
            self.session.type(self.editor.value)
