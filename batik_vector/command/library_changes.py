"""The commands that change the library: ``add``, ``export``, ``restore``, ``tag``, ``note``, ``remove``."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import click

from batik_vector.command.library_options import as_json_option, file_option, report_of
from batik_vector.command.options import files_begun, folder_option, workers_of
from batik_vector.command.telling import collecting, counted, faults_told, reported
from batik_vector.errors import ExportError, LibraryError, unknown_name
from batik_vector.values import frozen

if TYPE_CHECKING:
    from pathlib import Path

    from batik_vector.library import Library
    from batik_vector.library.exchange import Incoming
    from batik_vector.library.measuring import Measured
    from batik_vector.making.pool import Outcome

WORTHWHILE = 6
"""Recipes below which other processes take longer to begin than they save."""
FORMATS = ("toml", "svg", "pdf", "dxf", "gcode", "png", "zip")


@click.command("add", short_help="Save recipes.")
@click.argument("paths", nargs=-1, required=True, metavar="RECIPE|FOLDER|ZIP…", shell_complete=files_begun)
@click.option("--name", metavar="NAME", help="What it is called.  [default: as its file]")
@click.option("--tag", "tags", multiple=True, metavar="TAG", help="That it gets; may be given again.")
@click.option("--note", default="", metavar="TEXT", help="A note on it.")
@click.option(
    "-j",
    "processes",
    type=click.IntRange(0, 256),
    default=0,
    callback=workers_of,
    metavar="N",
    help="Processes.  [default: one a core]",
)
@file_option
@as_json_option
def add_command(
    paths: Sequence[str],
    name: str | None,
    tags: Sequence[str],
    note: str,
    processes: int,
    path: str | None,
    as_json: bool,
) -> None:
    """Save recipes: as new patterns, or as new versions of those that have their names.

    A RECIPE is a TOML file, or an SVG, PDF, DXF or PNG that was compiled from one; of a FOLDER all are taken;
    a ZIP is a library's, or holds recipes. Each is compiled, measured, and kept with a small picture. What
    does not compile is told, and the others are saved.
    """
    from batik_vector.library import Library
    from batik_vector.library.exchange import arrivals

    collecting()
    with reported(as_json) as report:
        del report["recipes"]
        report["patterns"] = []
        found = arrivals(paths, name)
        for each in found.profiles:
            click.echo(f"{each} is the profile of a machine, and left out", err=True)
        for error in found.faults:
            with faults_told(report):
                raise error
        # Where there is nothing to save no library is begun.
        if found.patterns:
            with Library(path) as library:
                save_all(library, found.patterns, processes, report, tags=tags, note=note, quiet=as_json)


def save_all(
    library: Library,
    patterns: Sequence[Incoming],
    processes: int,
    report: dict[str, Any],
    *,
    tags: Sequence[str] = (),
    note: str = "",
    quiet: bool = False,
) -> None:
    """Measure recipes and save them; tell what does not compile, and note in the report what was saved."""
    from batik_vector.library.measuring import Measured

    report.setdefault("patterns", [])
    for each, outcome in _measured(patterns, processes, quiet):
        if outcome is not None and outcome.failure is not None:
            with faults_told(report):
                outcome.check(each.origin)
        else:
            # Where one cannot be saved, no other can: a full disk is told once.
            measured = outcome.result if outcome is not None else Measured()
            report["patterns"].append(_saved(library, each, measured, tags, note))


def _saved(
    library: Library, each: Incoming, measured: Measured | None, tags: Sequence[str], note: str
) -> dict[str, Any]:
    """Save a recipe, and say so."""
    notes = "\n".join((*each.notes, note)) if note else "\n".join(each.notes)
    saved = library.add(
        each.name, each.recipe, measured=measured, origin=each.origin, tags=(*each.tags, *tags), note=notes
    )
    words = "saved" if saved.fresh else "is there already, and says the same"
    click.echo(f"{saved.name}@{saved.number} {words}", err=True)
    return {"name": saved.name, "version": saved.number, "saved": saved.fresh, "origin": each.origin}


@frozen
class _Task:
    """A recipe to be measured: its number, its text, which carries its drawings, and its source."""

    number: int
    text: str
    source: str


def _measure(task: _Task) -> Measured:
    from batik_vector.library.measuring import measured_text

    return measured_text(task.text, task.source)


def _measured(
    patterns: Sequence[Incoming], processes: int, quiet: bool
) -> Iterator[tuple[Incoming, Outcome[_Task, Measured] | None]]:
    """Yield each recipe with what came of measuring it, in order; old versions are not measured."""
    from tqdm import tqdm

    from batik_vector.making.pool import outcomes

    work = [
        _Task(number, each.recipe.source, each.origin) for number, each in enumerate(patterns) if each.newest
    ]
    known: dict[int, Outcome[_Task, Measured] | None] = {
        number: None for number, each in enumerate(patterns) if not each.newest
    }
    due = 0
    workers = min(processes, len(work)) if len(work) >= WORTHWHILE else 1
    with tqdm(total=len(work), delay=1, disable=quiet or None, leave=False) as bar:
        for outcome in outcomes(_measure, work, workers):
            known[outcome.task.number] = outcome
            bar.update()
            while due in known:
                yield patterns[due], known.pop(due)
                due += 1
    while due in known:
        yield patterns[due], known.pop(due)
        due += 1


@click.command("export", short_help="Write patterns to files, or a zip.")
@click.argument("names", nargs=-1, metavar="NAME[@N]…")
@click.option("--all", "everything", is_flag=True, help="All patterns of your own.")
@click.option("--tag", "tags", multiple=True, metavar="TAG", help="All that have it.")
@folder_option("Where files go.  [default: .]", ".", "DIR|FILE.zip")
@click.option(
    "-f",
    "--format",
    "formats",
    default="",
    metavar="FORMAT,…",
    help=f"{', '.join(FORMATS)}; a zip has all versions.  [default: toml, or zip where -o names one]",
)
@click.option("--force", is_flag=True, help="Replace files that are there.")
@file_option
@as_json_option
def export_command(
    names: Sequence[str],
    everything: bool,
    tags: Sequence[str],
    folder: str,
    formats: str,
    force: bool,
    path: str | None,
    as_json: bool,
) -> None:
    """Write patterns to files: their recipes, what they compile to, or all versions in a zip.

    Each file carries its recipe, and library add takes it back.
    """
    from pathlib import Path

    from batik_vector.library import Library

    wanted = _formats(formats, folder)
    with report_of(as_json, "files") as files, Library(path, write=False) as library:
        chosen = [*names]
        if everything or tags:
            chosen += [each.name for each in library.entries(tags=tags, own=everything or not tags)]
        if not chosen:
            raise LibraryError("nothing to export: expected names, --all, or --tag TAG")
        collecting()
        if "zip" in wanted:
            files.append(_zip(library, list(dict.fromkeys(chosen)), Path(folder), force))
            wanted = [each for each in wanted if each != "zip"]
        files += _files(library, chosen, Path(folder), wanted, force) if wanted else []


def _formats(words: str, folder: str) -> list[str]:
    found = [each.strip().lower() for each in words.split(",") if each.strip()]
    for name in found:
        if name not in FORMATS:
            raise LibraryError(unknown_name(name, FORMATS, "format"))
    zips = folder.lower().endswith(".zip")
    if zips and found not in ([], ["zip"]):
        raise LibraryError(f'"{folder}" is a zip, expected a folder for files of other formats')
    return list(dict.fromkeys(found)) or (["zip"] if zips else ["toml"])


def _zip(library: Library, names: Sequence[str], folder: Path, force: bool) -> dict[str, Any]:
    from batik_vector.export.files import write_all_whole
    from batik_vector.library.exchange import zipped
    from batik_vector.making.destinations import make_folder

    wholes = {library.version(name).name: name for name in names}
    target = folder if folder.suffix.lower() == ".zip" else folder / "library.zip"
    _refuse_there([target], force)
    make_folder(target.parent)
    count = 0

    def write(sink: Any) -> None:
        nonlocal count
        count = zipped(library, list(wholes), sink)

    write_all_whole([(target, write)])
    click.echo(f"{target}  {counted(len(wholes), 'pattern')}, {counted(count, 'version')}", err=True)
    return {"path": str(target), "format": "zip", "patterns": len(wholes), "versions": count}


def _files(
    library: Library, names: Sequence[str], folder: Path, formats: Sequence[str], force: bool
) -> list[dict[str, Any]]:
    """Write the files of patterns, all or none."""
    from batik_vector.export.files import write_all_whole
    from batik_vector.library.exchange import file_name, written
    from batik_vector.making.destinations import make_folder

    places: dict[Path, tuple[Any, str]] = {}
    for name in dict.fromkeys(names):
        version = library.version(name)
        for format_ in formats:
            target = folder / file_name(version, format_)
            if places.get(target, (version,))[0] != version:
                other = places[target][0]
                both = f"{other.name}@{other.number} and {version.name}@{version.number}"
                raise LibraryError(f"{both} would both be written to {target}")
            places[target] = version, format_
    _refuse_there(list(places), force)
    make_folder(folder)
    write_all_whole([(target, written(library, *what)) for target, what in places.items()])
    for target in places:
        click.echo(f"{target}", err=True)
    return [{"path": str(target), "format": what[1]} for target, what in places.items()]


def _refuse_there(places: Sequence[Path], force: bool) -> None:
    there = next((place for place in places if place.exists() or place.is_symlink()), None)
    if there is not None and not force:
        raise ExportError(f"{there} is there already: --force replaces it")


@click.command("restore", short_help="Bring back an old version, or what was removed.")
@click.argument("name", metavar="NAME[@N]")
@file_option
@as_json_option
def restore_command(name: str, path: str | None, as_json: bool) -> None:
    """Make an old version the newest again, or bring back a pattern that was removed."""
    from batik_vector.library import Library

    with report_of(as_json, "patterns") as found, Library(path) as library:
        saved = library.restore(name)
        found.append({"name": saved.name, "version": saved.number, "saved": saved.fresh})
        click.echo(f"{saved.name}@{saved.number} is the newest", err=True)


@click.command("tag", short_help="Give or take tags.")
@click.argument("name", metavar="NAME")
@click.argument("tags", nargs=-1, required=True, metavar="TAG…")
@click.option("--remove", is_flag=True, help="Take these tags from it.")
@file_option
@as_json_option
def tag_command(name: str, tags: Sequence[str], remove: bool, path: str | None, as_json: bool) -> None:
    """Give a pattern tags, or take them from it."""
    from batik_vector.library import Library

    with report_of(as_json, "patterns") as found, Library(path) as library:
        has = library.tag(name, tags, remove=remove)
        found.append({"name": name, "tags": list(has)})
        click.echo(f"{name}: {', '.join(has) or 'no tags'}", err=True)


@click.command("note", short_help="Add a note, or read them.")
@click.argument("name", metavar="NAME")
@click.argument("text", required=False)
@file_option
@as_json_option
def note_command(name: str, text: str | None, path: str | None, as_json: bool) -> None:
    """Add a note to a pattern; without a TEXT, say which it has."""
    from batik_vector.library import Library

    with report_of(as_json, "notes") as found, Library(path, write=text is not None) as library:
        notes = library.notes(name) if text is None else library.note(name, text)
        found += [note._asdict() for note in notes]
        for note in notes if not as_json else ():
            click.echo(note.text)


@click.command("remove", short_help="Remove patterns.")
@click.argument("names", nargs=-1, required=True, metavar="NAME…")
@click.option("--for-good", is_flag=True, help="With all versions, so that nothing brings it back.")
@file_option
@as_json_option
def remove_command(names: Sequence[str], for_good: bool, path: str | None, as_json: bool) -> None:
    """Remove patterns; restore brings them back, unless they were removed for good."""
    from batik_vector.library import Library

    with report_of(as_json, "patterns") as found, Library(path) as library:
        library.remove(*names, for_good=for_good)
        for name in names:
            found.append({"name": name, "removed": True})
            words = "removed for good" if for_good else f"removed: library restore {name} brings it back"
            click.echo(f"{name} {words}", err=True)
