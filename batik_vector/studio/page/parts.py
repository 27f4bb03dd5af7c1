"""Small pieces that the page is put together from: buttons that say what they do, and groups of elements."""

from __future__ import annotations

import asyncio
import inspect
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from typing import Any

from nicegui import ui

from batik_vector.errors import BatikError
from batik_vector.recipe.palettes import PALETTES


def icon_button(icon: str, label: str, action: Callable[..., Any], *, tip: str = "") -> ui.button:
    """Return a button with a picture alone; its label is read out, and told when it is pointed at."""
    made = (
        ui.button(icon=icon, on_click=action, color=None)
        .props(f'flat dense aria-label="{label}"')
        .classes("plain")
    )
    with made:
        ui.tooltip(tip or label).props("delay=500 aria-hidden=true")
    return made


def word_button(
    label: str, action: Callable[..., Any] | None = None, *, icon: str | None = None
) -> ui.button:
    """Return a quiet button with a word on it."""
    return (
        ui.button(label, on_click=action, icon=icon, color=None).props("flat dense no-caps").classes("plain")
    )


def offering(field: ui.input, label: str, words: Sequence[str], take: Callable[[str], Any]) -> ui.button:
    """Put a button at the end of a field, with a menu of words that it may say; it takes others, too.

    Args:
        field: that words are offered for.
        label: of the button, read out.
        words: offered; a name of a palette stands beside its colours.
        take: given the word that is chosen.
    """
    with field.add_slot("append"):
        made = ui.button(icon="arrow_drop_down", color=None).props(f'flat dense aria-label="{label}"')
        with made.classes("plain offered"), ui.menu().props("role=menu auto-close"):
            for each in words:
                menu_row(each, partial(take, each))
    return made


def menu_row(word: str, action: Callable[..., Any], colours: Sequence[str] = ()) -> None:
    """Draw a row of a menu; a name of a palette, or of other colours, stands beside them."""
    colours = colours or (PALETTES[word].colours if word in PALETTES else ())
    with ui.menu_item(on_click=action).props("dense role=menuitem"):
        with ui.item_section():
            text(word)
        if colours:
            with ui.item_section().props("side"), group("dots"):
                for colour in colours:
                    group("dot").style(f"background: {colour}")


def main_button(label: str, action: Callable[..., Any]) -> ui.button:
    """Return the button for what one most likely wants."""
    return ui.button(label, on_click=action, color=None).props("unelevated no-caps").classes("accent")


@contextmanager
def told() -> Iterator[None]:
    """Tell in words what goes wrong, and go on."""
    try:
        yield
    except BatikError as error:
        complain(str(error))


def complain(words: str) -> None:
    """Tell what is wrong; it stays until it is closed."""
    ui.notify(words, classes="told wrong", multi_line=True, close_button="Close", timeout=12000)


def report(words: str) -> None:
    """Tell what was done; it goes by itself."""
    ui.notify(words, classes="told")


def telling(action: Callable[..., Any]) -> Callable[..., Any]:
    """Return an action that tells in words what goes wrong; it may be one that takes a while."""

    async def done(*_: Any) -> None:
        with told():
            result = action()
            if inspect.isawaitable(result):
                await result

    return done


def group(classes: str, tag: str = "div") -> ui.element:
    """Return a plain box."""
    return ui.element(tag).classes(classes)


def text(words: str, classes: str = "", tag: str = "span") -> ui.element:
    """Return words in a box; what they say is set by :func:`say`."""
    made = ui.element(tag).classes(classes)
    say(made, words)
    return made


def say(element: ui.element, words: str) -> None:
    """Set what a box of :func:`text` says, where that is something else."""
    if element._text != words:
        element._text = words
        element.update()


def toggled(button: ui.button, on: bool) -> None:
    """Show whether a button that stays pressed is so."""
    (button.classes(add="on") if on else button.classes(remove="on")).props(
        f"aria-pressed={'true' if on else 'false'}"
    )


class Soon:
    """Something that is done once nobody has asked for it for a while."""

    def __init__(self, action: Callable[[], Any]) -> None:
        self._action, self._client = action, ui.context.client
        self._alarm: asyncio.TimerHandle | None = None

    def __call__(self, seconds: float) -> None:
        """Do it after so many seconds, unless it is asked for anew before."""
        self.cancel()
        self._alarm = asyncio.get_running_loop().call_later(seconds, self._do)

    def cancel(self) -> None:
        """Do it no more."""
        if self._alarm is not None:
            self._alarm.cancel()

    def _do(self) -> None:
        if not self._client.is_deleted:
            with self._client.content:
                self._action()
