"""The dialogs of the page: each is made when it is asked for, and gone when it is closed."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from nicegui import ui

from batik_vector.errors import BatikError
from batik_vector.library.names import name_from
from batik_vector.studio import changes
from batik_vector.studio.page.library import Thumb
from batik_vector.studio.page.parts import (
    group,
    icon_button,
    main_button,
    report,
    say,
    text,
    told,
    word_button,
)
from batik_vector.studio.saving import NewerError

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
                    Thumb(f"{hit.name}@{hit.version}")
                    text(hit.title or hit.name, "name")
                button.on("click", lambda name=hit.name: chosen(name))

    with made:
        ui.timer(0, fill, once=True)


async def saved(session: Session, name: str, tags: Sequence[str] = (), note: str = "") -> None:
    """Save, and tell so; where somebody else has saved meanwhile, ask what is to be done.

    Raises:
        BatikError: where it cannot be saved.
    """
    try:
        report(await session.save(name, tags, note))
    except NewerError as error:
        _ask_over(session, name, str(error))


def _ask_over(session: Session, name: str, words: str) -> None:
    with dialog("There is a newer version") as made:
        text(words, "", "p")

        async def over() -> None:
            with told():
                report(await session.save(name, over=True))
            made.close()

        buttons(made, "Save over it", over)


def save_as(session: Session) -> None:
    """Ask for a name in the library, and save."""
    with dialog("Save to the library") as made:
        name = ui.input("Name", value=session.suggested_name()).props("outlined autofocus").classes("full")
        tags = ui.input("Tags, with commas between").props("outlined").classes("full")
        note = ui.textarea("Note").props("outlined autogrow").classes("full")
        wrong = text("", "wrong").props("role=alert")

        async def save() -> None:
            tagged = [each.strip() for each in (tags.value or "").split(",") if each.strip()]
            # A name is made one that the library and all systems take; what came of it is told.
            called = name_from((name.value or "").strip() or session.suggested_name())
            name.set_value(called)
            go.props("loading")
            try:
                if session.is_included:
                    session.entitle(called)
                await saved(session, called, tagged, note.value or "")
            except BatikError as error:
                say(wrong, str(error))
                return
            finally:
                go.props(remove="loading")
            made.close()

        name.on("keydown.enter", save)
        go = buttons(made, "Save", save)


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


def scale(session: Session) -> None:
    """Ask how broad the tile is to be, or for a factor, and scale the pattern."""
    recipe = None if session.draft.faults else session.draft.recipe
    cell = recipe.tiling.cell() if recipe is not None and recipe.tile is not None else None
    with dialog("Scale the pattern") as made:
        text("Tile, placements and gaps grow together; shapes and counts stay.", "quiet", "p")
        factor = ui.number("Factor", value=1.5, min=0.001, max=1000, step=0.1).props("outlined autofocus")
        factor.classes("full")
        if cell is not None:
            width = ui.number("Width of the tile in mm").props("outlined").classes("full")
            size = text("", "quiet small", "p")

            def by_factor() -> None:
                across, up = (each * float(factor.value or 1) for each in (cell.width, cell.height))
                say(size, f"{cell.width:g} × {cell.height:g} mm become {across:.6g} × {up:.6g} mm")
                width.set_value(float(f"{across:.6g}"))

            width.on("change", lambda: factor.set_value(float(width.value or cell.width) / cell.width))
            factor.on_value_change(by_factor)
            by_factor()

        def apply() -> None:
            with told():
                by = float(factor.value or 1)
                session.alter(f"scaled by {by:g}", lambda draft: changes.scaled(draft, by))
                made.close()

        buttons(made, "Scale", apply)


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
    ("Ctrl+E, Ctrl+Shift+E", "export, explore variations"),
    ("Ctrl+O", "open a file"),
    ("In the display: arrow keys", "move"),
    ("+, −, 0, 1", "zoom in, zoom out, fit, true size"),
    ("On a slider: arrow keys", "a step (Page Up, Page Down: ten)"),
    ("Double click, wheel, drag", "fit, zoom, move"),
)


def keys() -> None:
    """Show the keys."""
    with dialog("Keys"), group("keys", "dl"):
        for key, words in KEYS:
            text(key, "key", "dt")
            text(words, "", "dd")
