"""The export dialog: formats, the certificate's verdict, and the files as the command writes them."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from nicegui import background_tasks, ui

from batik_vector.errors import BatikError
from batik_vector.export import FORMATS
from batik_vector.machines import MACHINES
from batik_vector.processes.options import PROCESSES
from batik_vector.recipe.colourways import ALL
from batik_vector.recipe.palettes import PALETTES
from batik_vector.studio.asking import Wishes
from batik_vector.studio.exports import FULL, PAPERS, TAPED, Exported, download, on_paper
from batik_vector.studio.page.colours import colourways
from batik_vector.studio.page.dialogs import dialog
from batik_vector.studio.page.parts import group, main_button, offering, report, say, text, word_button
from batik_vector.studio.pictures import EXPORT

if TYPE_CHECKING:
    from batik_vector.studio.page.session import Session

USUAL = ("svg", "pdf")
"""What is ticked where a recipe asks for no files."""
NONE = "none"
LABELS = {"gcode": "G-code", "swatch": "Swatch"}
"""What formats are called whose names are not their letters."""
AS_SAID = ""
INKS = {AS_SAID: "as on the screen", "spot": "separations, a plate for each ink"}


def export(session: Session) -> None:
    """Open the dialog."""
    with dialog("Export", "wide") as made:
        Exporting(session, made)


class Exporting:
    """An export that is being put together."""

    def __init__(self, session: Session, made: ui.dialog) -> None:
        self.session, self.made = session, made
        self.draft = session.draft
        self.client = ui.context.client
        asked = self._asked()
        with group("verdict").props("role=status") as self.verdict_box:
            self.verdict = text("Measuring the tile for the seam certificate …", "quiet")
        with group("formats"):
            self.ticks = {}
            for name, format_ in FORMATS.items():
                label, says = LABELS.get(name, name.upper()), format_.says
                self.ticks[name] = self._tick(label, says, name in (asked or USUAL))
            self.recipe = self._tick("Recipe (TOML)", "to open it here again", False)
        with group("line-of-fields") as pdf:
            self.pages = ui.select(self._pages(), value=AS_SAID, label="PDF pages").props("outlined dense")
            self.inks = ui.select(INKS, value=AS_SAID, label="PDF colours").props("outlined dense")
        pdf.bind_visibility_from(self.ticks["pdf"], "value")
        with group("line-of-fields"):
            offered = self._colours()
            # As it is looked at.
            seen = self.session.colourway if self.session.colourway in offered else AS_SAID
            self.colours = ui.select(offered, value=seen, label="Colours").props("outlined dense")
            self.colours.set_visibility(len(offered) > 1)
        with group("line-of-fields"):
            machines = {NONE: "no machine", **{name: name for name in MACHINES}}
            self.machine = ui.select(machines, value=NONE, label="Machine").props("outlined dense")
            self.process = ui.input("Process").props(f'outlined dense stack-label placeholder="{NONE}"')
            offering(self.process, "Choose a process", list(PROCESSES), self.process.set_value)
        text(
            "Files are true to size. A process may have options behind its name, as in: cut kerf=0.15mm. "
            "All other options of a format are set under Outputs.",
            "quiet small",
            "p",
        )
        self.told = text("", "wrong", "p").props("role=alert")
        with group("dialog-foot"):
            self.stop = word_button("Stop", lambda: session.images.cancel(EXPORT))
            self.stop.set_visibility(False)
            word_button("Cancel", made.close)
            self.go = main_button("Download", self._export)
        background_tasks.create(self._certify())

    def _tick(self, label: str, says: str, on: bool) -> ui.checkbox:
        """Draw a box to tick, with what the file is for below its name."""
        with group("format"):
            made = ui.checkbox(label, value=on).props("dense")
            text(says, "quiet small")
        return made

    def _pages(self) -> dict[str, str]:
        """Return what the pages of a PDF may be; a cloth is never made to fit a sheet."""
        tables = {} if self.draft.faults else self.draft.tables
        found = {AS_SAID: "one, as large as the design"}
        if "tile" in tables and "yardage" not in tables:
            found |= {f"{FULL} {name}": f"one sheet of {name}, full of the pattern" for name in PAPERS}
        return found | {f"{TAPED} {name}": f"sheets of {name}, to tape together" for name in PAPERS}

    def _colours(self) -> dict[str, str]:
        """Return in which colours the files may be."""
        own, seen = list(colourways(self.draft)), self.session.colourway
        names = own if seen in own or seen not in PALETTES else [*own, seen]
        found = {AS_SAID: "as the recipe has them", **{name: name for name in names}}
        return found | ({ALL: "all colourways, a file each"} if len(own) > 1 else {})

    def _asked(self) -> list[str]:
        outputs = self.draft.tables.get("output", []) if not self.draft.faults else []
        return [each.get("format", "") for each in outputs if isinstance(each, dict)]

    async def _certify(self) -> None:
        found = await self.session.images.verdict(self.draft)
        if found is None or self.client.is_deleted or self.verdict_box.is_deleted:
            return
        if found.faults:
            self.verdict.classes(replace="bad")
            say(self.verdict, str(found.faults[0].message))
        elif not found.verdict:
            say(self.verdict, "A cloth without a tile has no seams to certify.")
        elif found.verdict["passed"]:
            self.verdict.classes(replace="good")
            say(self.verdict, "The seam certificate is passed: the tile repeats exactly.")
        else:
            faults = found.verdict["faults"]
            self.verdict.classes(replace="bad")
            say(self.verdict, f"The seam certificate finds {len(faults)} faults: {faults[0]['words']}")

    async def _export(self) -> None:
        formats = tuple(name for name, tick in self.ticks.items() if tick.value)
        if not formats and not self.recipe.value:
            say(self.told, "Tick a format.")
            return
        machine = str(self.machine.value or NONE)
        process = str(self.process.value or "").strip()
        asked = formats, (process,) if process else (), "" if machine == NONE else machine
        self.go.props("loading")
        self.stop.set_visibility(True)
        begun = time.perf_counter()
        files: dict[str, bytes] = {}
        try:
            colours = str(self.colours.value or AS_SAID)
            whole = Wishes(*asked, bool(self.recipe.value), (colours,) if colours else ())
            pages, inks = str(self.pages.value or AS_SAID), str(self.inks.value or AS_SAID)
            for draft, wishes in on_paper(self.draft, whole, pages, inks):
                done = await self.session.images.export(draft, wishes, tell=self._tell)
                if done.faults:
                    say(self.told, "; ".join(str(each) for each in done.faults[:3]))
                    return
                # What is asked for is the recipe alone, and some file is made in any case.
                wanted = {*formats} & {*wishes.formats}
                files |= {k: v for k, v in done.files.items() if wanted or k.endswith(".toml")}
        except BatikError as error:
            say(self.told, str(error))
            return
        finally:
            self.go.props(remove="loading")
            self.stop.set_visibility(False)
        name, data = download(Exported(files), self.draft.stem)
        number = self.session.keep_file(name, data)
        ui.download.from_url(f"/studio/download/{number}")
        report(f"{name}, {len(data) / 1e3:,.0f} kB, {time.perf_counter() - begun:.1f} s")
        self.made.close()

    def _tell(self, stage: str) -> None:
        say(self.told, f"{stage} …")
