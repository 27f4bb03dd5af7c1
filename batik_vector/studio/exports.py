"""Files of a draft: those that ``batik-vector compile`` would write, byte for byte, kept in memory.

Every format and every option is to be had: the options are those of the recipe's outputs, and what a call
adds is what ``-f``, ``--process`` and ``--machine`` add. All files or none are made.
"""

from __future__ import annotations

import io
import os
import tempfile
import time
import zipfile
from collections.abc import Callable, Mapping
from dataclasses import field, replace
from pathlib import Path
from typing import Any

from batik_vector.errors import BatikError, ExportError, Fault, RecipeError
from batik_vector.export import FORMATS
from batik_vector.making.jobs import Job, planned
from batik_vector.making.palettes import jobs_in_colourways
from batik_vector.making.running import run
from batik_vector.recipe.loading import read_recipe
from batik_vector.studio.asking import Wishes
from batik_vector.studio.drafts import Draft
from batik_vector.values import frozen

FIRST_DAY = (1980, 1, 1, 0, 0, 0)
"""The date of all files in a zip: the earliest that it knows. Same recipe, same bytes."""
MOST = 1 << 30
"""Bytes of all files together that are kept in memory: larger ones are the command's."""
RECIPE = ".toml"
PDF, FULL, TAPED = "pdf", "full", "taped"
PAPERS = {"A4": ("210 mm", "297 mm"), "A3": ("297 mm", "420 mm"), "Letter": ("215.9 mm", "279.4 mm")}
"""What people have printers for, breadth and height."""


@frozen(eq=False)
class Exported:
    """The files, by name, what the command reports of them, or why there are none."""

    files: Mapping[str, bytes] = field(default_factory=dict)
    report: Mapping[str, Any] = field(default_factory=dict)
    faults: tuple[Fault, ...] = ()
    seconds: float = 0.0


def file_names(draft: Draft, wishes: Wishes) -> tuple[str, ...]:
    """Return what the files will be called, before any is made; sheets of divided drawings come as one.

    Raises:
        RecipeError, ExportError: where they cannot be made.
    """
    with tempfile.TemporaryDirectory(prefix="batik-") as folder:
        jobs = _jobs(draft, wishes, Path(folder))
        names = [path.name for job in jobs for path, _ in job.files]
    return (*names, f"{draft.stem}{RECIPE}") if wishes.recipe else tuple(names)


def export(draft: Draft, wishes: Wishes, tell: Callable[[str], None] = lambda _: None) -> Exported:
    """Make the files of a draft, or tell the faults that keep them from being made."""
    begun = time.perf_counter()
    try:
        with tempfile.TemporaryDirectory(prefix="batik-") as folder:
            jobs = _jobs(draft, wishes, Path(folder))
            for name in dict.fromkeys(output.format for job in jobs for _, output in job.files):
                FORMATS[name].check_ready()
            reports = [run(job, tell) for job in jobs]
            report = {**reports[0], "files": [each for one in reports for each in one["files"]]}
            files = dict(_read(Path(folder), report))
    except RecipeError as error:
        return Exported(faults=error.faults, seconds=time.perf_counter() - begun)
    except BatikError as error:
        return Exported(faults=(Fault(str(error), source=draft.stem),), seconds=time.perf_counter() - begun)
    if wishes.recipe:
        files[f"{draft.stem}{RECIPE}"] = draft.whole.encode()
    for each in report["files"]:
        each["path"] = os.path.basename(each["path"])
    return Exported(files, report, seconds=time.perf_counter() - begun)


def with_output(draft: Draft, format_: str, values: Mapping[str, Any]) -> Draft:
    """Return the draft with values set in each of its outputs of a format, or in one that is added.

    Raises:
        RecipeError: where they cannot be set.
    """
    if not values:
        return draft
    held = draft.tables.get("output", [])
    outputs = held if isinstance(held, list) else [held]
    places = [number for number, each in enumerate(outputs) if each.get("format") == format_]
    if not places:
        return draft.inserted("output", {"format": format_, **values})
    return draft.with_values(
        {f"output[{place}].{key}": value for place in places for key, value in values.items()}
    )


def on_paper(draft: Draft, wishes: Wishes, pages: str = "", inks: str = "") -> list[tuple[Draft, Wishes]]:
    """Return what is exported where something is said of the PDF: that apart from all else.

    Args:
        draft, wishes: that are exported.
        pages: "full A4", a sheet of that paper full of the pattern; "taped A4", a large design over
            several; or nothing, a page as large as the design.
        inks: "spot", for separations, or nothing.

    Raises:
        RecipeError: where the draft cannot be changed so.
    """
    how, _, paper = pages.partition(" ")
    values: dict[str, Any] = {"inks": inks} if inks else {}
    sheet = draft
    if how == TAPED:
        width, length = PAPERS[paper]
        # Sheets overlap by more than printers leave white along both edges.
        values |= {"pages": "tile", "page": f"{width.removesuffix(' mm')} x {length}", "overlap": "15 mm"}
    elif how == FULL:
        width, length = PAPERS[paper]
        sheet = draft.with_value("yardage", {"width": width, "length": length})
        values |= {"piece": "yardage"}
    if PDF not in wishes.formats or not values:
        return [(draft, replace(wishes, formats=wishes.formats or ("svg",)))]
    rest = tuple(each for each in wishes.formats if each != PDF)
    parts = [(with_output(sheet, PDF, values), replace(wishes, formats=(PDF,), recipe=False))]
    if rest or wishes.recipe:
        parts.append((draft, replace(wishes, formats=rest or ("svg",))))
    return parts


def _jobs(draft: Draft, wishes: Wishes, folder: Path) -> list[Job]:
    """Return what makes the files: one for each colourway, where any are asked for."""
    recipe = read_recipe(draft.text, draft.stem, folder=draft.folder, drawings=dict(draft.drawings))
    called: dict[str, Any] = {}
    if wishes.processes:
        from batik_vector.recipe.reading.called_processes import read_processes

        called["process"] = read_processes(wishes.processes)
    if wishes.machine:
        from batik_vector.recipe.reading.machines import read_machine

        called |= {"machine": wishes.machine, "machine_profile": read_machine(wishes.machine)}
    jobs = [Job(draft.stem, recipe, stem=draft.stem)]
    if wishes.colourways:
        jobs = jobs_in_colourways(jobs, wishes.colourways)
    return planned(jobs, folder, wishes.formats, called)


def _read(folder: Path, report: Mapping[str, Any]) -> list[tuple[str, bytes]]:
    total = sum(each["bytes"] for each in report["files"])
    if total > MOST:
        raise ExportError(f"the files have {total:,} bytes, more than are kept in memory: use the command")
    names = [os.path.basename(each["path"]) for each in report["files"]]
    return [(name, (folder / name).read_bytes()) for name in names]


def zipped(files: Mapping[str, bytes]) -> bytes:
    """Return files as one zip, the same bytes for the same files."""
    sink = io.BytesIO()
    with zipfile.ZipFile(sink, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, FIRST_DAY)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            entry.create_system = 3
            archive.writestr(entry, data)
    return sink.getvalue()


def download(exported: Exported, stem: str) -> tuple[str, bytes]:
    """Return what is handed over: the file where there is one alone, or else a zip of all; and its name."""
    if len(exported.files) == 1:
        ((name, data),) = exported.files.items()
        return name, data
    return f"{stem}.zip", zipped(exported.files)
