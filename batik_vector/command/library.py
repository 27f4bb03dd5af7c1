"""The commands of the library that look.

Those that change it are in :mod:`batik_vector.command.library_changes`. All print what was found on stdout.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

import click

from batik_vector.command.library_changes import (
    add_command,
    export_command,
    note_command,
    remove_command,
    restore_command,
    tag_command,
)
from batik_vector.command.library_options import as_json_option, file_option, report_of
from batik_vector.command.telling import collecting, counted, reported

if TYPE_CHECKING:
    from batik_vector.library import Library
    from batik_vector.library.searching import Entry, Hit
    from batik_vector.library.values import Version

MOST_LISTED = 50
"""Hits that are told unless more are asked for."""
_tags = click.option("--tag", "tags", multiple=True, metavar="TAG", help="That it has; may be given again.")
_own = click.option("--own", is_flag=True, help="Without samples and starters.")


@click.group("library", short_help="Keep patterns, and find them again.")
def library_command() -> None:
    """Keep patterns with all their versions in one file, and find them again.

    The samples and the starters are in every library, as sample/NAME and starter/NAME. Wherever a RECIPE is
    taken, library:NAME is one, and library:NAME@3 one of its versions.
    """


@library_command.command("list", short_help="List patterns.")
@_tags
@_own
@click.option("--removed", is_flag=True, help="What was removed, and restore brings back.")
@click.option(
    "-n", "limit", type=click.IntRange(min=1), metavar="N", help="How many at most.  [default: all]"
)
@file_option
@as_json_option
def list_command(
    tags: Sequence[str], own: bool, removed: bool, limit: int | None, path: str | None, as_json: bool
) -> None:
    """List patterns by name."""
    from batik_vector.library import Library

    with report_of(as_json, "patterns") as found, Library(path, write=False) as library:
        listed = library.entries(tags=tags, own=own, removed=removed, limit=limit)
        found += [entry_facts(each) for each in listed]
        if not as_json:
            _tell(_line(each) for each in listed)


@library_command.command("search", short_help="Find patterns.")
@click.argument("words", nargs=-1, metavar="[WORDS]…")
@_tags
@click.option(
    "--where",
    default="",
    metavar="CONDITIONS",
    help='On features: "petals = 8, shape = wavy, coverage 20..40".',
)
@click.option("--like", metavar="NAME|RECIPE", help="The nearest to it first.")
@_own
@click.option(
    "-n",
    "limit",
    type=click.IntRange(min=1),
    default=MOST_LISTED,
    metavar="N",
    help=f"How many at most.  [default: {MOST_LISTED}]",
)
@click.option("--features", "as_features", is_flag=True, help="Say what features there are.")
@file_option
@as_json_option
def search_command(
    words: Sequence[str],
    tags: Sequence[str],
    where: str,
    like: str | None,
    own: bool,
    limit: int,
    as_features: bool,
    path: str | None,
    as_json: bool,
) -> None:
    """Search by text, tags, features and likeness, all at once.

    WORDS, or parts of them, are found in names, titles, tags, notes, and in what recipes say of themselves.
    Everything that is asked must hold.
    """
    if as_features:
        from batik_vector.library.features import FEATURES

        for name, feature in FEATURES.items():
            click.echo(f"{name:<{max(map(len, FEATURES))}}  {feature.says}")
        return
    from batik_vector.library import Library

    with report_of(as_json, "patterns") as found, Library(path, write=False) as library:
        reference = _reference(library, like) if like else None
        hits = library.search(" ".join(words), tags=tags, where=where, like=reference, own=own, limit=limit)
        found += [hit_facts(each) for each in hits]
        if not as_json:
            _tell(_line(each) for each in hits)
            if not hits:
                click.echo("nothing found", err=True)


def _reference(library: Library, like: str) -> Any:
    """Return what hits are to be like: a pattern's name, or what is measured of a recipe's file."""
    from pathlib import Path

    name = like.removeprefix("library:")
    if name != like or not (Path(like).suffix and Path(like).exists()):
        return name
    from batik_vector import load_recipe
    from batik_vector.library.measuring import measured

    collecting()
    return dict(measured(load_recipe(like), pictures=False).features)


@library_command.command("show", short_help="Show a pattern.")
@click.argument("name", metavar="NAME[@N]")
@click.option("--recipe", is_flag=True, help="Its page of TOML alone.")
@click.option("--picture", metavar="FILE", help="Write its small picture, an SVG or a PNG by the name.")
@click.option("--force", is_flag=True, help="Replace a file that is there.")
@file_option
@as_json_option
def show_command(
    name: str, recipe: bool, picture: str | None, force: bool, path: str | None, as_json: bool
) -> None:
    """Show a pattern: its newest version, or that of a number."""
    from batik_vector.library import Library

    with report_of(as_json, "patterns") as found, Library(path, write=picture is not None) as library:
        version = library.version(name)
        if picture is not None:
            _write_picture(library, name, picture, force)
        about = library.about(name)
        found.append(version_facts(version) | {"tags": list(about.tags), "features": dict(about.features)})
        found[-1] |= {"notes": [note._asdict() for note in about.notes]}
        if recipe and not as_json:
            click.echo(version.text, nl=not version.text.endswith("\n"))
        elif not as_json:
            _tell(_shown(version, found[-1]))


def _write_picture(library: Library, name: str, picture: str, force: bool) -> None:
    from pathlib import Path

    from batik_vector.command.new_files import new_file, write_new
    from batik_vector.errors import ExportError

    suffix = Path(picture).suffix.lower()
    if suffix not in (".svg", ".png"):
        raise ExportError(f'"{picture}" is no name of a picture, expected one that ends with .svg or .png')
    collecting()
    target = new_file(picture, name, suffix, force)
    details = library.details(name)
    data = details.svg if suffix == ".svg" else details.png
    if not data:
        raise ExportError(f"{picture} could not be written: a PNG needs the cairo library")
    write_new({target: data}, force)
    click.echo(f"{target} written", err=True)


@library_command.command("history", short_help="List the versions of a pattern.")
@click.argument("name", metavar="NAME")
@file_option
@as_json_option
def history_command(name: str, path: str | None, as_json: bool) -> None:
    """List all versions of a pattern."""
    from batik_vector.library import Library

    with report_of(as_json, "versions") as found, Library(path, write=False) as library:
        versions = library.history(name)
        found += [version_facts(each) for each in versions]
        if not as_json:
            width = len(str(versions[-1].number))
            _tell(
                f"@{each.number:<{width}}  {_time(each.saved)}  {each.title}  {each.origin}"
                for each in versions
            )


@library_command.command("diff", short_help="Show how two versions differ.")
@click.argument("one", metavar="NAME[@N]")
@click.argument("other", required=False, metavar="[NAME[@M]]")
@file_option
@as_json_option
def diff_command(one: str, other: str | None, path: str | None, as_json: bool) -> None:
    """Show how two versions differ.

    With one NAME its last two versions are compared, with NAME@N that version and the newest.
    """
    from difflib import unified_diff

    from batik_vector.library import Library
    from batik_vector.library.names import parsed

    with report_of(as_json, "differences") as found, Library(path, write=False) as library:
        name, number = parsed(one)
        last = library.version(name)
        before = library.version(one if number or other else f"{name}@{max(1, last.number - 1)}")
        after = library.version(other) if other else last
        titles = [f"{each.name}@{each.number}" for each in (before, after)]
        texts = [_whole_lines(each) for each in (before, after)]
        lines = list(unified_diff(texts[0], texts[1], titles[0], titles[1], lineterm=""))
        found += lines
        if not as_json:
            _tell(lines)
            if not lines:
                click.echo(f"{titles[0]} and {titles[1]} say the same", err=True)


def _whole_lines(version: Version) -> list[str]:
    """Return the lines of a recipe, and of the drawings that it has."""
    drawn = [f"# {file}\n{text}" for file, text in version.drawings.items()]
    return "\n".join([version.text, *drawn]).splitlines()


@library_command.command("stats", short_help="Say where the library is, and what is in it.")
@file_option
@as_json_option
def stats_command(path: str | None, as_json: bool) -> None:
    """Say where the library is, and what is in it."""
    from batik_vector.library import Library

    with report_of(as_json, "library") as found, Library(path, write=False) as library:
        stats = library.stats()
        found.append(stats._asdict())
        if not as_json:
            size = f"{stats.bytes / 1e6:,.1f} MB"
            click.echo(f"{stats.path}  {size}, schema {stats.schema}, SQLite {stats.sqlite}")
            click.echo(
                f"{counted(stats.patterns, 'pattern')} of your own, {stats.included:,} samples and starters, "
                f"{stats.removed:,} removed; {counted(stats.versions, 'version')}, "
                f"{counted(stats.tags, 'tag')}, {counted(stats.notes, 'note')}"
            )


@library_command.command("check", short_help="Look for damage.")
@click.option("--measure", is_flag=True, help="Measure what was never measured, or by an older program.")
@file_option
@as_json_option
def check_command(measure: bool, path: str | None, as_json: bool) -> None:
    """Look through the library for damage; exits with 1 where there is any."""
    from batik_vector.library import Library

    with reported(as_json) as report, Library(path, write=measure) as library:
        del report["recipes"]
        faults = library.check()
        left = library.unmeasured()
        report["library"] = [{"path": str(library.path), "faults": faults, "unmeasured": left}]
        report["exit"] = 1 if faults else 0
        for words in faults:
            click.echo(f"{library.path}: {words}", err=True)
        if measure and left:
            collecting()
            _measure(library, left)
        elif left:
            click.echo(f"{len(left):,} never measured: library check --measure finds them out", err=True)
        if not faults:
            click.echo(f"{library.path}: sound", err=True)


def _measure(library: Library, names: Sequence[str]) -> None:
    from tqdm import tqdm

    from batik_vector.errors import BatikError

    for name in tqdm(names, delay=1, disable=None, leave=False):
        try:
            library.measure(name)
        except BatikError as error:
            click.echo(f"{name}: not measured: {error}", err=True)


for _command in (add_command, export_command, restore_command, tag_command, note_command, remove_command):
    library_command.add_command(_command)


# What is told.


def entry_facts(each: Entry | Hit) -> dict[str, Any]:
    """Return an entry as plain values."""
    facts = {"name": each.name, "version": each.version, "title": each.title, "saved": each.saved}
    return facts | {"included": each.included, "tags": list(each.tags)}


def hit_facts(hit: Hit) -> dict[str, Any]:
    """Return a hit as plain values."""
    near = {} if hit.distance is None else {"distance": round(hit.distance, 4)}
    return entry_facts(hit) | near | {"features": hit.features}


def version_facts(version: Version) -> dict[str, Any]:
    """Return a version as plain values, the recipe among them."""
    facts = version._asdict()
    del facts["id"]
    facts["version"] = facts.pop("number")
    facts["recipe"] = facts.pop("text")
    return facts | {"drawings": sorted(version.drawings)}


def _line(each: Any) -> str:
    """Return an entry in a line."""
    distance = getattr(each, "distance", None)
    near = "" if distance is None else f"{distance:6.3f}  "
    tags = f"  [{', '.join(each.tags)}]" if each.tags else ""
    return f"{near}{each.name}@{each.version}  {each.title}{tags}"


def _shown(version: Version, facts: dict[str, Any]) -> Iterator[str]:
    yield f"{version.name}@{version.number}  {version.title}"
    yield f"  saved {_time(version.saved)}{f' from {version.origin}' if version.origin else ''}"
    if facts["tags"]:
        yield f"  tags: {', '.join(facts['tags'])}"
    if facts["features"]:
        yield f"  {', '.join(f'{name} {_value(value)}' for name, value in facts['features'].items())}"
    if version.drawings:
        yield f"  drawings: {', '.join(version.drawings)}"
    for note in facts["notes"]:
        yield f"  {_time(note['written'])}: {note['text']}"


def _value(value: Any) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)


def _time(told: str) -> str:
    """Return a time in the zone of whoever reads it, to the minute."""
    from datetime import datetime

    return datetime.fromisoformat(told).astimezone().strftime("%Y-%m-%d %H:%M")


def _tell(lines: Iterable[str]) -> None:
    text = "\n".join(lines)
    if text:
        click.echo(text)
