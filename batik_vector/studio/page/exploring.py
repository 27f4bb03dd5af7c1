"""The contact sheet: variations of the draft at random, or over one or two of its numbers."""

from __future__ import annotations

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
    from collections.abc import Iterator

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
        names = {RANDOM: "at random", **{path: path for path in self.numbers}}
        with group("sheet-tools"):
            self.across = ui.select(names, value=RANDOM, label="Vary").props("outlined dense")
            self.down = ui.select({"": "nothing else", **{p: p for p in self.numbers}}, value="", label="and")
            self.down.props("outlined dense")
            with group("reach"):
                text("How far", "quiet small")
                self.reach = ui.slider(min=0.1, max=1, step=0.05, value=0.5).props('aria-label="How far"')
            word_button("Others", self._others, icon="casino")
        self.wrong = text("", "wrong", "p").props("role=alert")
        self.sheet = group("contact scroll")
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
            for number, draft in enumerate(islice(found, ACROSS * DOWN + SPARE)):
                yield f"variation {number + 1}", draft
            return
        other = str(self.down.value or "")
        if not other or other == path:
            for value in _spread(self.numbers[path], ACROSS * DOWN, self.reach.value):
                yield f"{value:g}", self.draft.with_value(path, value)
            return
        for second in _spread(self.numbers[other], DOWN, self.reach.value):
            for value in _spread(self.numbers[path], ACROSS, self.reach.value):
                draft = self.draft.with_values([(path, value), (other, second)])
                yield f"{value:g}, {second:g}", draft

    def _draw(self) -> None:
        self.round += 1
        say(self.wrong, "")
        self.sheet.clear()
        try:
            found = list(self._drafts())
        except BatikError as error:
            say(self.wrong, str(error))
            return
        cards = []
        with self.sheet:
            for words, draft in found:
                button = ui.element("button").classes("pattern").props("type=button")
                with button:
                    picture = ui.element("img").props('alt=""')
                    text(words, "name")
                button.on("click", telling(lambda draft=draft: self._take(draft)))
                cards.append((draft, picture, button))
        background_tasks.create(self._fill(cards, self.round))

    async def _fill(self, cards: list[tuple[Draft, ui.element, ui.element]], mine: int) -> None:
        shown = 0
        for number, (draft, picture, card) in enumerate(cards):
            if mine != self.round or self.client.is_deleted or self.sheet.is_deleted:
                return
            if shown == ACROSS * DOWN:
                card.set_visibility(False)
                continue
            found = await self.session.images.ask(
                draft, COARSE, lane=f"\0sheet-{self.client.id}-{number}", background=True, limit=15
            )
            if mine != self.round or picture.is_deleted or found is None:
                return
            if found.svg:
                shown += 1
                picture.props(f'src="/studio/picture/{self.session.keep(found.svg)}"')
            else:
                # At random one comes upon what cannot be drawn, or leaves nothing to draw.
                card.set_visibility(False)

    def _take(self, draft: Draft) -> None:
        self.session.alter("variation taken", lambda _: draft)
        self.made.close()


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
