"""The menu in which colours a design is looked at: its own, those of its colourways, of palettes."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

from nicegui import ui

from batik_vector.recipe.palettes import PALETTES
from batik_vector.studio.page.parts import icon_button, menu_row, text, toggled

if TYPE_CHECKING:
    from batik_vector.studio.drafts import Draft
    from batik_vector.studio.page.session import Session

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

    def __init__(self, session: Session) -> None:
        """Draw it; what is chosen is the session's, and the same in all its tabs."""
        self._session = session
        self._known: Mapping[str, tuple[str, ...]] | None = None
        with icon_button("palette", "Colours", lambda: None) as self._button:
            self._menu = ui.menu().props('role=menu auto-close aria-label="Colours"')

    def refresh(self) -> None:
        """List what is open offers; a colourway that it no longer has is left."""
        if self._session.draft.faults:
            return
        known = colourways(self._session.draft)
        if self._session.colourway not in (WRITTEN, *known, *PALETTES):
            self._session.colourway = WRITTEN
        if known != self._known:
            self._known = known
            self._list(known)
        self._mark()

    def _list(self, known: Mapping[str, tuple[str, ...]]) -> None:
        self._menu.clear()
        with self._menu:
            menu_row(AS_WRITTEN, partial(self._session.look_in, WRITTEN))
            for name, colours in known.items():
                menu_row(name, partial(self._session.look_in, name), colours)
            ui.separator()
            text("Palettes", "quiet small menu-head")
            for name in PALETTES:
                if name not in known:
                    menu_row(name, partial(self._session.look_in, name))

    def _mark(self) -> None:
        name = self._session.colourway
        toggled(self._button, bool(name))
        self._button.props(f'aria-label="Colours: {name or AS_WRITTEN}"')
