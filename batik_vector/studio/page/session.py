"""What is open in the studio: one draft with its history, which all tabs of the page show alike."""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from batik_vector.errors import BatikError, Fault, RecipeError
from batik_vector.studio.drafts import Draft
from batik_vector.studio.history import History
from batik_vector.studio.pictures import Picture, Pictures
from batik_vector.studio.shelf import Shelf

if TYPE_CHECKING:
    from batik_vector.studio.offers import Offer

KEPT = 32
"""Pictures that browsers can still ask for."""
INCLUDED = ("sample/", "starter/")


class Session:
    """What is open, and everyone who is to be told when that changes.

    Args:
        draft: what is worked at.
        library: the file of the library; the user's own where none is given.
        folder: where the studio keeps what must outlive it.
        pattern: the name that the draft has in the library, with ``@`` and its version.
    """

    def __init__(self, draft: Draft, *, library: str | None = None, folder: Path, pattern: str = "") -> None:
        self.history = History(draft)
        self.folder = folder
        self.shelf = Shelf(library)
        self.images = Pictures()
        self.reference = pattern
        self._saved = draft.whole
        self.pictures: dict[int, bytes] = {}
        self._number = 0
        self._compiling: tuple[Draft, tuple[Fault, ...]] | None = None
        self._listeners: list[Callable[[], None]] = []
        self._library_listeners: list[Callable[[], None]] = []

    @property
    def draft(self) -> Draft:
        """What is worked at."""
        return self.history.now

    @property
    def text(self) -> str:
        """Its page of TOML."""
        return self.draft.text

    @property
    def title(self) -> str:
        """What it is called."""
        return self.draft.title

    @property
    def faults(self) -> tuple[Fault, ...]:
        """What is wrong with it: what reading it tells, or else what compiling it told."""
        if self.draft.faults or self._compiling is None or self._compiling[0] is not self.draft:
            return self.draft.faults
        return self._compiling[1]

    @property
    def pattern(self) -> str:
        """Its name in the library, or nothing."""
        return self.reference.partition("@")[0]

    @property
    def is_included(self) -> bool:
        """Whether that is a name which nobody may save under."""
        return self.pattern.startswith(INCLUDED)

    @property
    def is_saved(self) -> bool:
        """Whether the library, or a file, has it as it is."""
        return self._saved == self.draft.whole

    @property
    def state(self) -> str:
        """Where it stands, in words."""
        if not self.reference:
            return "not in the library yet"
        return self.reference if self.is_saved else f"changed since {self.reference}"

    # Everyone who looks.

    def listen(self, callback: Callable[[], None]) -> Callable[[], None]:
        """Call back whenever what is open changes; return what ends that."""
        return _added(self._listeners, callback)

    def on_library(self, callback: Callable[[], None]) -> Callable[[], None]:
        """Call back whenever something was saved; return what ends that."""
        return _added(self._library_listeners, callback)

    def _tell(self) -> None:
        _call(self._listeners)

    # Changes.

    def change(self, draft: Draft, label: str, merge: str = "") -> None:
        """Go on with another draft; the one before can be had back."""
        if draft != self.draft:
            self.history.did(draft, label, merge)
            self._tell()

    def settle(self) -> None:
        """End a step of many small changes: the slider is let go."""
        self.history.settle()

    def set_value(self, path: str, value: Any, merge: str = "") -> None:
        """Set a value of the recipe, or reset it where it is None."""
        label = f"{path.rpartition('.')[2]} {'reset' if value is None else 'set'}"
        self._try(lambda: self.draft.with_value(path, value), label, merge)

    def lock(self, path: str, locked: bool) -> None:
        """Lock a value, or set it free."""
        self._try(lambda: self.draft.locking(path, locked), f"{path} {'locked' if locked else 'set free'}")

    def add(self, offer: Offer) -> None:
        """Add what is offered."""
        if offer.single:
            self._try(lambda: self.draft.with_value(offer.path, offer.value), f"{offer.label} added")
        else:
            self._try(lambda: self.draft.inserted(offer.path, offer.value), f"{offer.label} added")

    def remove(self, path: str) -> None:
        """Take a member of a list out, or a table."""
        self._try(lambda: self.draft.removed(path), f"{path} removed")

    def move(self, path: str, by: int) -> None:
        """Move a member up or down among its like."""
        from batik_vector.studio.drafts import parsed

        where = parsed(path)
        around = self.draft.value(where[:-1])
        place = list(around).index(where[-1]) if isinstance(around, dict) else int(where[-1])
        if 0 <= place + by < len(around):
            self._try(lambda: self.draft.moved(where, place + by), f"{path} moved")

    def _try(self, change: Callable[[], Draft], label: str, merge: str = "") -> None:
        """Make a change; what cannot be made is told and changes nothing."""
        try:
            self.change(change(), label, merge)
        except BatikError as error:
            from nicegui import ui

            ui.notify(str(error), type="negative", multi_line=True, close_button="Close")

    def type(self, text: str) -> None:
        """Take what was typed into the recipe's text, whatever it says."""
        self.change(self.draft.with_text(text), "text typed", "\0text")

    @property
    def can_undo(self) -> bool:
        """Whether a step can be taken back."""
        return self.history.can_undo

    @property
    def can_redo(self) -> bool:
        """Whether a step can be done again."""
        return self.history.can_redo

    def undo(self) -> None:
        """Take a step back."""
        if self.history.can_undo:
            self.history.undo()
            self._tell()

    def redo(self) -> None:
        """Do a step again."""
        if self.history.can_redo:
            self.history.redo()
            self._tell()

    # What is opened, and saved.

    async def open_pattern(self, reference: str) -> None:
        """Open a version of the library: ``kawung@3``, or the newest."""
        version = await self.shelf.version(reference)
        stem = version.name.rpartition("/")[2]
        draft = Draft(version.text, drawings=tuple(version.drawings.items()), stem=stem)
        self.take(draft, f"{version.name}@{version.number}")

    def take(self, draft: Draft, reference: str = "") -> None:
        """Open a draft; what was open before can be had back."""
        self.history.settle()
        self.reference, self._saved = reference, draft.whole if reference else ""
        if draft == self.draft:
            self._tell()
        self.change(draft, f"{draft.title} opened")

    def paste(self, text: str) -> None:
        """Open a recipe that is pasted.

        Raises:
            RecipeError: where it is none.
        """
        draft = Draft.of_text(text)
        if not draft.tables:
            raise RecipeError("there is no recipe in what was pasted")
        self.take(draft)

    def duplicate(self) -> None:
        """Go on with a copy that the library does not know."""
        title = f"{self.title} copy"
        self.reference, self._saved = "", ""
        self._try(lambda: self.draft.with_value("title", title), "duplicated")

    def suggested_name(self) -> str:
        """Return a name to save under."""
        return self.pattern.rpartition("/")[2] if self.pattern else self.draft.stem

    async def save(self, name: str, tags: Sequence[str] = (), note: str = "") -> str:
        """Save to the library; return in words what came of it.

        Raises:
            BatikError: where it does not compile, or the library does not take it.
        """
        draft = self.draft
        saved = await self.shelf.save(name, draft.recipe, tags, note)
        self.reference, self._saved = f"{saved.name}@{saved.number}", draft.whole
        self._tell()
        _call(self._library_listeners)
        return f"Saved as {self.reference}" if saved.fresh else f"{self.reference} says the same already"

    # Pictures.

    def compiled(self, picture: Picture) -> None:
        """Take note of what compiling a draft told."""
        self._compiling = picture.draft, picture.faults

    def keep(self, svg: bytes) -> int:
        """Keep a picture for browsers to fetch; return its number."""
        self._number += 1
        self.pictures[self._number] = svg
        self.pictures.pop(self._number - KEPT, None)
        return self._number

    def close(self) -> None:
        """End what works beside the studio."""
        self.images.close()
        self.shelf.close()


def _added(listeners: list[Callable[[], None]], callback: Callable[[], None]) -> Callable[[], None]:
    listeners.append(callback)

    def forget() -> None:
        if callback in listeners:
            listeners.remove(callback)

    return forget


def _call(listeners: list[Callable[[], None]]) -> None:
    for each in list(listeners):
        try:
            each()
        except Exception:  # a tab that has gone must not keep the others from being told
            logging.getLogger(__name__).exception("a tab could not be told")
