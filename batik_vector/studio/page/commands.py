"""The commands of the bar: menus, their keys, and the dialogs that ask for more."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from nicegui import ui

from batik_vector.studio import changes
from batik_vector.studio.mirroring import mirrored
from batik_vector.studio.page import dialogs
from batik_vector.studio.page.exploring import explore
from batik_vector.studio.page.exporting import export
from batik_vector.studio.page.parts import icon_button, report, telling, word_button

if TYPE_CHECKING:
    from batik_vector.studio.page.session import Session

Action = Callable[[], Any]


class Commands:
    """What a tab can be told to do."""

    def __init__(self, session: Session) -> None:
        self.session = session
        self._undo: list[ui.element] = []
        self._redo: list[ui.element] = []
        alter = session.alter
        self.actions: dict[str, Action] = {
            "new": lambda: dialogs.begin(session),
            "open": lambda: ui.run_javascript("studio.choose()"),
            "save": self._save,
            "save-as": lambda: dialogs.save_as(session),
            "export": lambda: export(session),
            "undo": session.undo,
            "redo": session.redo,
            "copy": self._copy,
            "paste": lambda: dialogs.paste(session),
            "duplicate": session.duplicate,
            "mirror-across": lambda: alter("mirrored", mirrored),
            "mirror-down": lambda: alter("mirrored", lambda draft: mirrored(draft, upright=False)),
            "turn": lambda: alter("turned", lambda draft: changes.turned(draft, 90)),
            "scale": lambda: dialogs.scale(session),
            "reset": lambda: alter("motifs reset", lambda draft: changes.reset(draft, "motif")),
            "vary": session.vary,
            "explore": lambda: explore(session),
            "keys": dialogs.keys,
            "true-size": dialogs.true_size,
        }

    def do(self, name: str) -> Callable[..., Any]:
        """Return an action that tells what goes wrong with it."""
        return telling(lambda: self.actions[name]())

    def menus(self) -> None:
        """Draw the menus."""
        for title, rows in MENUS.items():
            button = word_button(title).props("aria-haspopup=menu").classes("menu-name")
            with button, ui.menu().props(f'role=menu auto-close aria-label="{title}"'):
                for row in rows:
                    if row is None:
                        ui.separator()
                    else:
                        self._item(*row)

    def _item(self, label: str, name: str, key: str) -> None:
        with ui.item(on_click=self.do(name)).props("dense clickable role=menuitem") as item:
            with ui.item_section():
                ui.item_label(label)
            if key:
                with ui.item_section().props("side"):
                    ui.item_label(key).classes("quiet small")
        {"undo": self._undo, "redo": self._redo}.get(name, []).append(item)

    def buttons(self) -> None:
        """Draw the commands that are always at hand."""
        self._undo.append(icon_button("undo", "Undo", self.do("undo"), tip="Undo (Ctrl+Z)"))
        self._redo.append(icon_button("redo", "Redo", self.do("redo"), tip="Redo (Ctrl+Shift+Z)"))
        explore = word_button("Explore", self.do("explore"), icon="grid_view").classes("worded")
        explore.props('aria-label="Explore variations"').tooltip("A sheet of variations (Ctrl+Shift+E)")
        icon_button("save", "Save to the library", self.do("save"), tip="Save to the library (Ctrl+S)")

    def keys(self) -> None:
        """Listen to keys."""

        async def pressed(event: Any) -> None:
            if event.args in self.actions:
                await self.do(event.args)()

        ui.on("studio-key", pressed)

    def refresh(self) -> None:
        """Show what can be taken back."""
        for buttons, on in ((self._undo, self.session.can_undo), (self._redo, self.session.can_redo)):
            for each in buttons:
                if ("disable" in each.props) == on:
                    each.props(remove="disable") if on else each.props("disable")

    async def _save(self) -> None:
        if self.session.pattern and not self.session.is_included:
            await dialogs.saved(self.session, self.session.pattern)
        else:
            dialogs.save_as(self.session)

    def _copy(self) -> None:
        ui.clipboard.write(self.session.draft.whole)
        report("The recipe is on the clipboard.")


MENUS: dict[str, tuple[tuple[str, str, str] | None, ...]] = {
    "File": (
        ("New …", "new", ""),
        ("Open a file …", "open", "Ctrl+O"),
        None,
        ("Save to the library", "save", "Ctrl+S"),
        ("Save as …", "save-as", "Ctrl+Shift+S"),
        None,
        ("Export …", "export", "Ctrl+E"),
    ),
    "Edit": (
        ("Undo", "undo", "Ctrl+Z"),
        ("Redo", "redo", "Ctrl+Shift+Z"),
        None,
        ("Copy the recipe", "copy", ""),
        ("Paste a recipe", "paste", ""),
        ("Duplicate", "duplicate", ""),
    ),
    "Pattern": (
        ("Mirror left and right", "mirror-across", ""),
        ("Mirror top and bottom", "mirror-down", ""),
        ("Turn by a quarter", "turn", ""),
        ("Scale …", "scale", ""),
        None,
        ("Random variation", "vary", ""),
        ("Explore variations …", "explore", "Ctrl+Shift+E"),
        ("Reset to the paper's defaults", "reset", ""),
    ),
    "View": (
        ("True size of this screen …", "true-size", ""),
        ("Keys …", "keys", "?"),
    ),
}
