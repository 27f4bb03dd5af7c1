"""The contact sheet: variations of the draft at random, or over one or two of its numbers."""

from __future__ import annotations

import asyncio
from itertools import islice
from typing import TYPE_CHECKING

from nicegui import background_tasks, ui

from batik_vector.errors import BatikError
from batik_vector.studio.asking import View
from batik_vector.studio.changes import variations
from batik_vector.studio.page.dialogs import dialog
from batik_vector.studio.page.parts import group, say, telling, text, word_button
from batik_vector.studio.parameters import Control, controls

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from batik_vector.studio.drafts import Draft
    from batik_vector.studio.page.session import Session

ACROSS, DOWN = 4, 3
COARSE = View("tile", tolerance=0.4)
"""How small pictures are looked at."""
RANDOM = "at random"
SPARE = 4
"""Variations made besides, for those that cannot be drawn."""


def explore(session: Session) -> None:
    """Open the sheet."""
    with dialog("Explore variations", "sheet") as made:
        Exploring(session, made)


class Exploring:
    """A sheet of variations, from one of which one goes on."""

    def __init__(self, session: Session, made: ui.dialog) -> None:
        self.session, self.made = session, made
        self.client = ui.context.client
        self.draft = session.draft
        self.round = 0
        self.numbers = {
            each.path: each
            for each in controls(self.draft).values()
            if each.span is not None and each.kind in ("number", "whole") and (each.is_set or each.useful)
        }
        named = {path: in_words(path) for path in self.numbers}
        with group("sheet-tools"):
            self.across = _choice("Vary", {RANDOM: "all numbers, at random", **named}, RANDOM)
            self.down = _choice("and from row to row", {"": "nothing else", **named}, "")
            self.down.bind_enabled_from(self.across, "value", backward=lambda value: value != RANDOM)
            with group("reach"):
                text("How far from here", "quiet small")
                self.reach = ui.slider(min=0.1, max=1, step=0.05, value=0.5)
                self.reach.props('aria-label="How far from here"')
            self.others = word_button("Others", self._others, icon="casino")
            self.others.bind_visibility_from(self.across, "value", backward=lambda value: value == RANDOM)
        self.wrong = text("", "wrong", "p").props("role=alert")
        self.sheet = group("contact")
        self.seed = 0
        for each in (self.across, self.down):
            each.on_value_change(self._draw)
        self.reach.on("change", self._draw)
        made.on("hide", self._end)
        self._draw()

    def _end(self) -> None:
        self.round += 1

    def _others(self) -> None:
        self.seed += 1
        self._draw()

    def _drafts(self) -> Iterator[tuple[str, Draft]]:
        """Yield the variations with what is said below them."""
        path = str(self.across.value or RANDOM)
        if path == RANDOM:
            found = variations(self.draft, self.seed, float(self.reach.value or 0.5))
            for draft in islice(found, ACROSS * DOWN + SPARE):
                yield "", draft
            return
        other = str(self.down.value or "")
        if not other or other == path:
            for value in _spread(self.numbers[path], ACROSS * DOWN, self.reach.value):
                yield f"{self.numbers[path].label} {value:g}", self.draft.with_value(path, value)
            return
        one, two = self.numbers[path].label, self.numbers[other].label
        for second in _spread(self.numbers[other], DOWN, self.reach.value):
            for value in _spread(self.numbers[path], ACROSS, self.reach.value):
                draft = self.draft.with_values([(path, value), (other, second)])
                yield f"{one} {value:g}, {two} {second:g}", draft

    def _draw(self) -> None:
        self.round += 1
        say(self.wrong, "")
        self.sheet.clear()
        with self.sheet:
            cards = [Card(self._take) for _ in range(ACROSS * DOWN)]
        background_tasks.create(self._fill(cards, self.round))

    async def _fill(self, cards: list[Card], mine: int) -> None:
        """Draw one variation after the other; at random, what leaves nothing to draw is passed over."""
        try:
            found = await asyncio.to_thread(lambda: list(self._drafts()))
        except BatikError as error:
            found = []
            say(self.wrong, str(error))
        passed = self.across.value == RANDOM
        used = 0
        for number, (words, draft) in enumerate(found):
            if used == len(cards) or mine != self.round or self.client.is_deleted or self.sheet.is_deleted:
                return
            cards[used].expect()
            picture = await self.session.images.ask(
                draft, COARSE, lane=f"\0sheet-{self.client.id}-{number}", background=True, limit=15
            )
            if mine != self.round or self.sheet.is_deleted or picture is None:
                return
            if picture.svg:
                said = words or f"Variation {used + 1}"
                cards[used].show(draft, said, self.session.keep(picture.svg))
            elif not passed:
                # Its place in the rows stays.
                cards[used].miss(f"{words}: nothing to draw")
            used += bool(picture.svg) or not passed
        for left in cards[used:]:
            left.box.delete()

    def _take(self, draft: Draft) -> None:
        self.session.alter("variation taken", lambda _: draft)
        self.made.close()


class Card:
    """A place of the sheet: empty until its variation is drawn."""

    def __init__(self, take: Callable[[Draft], None]) -> None:
        self._take = take
        self.box = ui.element("button").classes("pattern").props("type=button disabled")
        with self.box:
            self._picture = ui.element("img").props('alt=""')
            self._words = text("", "name")

    def expect(self) -> None:
        """Show that it is being drawn."""
        self._picture.classes("drawing")

    def show(self, draft: Draft, words: str, number: int) -> None:
        """Show a variation, from which one may go on."""
        say(self._words, words)
        self._picture.classes(remove="drawing").props(f'src="/studio/picture/{number}"')
        self.box.props(remove="disabled").on("click", telling(lambda: self._take(draft)))

    def miss(self, words: str) -> None:
        """Say why there is none."""
        say(self._words, words)
        self._picture.classes(remove="drawing")


def _choice(label: str, names: dict[str, str], value: str) -> ui.select:
    """Return a list to choose from, in which one may look for words: recipes have a hundred numbers."""
    return ui.select(names, value=value, label=label, with_input=True).props("outlined dense options-dense")


def in_words(path: str) -> str:
    """Return a path as it is read: ``motif.flower.petal.length`` is the length of flower, petal."""
    *around, last = path.removeprefix("motif.").replace("_", " ").split(".")
    return f"{last} of {', '.join(around)}" if around else last


def _spread(control: Control, count: int, reach: float | None) -> list[float]:
    """Return values of a control from end to end of its slider, or as near to its own as the reach says."""
    low, high = control.span or (0.0, 1.0)
    value = float(control.value) if isinstance(control.value, int | float) else (low + high) / 2
    share = float(reach or 1)
    first, last = value + (low - value) * share, value + (high - value) * share
    found = [first + (last - first) * number / max(count - 1, 1) for number in range(count)]
    if control.kind == "whole":
        return list(dict.fromkeys(round(each) for each in found))
    return [float(f"{each:.3g}") for each in found]
