"""The export dialog: formats, the certificate's verdict, and the files as the command writes them."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from nicegui import background_tasks, ui

from batik_vector.export import FORMATS
from batik_vector.machines import MACHINES
from batik_vector.studio.asking import Wishes
from batik_vector.studio.exports import Exported, download
from batik_vector.studio.page.dialogs import dialog
from batik_vector.studio.page.parts import group, main_button, report, say, text, word_button
from batik_vector.studio.pictures import EXPORT

if TYPE_CHECKING:
    from batik_vector.studio.page.session import Session

USUAL = ("svg", "pdf")
"""What is ticked where a recipe asks for no files."""
NONE = "none"
LABELS = {"gcode": "G-code", "swatch": "Swatch"}
"""What formats are called whose names are not their letters."""


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
            self.ticks = {
                name: ui.checkbox(LABELS.get(name, name.upper()), value=name in (asked or USUAL)).props(
                    "dense"
                )
                for name in FORMATS
            }
            for name, tick in self.ticks.items():
                with tick:
                    ui.tooltip(FORMATS[name].says).props("delay=500")
            self.recipe = ui.checkbox("Recipe (TOML)", value=False).props("dense")
        with group("line-of-fields"):
            machines = {NONE: "no machine", **{name: name for name in MACHINES}}
            self.machine = ui.select(machines, value=NONE, label="Machine").props("outlined dense")
            self.process = ui.input("Process, as in: cut kerf=0.15mm").props("outlined dense")
        text("Options of each format are set under Outputs.", "quiet small", "p")
        self.told = text("", "wrong", "p").props("role=alert")
        with group("dialog-foot"):
            self.stop = word_button("Stop", lambda: session.images.cancel(EXPORT))
            self.stop.set_visibility(False)
            word_button("Cancel", made.close)
            self.go = main_button("Download", self._export)
        background_tasks.create(self._certify())

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
        wishes = Wishes(
            formats or ("svg",), (process,) if process else (), "" if machine == NONE else machine,
            bool(self.recipe.value),
        )  # fmt: skip
        self.go.props("loading")
        self.stop.set_visibility(True)
        begun = time.perf_counter()
        try:
            done = await self.session.images.export(self.draft, wishes, tell=self._tell)
        finally:
            self.go.props(remove="loading")
            self.stop.set_visibility(False)
        if done.faults:
            say(self.told, "; ".join(str(each) for each in done.faults[:3]))
            return
        files = dict(done.files) if formats else {k: v for k, v in done.files.items() if k.endswith(".toml")}
        name, data = download(Exported(files), self.draft.stem)
        number = self.session.keep_file(name, data)
        ui.download.from_url(f"/studio/download/{number}")
        report(f"{name}, {len(data) / 1e3:,.0f} kB, {time.perf_counter() - begun:.1f} s")
        self.made.close()

    def _tell(self, stage: str) -> None:
        say(self.told, f"{stage} …")
