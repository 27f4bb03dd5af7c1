"""The page: a bar of commands, the library on the left, the display, and parameters on the right."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from nicegui import ui

from batik_vector.studio.drops import MOTIF_NOW
from batik_vector.studio.page.commands import Commands
from batik_vector.studio.page.controls import Controls
from batik_vector.studio.page.display import Display
from batik_vector.studio.page.library import LibraryPanel, VersionsPanel
from batik_vector.studio.page.parts import (
    Soon,
    complain,
    group,
    icon_button,
    main_button,
    report,
    say,
    text,
    told,
)
from batik_vector.studio.page.recipe_text import RecipeText

if TYPE_CHECKING:
    from batik_vector.studio.page.session import Session

HEAD = (
    '<link rel="stylesheet" href="/studio/static/studio.css">'
    '<script src="/studio/static/display.js"></script>'
    '<script src="/studio/static/live.js"></script>'
)
SOON, CALM = 0.03, 0.35
"""Seconds after a change until words and panels follow the picture, and after one of a slider that is held:
to tell a page of elements anything keeps its browser busy for as long as a picture takes."""
MARK = (
    '<svg viewBox="0 0 32 32" aria-hidden="true"><g fill="none" stroke="currentColor" stroke-width="2.4">'
    '<ellipse cx="16" cy="7.6" rx="4" ry="6.4"/><ellipse cx="16" cy="24.4" rx="4" ry="6.4"/>'
    '<ellipse cx="7.6" cy="16" rx="6.4" ry="4"/><ellipse cx="24.4" cy="16" rx="6.4" ry="4"/></g></svg>'
)


def page_of(session: Session) -> Callable[[], None]:
    """Return what builds the page for each tab that is opened."""

    def page() -> None:
        Page(session)

    return page


class Page:
    """One tab of the studio."""

    def __init__(self, session: Session) -> None:
        self.session = session
        ui.add_head_html(HEAD)
        ui.colors(primary="#2b4a8b")
        self.dark = ui.dark_mode(None)
        self.commands = Commands(session)
        self.frame = group("frame")
        with self.frame:
            with group("bar", "header"):
                self._bar()
            with group("side left", "aside").props('aria-label="Library"') as drawer:
                self._left()
            drawer.on("keydown.escape", self._close_left)
            # On a narrow page the library lies over the display, and goes when that is clicked.
            group("veil").on("click", self._close_left)
            self.display = Display(session, lambda: self._soon(SOON))
            with group("side right", "aside").props('aria-label="Parameters"'):
                self._right()
        self.commands.keys()
        client = ui.context.client
        self._soon = Soon(self._show_rest)
        forget = session.listen(self.refresh)
        client.on_delete(forget)
        client.on_connect(self._look_at_screen)
        ui.on("studio-pasted", self._pasted)
        ui.on("studio-refused", lambda event: complain(str(event.args)))
        ui.on("studio-dropped", self._dropped)
        self.display.refresh()
        self._show_rest()

    def _bar(self) -> None:
        icon_button("menu", "Library", self._open_left).classes("narrow")
        with group("brand"):
            ui.html(MARK, sanitize=False)
            text("batik_vector", "wide")
        self.commands.menus()
        with group("what"):
            self.title = text("", "title", "h1")
            self.state = text("", "chip")
        self.commands.buttons()
        icon_button("contrast", "Light or dark", self._contrast)
        main_button("Export", self.commands.do("export"))

    def _left(self) -> None:
        with ui.tabs().props("align=left dense no-caps") as tabs:
            ui.tab("library", "Library")
            ui.tab("versions", "Versions")
        with ui.tab_panels(tabs, value="library").props("animated=false keep-alive"):
            with ui.tab_panel("library"):
                self.library = LibraryPanel(self.session)
            with ui.tab_panel("versions"):
                self.versions = VersionsPanel(self.session)
        tabs.on_value_change(lambda event: self.versions.shown(event.value == "versions"))

    def _right(self) -> None:
        with ui.tabs().props("align=left dense no-caps") as tabs:
            ui.tab("parameters", "Parameters")
            ui.tab("recipe", "Recipe")
        with ui.tab_panels(tabs, value="parameters").props("animated=false keep-alive"):
            with ui.tab_panel("parameters"):
                self.controls = Controls(self.session)
            with ui.tab_panel("recipe"):
                self.recipe = RecipeText(self.session)
        tabs.on_value_change(lambda event: self.recipe.shown(event.value == "recipe"))

    def refresh(self) -> None:
        """Show what is open now: the picture first."""
        self.display.refresh()
        self._soon(CALM if self.session.held else SOON)

    def _show_rest(self) -> None:
        if self.session.held:
            # A hand that rests sees what it has.
            self.session.held = False
            self.display.refresh()
        say(self.title, self.session.title)
        say(self.state, self.session.state)
        self.commands.refresh()
        self.controls.refresh()
        self.recipe.refresh()
        self.versions.refresh()
        self.library.mark()

    def _pasted(self, event: Any) -> None:
        with told():
            self.session.paste(str(event.args))

    def _dropped(self, event: Any) -> None:
        report(str(event.args))
        placed = self.session.draft.tables.get("place") if not self.session.draft.faults else None
        if str(event.args).endswith(MOTIF_NOW) and placed:
            # The next that a hand wants is to set it somewhere, and in some size.
            self.controls.reveal("panel:layout", f"place[{len(placed) - 1}]")

    def _open_left(self) -> None:
        self.frame.classes(toggle="open")

    def _close_left(self) -> None:
        self.frame.classes(remove="open")

    async def _look_at_screen(self) -> None:
        """Begin dark where the system is."""
        if self.dark.value is None:
            dark = await ui.run_javascript("matchMedia('(prefers-color-scheme: dark)').matches", timeout=5)
            self._set_dark(bool(dark))

    def _set_dark(self, dark: bool) -> None:
        self.dark.value = dark
        self.recipe.darken(dark)

    def _contrast(self) -> None:
        self._set_dark(not self.dark.value)
