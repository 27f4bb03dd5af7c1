"""The dialogs of the page: each is made when it is asked for, and gone when it is closed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

from nicegui import ui

from batik_vector.errors import BatikError
from batik_vector.studio.page.parts import group, icon_button, main_button, say, text, word_button

if TYPE_CHECKING:
    from batik_vector.studio.page.session import Session


@contextmanager
def dialog(title: str, classes: str = "") -> Iterator[ui.dialog]:
    """Open a dialog with a title and a way out; what is drawn inside stands below the title."""
    # In the page's own box: what is drawn inside a menu goes when the menu closes.
    with ui.context.client.content, ui.dialog() as made, ui.card().classes(f"dialog {classes}"):
        made.props(f'aria-label="{title}"').on("hide", made.delete)
        with group("dialog-head"):
            text(title, "dialog-title", "h2")
            icon_button("close", "Close", made.close)
        yield made
    made.open()


@contextmanager
def told() -> Iterator[None]:
    """Tell what goes wrong in words."""
    try:
        yield
    except BatikError as error:
        ui.notify(str(error), type="negative", multi_line=True, close_button="Close")


def buttons(made: ui.dialog, label: str, action: Callable[[], Any]) -> ui.button:
    """Draw the two buttons that end a dialog."""
    with group("dialog-foot"):
        word_button("Cancel", made.close)
        return main_button(label, action)


def begin(session: Session) -> None:
    """Ask for a starter to begin with."""
    with dialog("New pattern", "wide") as made:
        text("Begin with a starter: each is a page long, and says what its numbers do.", "quiet")
        shelf = group("shelf starters scroll")

    async def fill() -> None:
        async def chosen(name: str) -> None:
            with told():
                await session.open_pattern(name)
            made.close()

        found = [hit for hit in await session.shelf.find("") if hit.name.startswith("starter/")]
        with shelf:
            for hit in sorted(found, key=lambda hit: hit.name):
                button = ui.element("button").classes("pattern").props("type=button")
                with button:
                    address = f"/studio/thumbnail?name={quote(f'{hit.name}@{hit.version}')}"
                    ui.element("img").props(f'src="{address}" alt="" loading=lazy')
                    text(hit.title or hit.name, "name")
                button.on("click", lambda name=hit.name: chosen(name))

    with made:
        ui.timer(0, fill, once=True)


def save_as(session: Session) -> None:
    """Ask for a name in the library, and save."""
    with dialog("Save to the library") as made:
        name = (
            ui.input("Name", value=session.suggested_name()).props("outlined dense autofocus").classes("full")
        )
        tags = ui.input("Tags, with commas between").props("outlined dense").classes("full")
        note = ui.textarea("Note").props("outlined dense autogrow").classes("full")
        wrong = text("", "wrong").props("role=alert")

        async def save() -> None:
            try:
                words = await session.save(
                    name.value or "",
                    [each.strip() for each in (tags.value or "").split(",") if each.strip()],
                    note.value or "",
                )
            except BatikError as error:
                say(wrong, str(error))
                return
            ui.notify(words, type="positive")
            made.close()

        name.on("keydown.enter", save)
        buttons(made, "Save", save)


def paste(session: Session) -> None:
    """Ask for a recipe's text."""
    with dialog("Paste a recipe", "wide") as made:
        field = (
            ui.textarea("A recipe in TOML")
            .props("outlined autofocus rows=16 spellcheck=false")
            .classes("full mono")
        )

        def take() -> None:
            with told():
                session.paste(field.value or "")
                made.close()

        buttons(made, "Take it", take)


def true_size() -> None:
    """Let the user hold a card to the screen, so that 1:1 is true."""
    with dialog("True size of this screen") as made:
        text("Hold a bank card, 85.6 mm wide, to the bar, and drag until both are equally long.", "quiet")
        bar = group("card-bar")
        slider = ui.slider(min=200, max=700, step=1, value=324).props(
            'aria-label="Width of the card on screen"'
        )
        slider.on_value_change(lambda event: bar.style(f"width: {event.value}px"))
        bar.style("width: 324px")

        def apply() -> None:
            ui.run_javascript(f"studio.calibrate({slider.value / 85.6}); studio.actual()")
            made.close()

        buttons(made, "Use it", apply)


KEYS = (
    ("Ctrl+Z, Ctrl+Shift+Z", "undo, redo"),
    ("Ctrl+S, Ctrl+Shift+S", "save to the library, save as"),
    ("Ctrl+E", "export"),
    ("Ctrl+O", "open a file"),
    ("In the display: arrow keys", "move"),
    ("+, −, 0, 1", "zoom in, zoom out, fit, true size"),
    ("On a slider: arrow keys", "one step; Page Up and Page Down, ten"),
    ("Double click, wheel, drag", "fit, zoom, move"),
)


def keys() -> None:
    """Show the keys."""
    with dialog("Keys"), group("keys", "dl"):
        for key, words in KEYS:
            text(key, "key", "dt")
            text(words, "", "dd")
