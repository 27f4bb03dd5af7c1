"""Runs contests: every entrant once in each round, in turn; whoever fails is left out, and why is kept."""

from __future__ import annotations

import contextlib
import re
import tempfile
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path

from benchmarks.contests.entrants import Contest, Entrant, Fact, own
from benchmarks.results import Results
from benchmarks.timing import ROOT, FailedError, Sample, parts, process, told

NOT_INSTALLED = ROOT / ".venv-bench" / "missing"
"""Where setting up leaves the reason for each package that could not be installed."""


PLACES = re.compile(r"(?<![\w.])/[\w.@+-]+(?:/[\w.@+-]+)*/")
"""Folders in a message: they are this machine's, and say nothing elsewhere."""


class Folders:
    """A folder for every size of drawing, made ready when it is first asked for."""

    def __init__(self, root: Path) -> None:
        self._root = root

    def of(self, rings: int) -> Path:
        """Return the folder in which a drawing lies ready; with 0 an empty one.

        Raises:
            FailedError: where batik_vector cannot draw it.
        """
        folder = self._root / str(rings)
        if not folder.exists():
            folder.mkdir()
            if rings:
                process(own("own", "prepare", str(rings), str(folder)))
        return folder


@contextlib.contextmanager
def folders() -> Iterator[Folders]:
    """Yield folders that are removed at last."""
    with tempfile.TemporaryDirectory(prefix="batik-bench-") as root:
        yield Folders(Path(root))


def filled(command: Sequence[str], folder: Path) -> list[str]:
    """Return a command with the folder in its place."""
    return [word.replace("{folder}", str(folder)) for word in command]


def measure(entrant: Entrant, folder: Path) -> dict[str, Sample]:
    """Run an entrant once; return its parts by name, or its whole process under no name."""
    command = filled(entrant.command, folder)
    if entrant.inside:
        return parts(command)
    sample, _ = process(command)
    written = sum((folder / name).stat().st_size for name in entrant.drawn)
    return {"": replace(sample, bytes=written)}


def run(contest: Contest, results: Results, places: Folders, say: Callable[[str], object]) -> None:
    """Run a contest to its end, entering all runs."""
    try:
        folder = places.of(contest.rings)
    except FailedError as error:
        reason = PLACES.sub("", str(error))
        results.missing |= {f"{contest.name}/{each.name}": reason for each in contest.entrants}
        return
    base = {each.name: _base(each, folder) for each in contest.entrants}
    for number in range(contest.rounds):
        for entrant in contest.entrants:
            name = f"{contest.name}/{entrant.name}"
            if name in results.missing or (entrant.rounds is not None and number >= entrant.rounds):
                continue
            say(f"{contest.name}, round {number + 1} of {contest.rounds}: {entrant.name}")
            try:
                measured = measure(entrant, folder)
            except FailedError as error:
                results.missing[name] = _reason(entrant, str(error))
                continue
            for part, sample in measured.items():
                above = replace(sample, mib=sample.mib - base[entrant.name])
                results.add(f"{name}/{part}" if part else name, above)
    for entrant in contest.entrants:
        name = f"{contest.name}/{entrant.name}"
        for file in entrant.drawn if name not in results.missing else ():
            say(f"{contest.name}: reading {file}")
            with contextlib.suppress(FailedError):
                found = told(own("readback", "drawing", str(folder / file)))
                results.facts.setdefault(name, []).append(found)


def _base(entrant: Entrant, folder: Path) -> float:
    """Return the MiB of a process that draws next to nothing."""
    if not entrant.tiny:
        return 0.0
    try:
        sample, _ = process(filled(entrant.tiny, folder))
    except FailedError:
        return 0.0
    return sample.mib


def _reason(entrant: Entrant, words: str) -> str:
    """Return why an entrant is missing: what setting up said of its package, where it said something."""
    if NOT_INSTALLED.is_dir():
        for note in NOT_INSTALLED.iterdir():
            if note.name.lower() in " ".join((entrant.name, words)).lower():
                return f"{note.name} could not be installed: {note.read_text(encoding='utf-8').strip()}"
    return PLACES.sub("", words)


def find_out(fact: Fact, results: Results, places: Folders) -> None:
    """Find something out, or enter why not."""
    try:
        results.facts[fact.name] = told(filled(fact.command, places.of(fact.rings)))
    except FailedError as error:
        results.missing[fact.name] = PLACES.sub("", str(error))
