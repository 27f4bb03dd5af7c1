"""What is open in the studio: one draft with its history, which all tabs of the page show alike."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from batik_vector.errors import BatikError, Fault
from batik_vector.studio import changes, drops
from batik_vector.studio.aside import Aside
from batik_vector.studio.changes import set_by_hand
from batik_vector.studio.drafts import Draft, parsed
from batik_vector.studio.journal import Desk
from batik_vector.studio.page.listeners import added, call
from batik_vector.studio.page.trying import held
from batik_vector.studio.pictures import Picture, Pictures
from batik_vector.studio.saving import Saving, fingerprint, save
from batik_vector.studio.shelf import Shelf

if TYPE_CHECKING:
    from batik_vector.studio.asking import View
    from batik_vector.studio.offers import Offer
    from batik_vector.studio.page.live import Live

KEPT = 32
"""Pictures that browsers can still ask for."""
FORESIGHT = 20.0
"""Seconds after which nobody wants to be told any more how long it will take."""
PRESSED = 1.0
"""Seconds within which another press of a key belongs to the same step."""
INCLUDED = ("sample/", "starter/")


class Session:
    """What is open, and everyone who is to be told when that changes.

    Args:
        desk: the draft that is worked at, with its history.
        library: the file of the library; the user's own where none is given.
    """

    def __init__(self, desk: Desk, *, library: str | None = None) -> None:
        self.desk = desk
        self.library = library
        self.aside = Aside()
        # Small pictures never keep the large one waiting.
        self._sketches = Aside(yields=True)
        self.shelf = Shelf(self._sketches, library)
        self.images = Pictures()
        self.tabs: dict[str, Live] = {}
        """The short ways to the tabs that are open, by the names of their clients."""
        self.pictures: dict[int, bytes] = {}
        self.files: dict[int, tuple[str, bytes]] = {}
        self._number = 0
        self._seed = 0
        self._settling: asyncio.TimerHandle | None = None
        self._compiling: tuple[Draft, tuple[Fault, ...]] | None = None
        self.saves = 0
        """How often a file was saved that is followed."""
        self.motif_held = ""
        """The motif whose slider was moved last, or nothing where it was not a motif's."""
        self.colourway = ""
        """The colourway, or palette, in which it is looked at; nothing for its own colours."""
        self.held = False
        """Whether a slider is in somebody's hand, and another value is about to come."""
        self._listeners: list[Callable[[], None]] = []
        self._library_listeners: list[Callable[[], None]] = []

    @property
    def draft(self) -> Draft:
        """What is worked at."""
        return self.desk.draft

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
        if self.draft.faults or self._compiling is None or self._compiling[0] != self.draft:
            return self.draft.faults
        return self._compiling[1]

    @property
    def reference(self) -> str:
        """Its name in the library with ``@`` and its version, or nothing."""
        return self._noted()[0]

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
        """Whether the library has it as it is."""
        return self._noted()[1] == fingerprint(self.draft.whole)

    @property
    def state(self) -> str:
        """Where it stands, in words."""
        if not self.reference:
            return "not in the library yet"
        name = self.pattern.replace("/", " ", 1) if self.is_included else self.reference
        return name if self.is_saved else f"{name}, changed"

    def _noted(self) -> tuple[str, str]:
        # By what it is called, for steps back may lead to another pattern.
        noted = self.desk.notes.get("saved", {}).get(self.draft.stem, ("", ""))
        return str(noted[0]), str(noted[1])

    def _note(self, stem: str, reference: str, whole: str) -> None:
        known = {key: value for key, value in self.desk.notes.get("saved", {}).items() if key != stem}
        if reference:
            known[stem] = [reference, fingerprint(whole)]
        self.desk.note(saved=known)

    # Everyone who looks.

    def listen(self, callback: Callable[[], None]) -> Callable[[], None]:
        """Call back whenever what is open changes; return what ends that."""
        return added(self._listeners, callback)

    def on_library(self, callback: Callable[[], None]) -> Callable[[], None]:
        """Call back whenever something was saved; return what ends that."""
        return added(self._library_listeners, callback)

    def _tell(self) -> None:
        call(self._listeners)

    def look_in(self, colourway: str) -> None:
        """Look at it in the colours of a colourway or a palette; nothing for its own."""
        self.colourway = colourway
        self._tell()

    # Changes.

    def change(self, draft: Draft, label: str, merge: str = "") -> None:
        """Go on with another draft; the one before can be had back."""
        if draft != self.draft:
            self._keep_open()
            self.desk.did(draft, label, merge)
            self._tell()

    def settle(self) -> None:
        """End a step of many small changes, soon: the slider is let go, and keys may press on."""
        self._keep_open()
        self._settling = asyncio.get_running_loop().call_later(PRESSED, self.desk.settle)

    def _keep_open(self) -> None:
        if self._settling is not None:
            self._settling.cancel()
            self._settling = None

    def set_value(self, path: str, value: Any, merge: str = "") -> None:
        """Set a value of the recipe, or reset it where it is None.

        Raises:
            BatikError: where it cannot be set; nothing is changed then.
        """
        label = f"{path.rpartition('.')[2]} {'reset' if value is None else 'set'}"
        self.change(set_by_hand(self.draft, path, value), label, merge)

    def slide(self, path: str, value: float, let_go: bool) -> None:
        """Set a value as a slider moves: all values until shortly after it is let go are one step.

        Raises:
            BatikError: where it cannot be set; nothing is changed then.
        """
        self.held = not let_go
        where = parsed(path)
        self.motif_held = str(where[1]) if where[0] == "motif" and len(where) > 1 else ""
        before = self.draft
        self.set_value(path, value, merge=path)
        if let_go:
            self.settle()
            if before == self.draft:
                # What waited for the hand is shown now.
                self._tell()

    def lock(self, path: str, locked: bool) -> None:
        """Lock a value, or set it free."""
        self.change(self.draft.locking(path, locked), f"{path} {'locked' if locked else 'set free'}")

    def add(self, offer: Offer) -> None:
        """Add what is offered."""
        add = self.draft.with_value if offer.single else self.draft.inserted
        self.alter(f"{offer.label} added", lambda _: add(offer.path, offer.value))

    def remove(self, path: str) -> None:
        """Take a member of a list out, or a table."""
        self.alter(f"{path} removed", lambda draft: draft.removed(path))

    def move(self, path: str, by: int) -> None:
        """Move a member up or down among its like."""
        where = parsed(path)
        around = self.draft.value(where[:-1]) if len(where) > 1 else self.draft.tables
        place = list(around).index(where[-1]) if isinstance(around, dict) else int(where[-1])
        if 0 <= place + by < len(around):
            self.alter(f"{path} moved", lambda draft: draft.moved(where, place + by))

    def type(self, text: str) -> None:
        """Take what was typed into the recipe's text, whatever it says."""
        self.change(self.draft.with_text(text), "text typed", "\0text")

    @property
    def can_undo(self) -> bool:
        """Whether a step can be taken back."""
        return self.desk.history.can_undo

    @property
    def can_redo(self) -> bool:
        """Whether a step can be done again."""
        return self.desk.history.can_redo

    def undo(self) -> None:
        """Take a step back."""
        if self.can_undo:
            self.desk.undo()
            self._tell()

    def redo(self) -> None:
        """Do a step again."""
        if self.can_redo:
            self.desk.redo()
            self._tell()

    # The menu.

    def alter(self, label: str, change: Callable[[Draft], Draft]) -> None:
        """Change the draft, as a step of its own.

        Raises:
            BatikError: where that cannot be done; nothing is changed then.
        """
        self.desk.settle()
        self.change(change(self.draft), label)
        self.desk.settle()

    async def vary(self) -> None:
        """Go on with a random variation that holds: another one each time, what is locked stays."""
        self._seed += 1
        begun, found = self.draft, await held(self.images, self.draft, self._seed)
        # Who has gone on meanwhile keeps what they have.
        if found is not None and self.draft is begun:
            self.alter("varied", lambda _: found)

    def copy_of(self, path: str) -> None:
        """Put a member of a list, a motif or an ink in twice."""
        self.alter(f"{path} copied", lambda draft: changes.duplicated(draft, path)[0])

    def duplicate(self) -> None:
        """Go on with a copy that the library does not know."""
        titled = self.draft.with_value("title", f"{self.title} copy")
        copy = replace(titled, stem=f"{self.draft.stem}-copy")
        self._note(copy.stem, "", "")
        self.alter("duplicated", lambda _: copy)

    # What is opened, and saved.

    async def open_pattern(self, reference: str) -> None:
        """Open a version of the library: ``kawung@3``, or the newest."""
        version = await self.shelf.version(reference)
        stem = version.name.rpartition("/")[2]
        draft = Draft(version.text, drawings=tuple(version.drawings.items()), stem=stem)
        self.take(draft, f"{version.name}@{version.number}")

    def take(self, draft: Draft, reference: str = "") -> None:
        """Open a draft; what was open before can be had back."""
        self._note(draft.stem, reference, draft.whole)
        if draft == self.draft:
            self._tell()
        self.alter(f"{draft.title} opened", lambda _: draft)

    def follow(self, draft: Draft) -> None:
        """Go on with what a file says by now; what was changed here since can be had back."""
        # What it names may have changed, and its own text not.
        self.saves += 1
        if draft.text == self.draft.text:
            self._tell()
        self.alter("file saved", lambda now: replace(draft, locked=now.locked))

    def paste(self, text: str) -> None:
        """Put in what is pasted: a whole recipe takes the draft's place, motifs and inks join it.

        Raises:
            RecipeError: where it is none.
        """
        self.alter("pasted", lambda draft: changes.pasted(draft, text)[0])

    async def drop(self, name: str, data: bytes) -> str:
        """Take a file in that was dropped; return in words what came of it.

        Raises:
            BatikError: saying what about the file is wrong.
        """
        draft, words = await self.aside.run(drops.PATIENCE, drops.taken_in, self.draft, name, data)
        self.alter(words, lambda _: draft)
        return words

    async def foreseen(self, draft: Draft, view: View) -> tuple[int, float]:
        """Return about how many vertices a picture will have, and seconds it will take; zeros if unknown."""
        from batik_vector.studio.views import foreseen

        try:
            return await self.aside.run(FORESIGHT, foreseen, draft, view)
        except BatikError:
            return 0, 0.0

    def suggested_name(self) -> str:
        """Return a name to save under."""
        return self.pattern if self.pattern and not self.is_included else self.draft.stem

    async def save(self, name: str, tags: Sequence[str] = (), note: str = "", *, over: bool = False) -> str:
        """Save to the library; return in words what came of it.

        Raises:
            NewerError: where somebody else has saved a newer version meanwhile.
            BatikError: where it does not compile, or the library does not take it.
        """
        draft = self.draft
        known, _, number = self.reference.partition("@")
        base = int(number) if known == name and number else 0
        wish = Saving(name, base, self.library or "", tuple(tags), note, over)
        saved, version, fresh = await asyncio.to_thread(save, draft, wish)
        self._note(draft.stem, f"{saved}@{version}", draft.whole)
        self._tell()
        call(self._library_listeners)
        return f"Saved as {saved}@{version}" if fresh else f"{saved}@{version} says the same already"

    def entitle(self, name: str) -> None:
        """Call what began with a pattern of ours by the name that it is saved under, its files likewise.

        Raises:
            BatikError: where the recipe's text is no TOML.
        """
        self.alter("named", lambda draft: replace(draft.with_value("title", name), stem=name))

    async def restore(self, reference: str) -> str:
        """Make an old version the newest, and open it; return in words what came of it."""
        saved = await self.shelf.restore(reference)
        await self.open_pattern(f"{saved.name}@{saved.number}")
        call(self._library_listeners)
        now = f"{saved.name}@{saved.number}"
        return f"{reference} is {now} now" if saved.fresh else f"{reference} is the newest"

    # Pictures and files.

    def compiled(self, picture: Picture) -> None:
        """Take note of what compiling a draft told."""
        self._compiling = picture.draft, picture.faults

    def keep(self, svg: bytes) -> int:
        """Keep a picture for browsers to fetch; return its number."""
        self._number += 1
        self.pictures[self._number] = svg
        self.pictures.pop(next(iter(self.pictures)) if len(self.pictures) > KEPT else 0, None)
        return self._number

    def keep_file(self, name: str, data: bytes) -> int:
        """Keep a file for the browser to fetch; return its number."""
        self._number += 1
        self.files = dict(list(self.files.items())[-3:]) | {self._number: (name, data)}
        return self._number

    def end_asides(self) -> None:
        """End what reads files and draws small pictures; whoever waits for any is told."""
        self.aside.end()
        self._sketches.end()

    def close(self) -> None:
        """End what works beside the studio; what is open stays kept."""
        self._keep_open()
        self.images.close()
        self.end_asides()
        self.desk.close()
