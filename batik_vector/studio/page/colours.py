"""The menu in which colours a design is looked at: its own, those of its colourways, of palettes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

from nicegui import ui

from batik_vector.recipe.palettes import PALETTES
from batik_vector.studio.page.parts import icon_button, menu_row, text, toggled

if TYPE_CHECKING:
    from batik_vector.studio.drafts import Draft

WRITTEN = ""
"""No colourway: the colours that the recipe has."""
AS_WRITTEN = "as written"


def colourways(draft: Draft) -> Mapping[str, tuple[str, ...]]:
    """Return the names of a draft's colourways, each with the colours that it says itself or by a palette."""
    tables = {} if draft.faults else draft.tables.get("colourway", {})
    return {name: _colours(each) for name, each in tables.items()} if isinstance(tables, dict) else {}


def _colours(spec: Mapping[str, Any]) -> tuple[str, ...]:
    palette = PALETTES.get(str(spec.get("palette", "")))
    own = [spec.get("cloth"), *dict(spec.get("ink", {})).values()]
    return tuple(str(each) for each in own if each) or (palette.colours if palette else ())


class Colours:
    """A button with the menu; it stays pressed while other colours than the recipe's are looked at."""

    def __init__(self, look: Callable[[str], None]) -> None:
        """Draw it.

        Args:
            look: called with the colourway that is chosen, or palette; ``WRITTEN`` for the recipe's own.
        """
        self.name = WRITTEN
        self._look = look
        self._known: Mapping[str, tuple[str, ...]] | None = None
        with icon_button("palette", "Colours", lambda: None) as self._button:
            self._menu = ui.menu().props('role=menu auto-close aria-label="Colours"')

    def refresh(self, draft: Draft) -> None:
        """List what a draft offers; a colourway that it no longer has is left."""
        if draft.faults:
            return
        known = colourways(draft)
        if self.name and self.name not in (*known, *PALETTES):
            self.name = WRITTEN
        if known != self._known:
            self._known = known
            self._list(known)
        self._mark()

    def _list(self, known: Mapping[str, tuple[str, ...]]) -> None:
        self._menu.clear()
        with self._menu:
            menu_row(AS_WRITTEN, partial(self._choose, WRITTEN))
            for name, colours in known.items():
                menu_row(name, partial(self._choose, name), colours)
            ui.separator()
            text("Palettes", "quiet small menu-head")
            for name in PALETTES:
                if name not in known:
                    menu_row(name, partial(self._choose, name))

    def _choose(self, name: str) -> None:
        self.name = name
        self._mark()
        self._look(name)

    def _mark(self) -> None:
        toggled(self._button, bool(self.name))
        self._button.props(f'aria-label="Colours: {self.name or AS_WRITTEN}"')
