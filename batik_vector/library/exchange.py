"""Patterns leave the library as files, and come into it from files, folders and zips.

A zip of the library holds every version as a recipe that compiles from itself alone, and ``library.json``,
which says what is called how and how it is tagged. Nothing in it tells a time: the same patterns make the
same bytes. Zips come from strangers: names that lead elsewhere, links, and what unpacks to too much are
refused before anything is changed.
"""

from __future__ import annotations

import json
import stat
import tempfile
import zipfile
import zlib
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath
from typing import Any, BinaryIO

from batik_vector import (
    BatikError,
    Fault,
    LibraryError,
    MachineProfileError,
    Recipe,
    RecipeError,
    compile_cloth,
    compile_recipe,
    load_recipe,
    read_recipe,
    render,
)
from batik_vector.library.names import checked_name, checked_tags, folded, name_from, shown
from batik_vector.library.store import Library
from batik_vector.library.values import Version

MANIFEST = "library.json"
FORMAT = 1
"""The version of the manifest."""
RECIPES, COMPILED = (".toml",), (".svg", ".pdf", ".dxf", ".gcode", ".png")
MOST_MEMBERS, MOST_BYTES, MOST_OF_ONE = 200_000, 1 << 30, 64 << 20
"""What a zip may hold: files, bytes of them all unpacked, and bytes of one."""
EXPECTED = "expected TOML files or what was compiled from them"
_EPOCH = (1980, 1, 1, 0, 0, 0)


@dataclass(frozen=True)
class Incoming:
    """A recipe that is to be saved: under what name, from where, and with what."""

    name: str
    recipe: Recipe
    origin: str
    tags: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    newest: bool = True


@dataclass
class Arrivals:
    """What was found in the files that were given, and what is wrong with the others.

    ``profiles`` are of machines, and lay beside the recipes of a folder or a zip.
    """

    patterns: list[Incoming] = field(default_factory=list)
    faults: list[BatikError] = field(default_factory=list)
    profiles: list[str] = field(default_factory=list)


def arrivals(paths: Sequence[str], name: str | None = None) -> Arrivals:
    """Read recipes from files, folders and zips.

    Args:
        paths: of TOML files, of files that were compiled, of folders of either, or of zips.
        name: what the one recipe is called; after its file when left out.

    Raises:
        LibraryError: where a zip is unsound, or two recipes would have the same name.
    """
    found = Arrivals()
    with ExitStack() as stack:
        for path in paths:
            if Path(path).suffix.lower() == ".zip" and not Path(path).is_dir():
                _from_zip(path, found, stack)
            else:
                files = _files(path)
                for file in files:
                    _read(str(file), str(file), found, alone=files == [Path(path)])
    if found.profiles and not found.patterns and not found.faults:
        words = f"no recipes, only profiles of machines, such as {found.profiles[0]}"
        raise LibraryError(f'{words}: "machine" in the [[output]] of a recipe names one')
    if name is not None:
        if len(found.patterns) + len(found.faults) > 1:
            raise LibraryError(f"{len(found.patterns)} recipes, expected one to be called {shown(name)}")
        found.patterns = [
            Incoming(checked_name(name), each.recipe, each.origin, each.tags, each.notes)
            for each in found.patterns
        ]
    _refuse_doubles(found.patterns)
    return found


def _files(path: str) -> list[Path]:
    """Return the recipes that a path stands for: of a folder its TOML files, or else what was compiled."""
    folder = Path(path)
    if path.startswith("library:") or not folder.is_dir():
        return [folder]
    there = sorted(each for each in folder.iterdir() if each.is_file() and not each.name.startswith("."))
    for suffixes in (RECIPES, COMPILED):
        files = [each for each in there if each.suffix.lower() in suffixes]
        if files:
            return files
    raise LibraryError(
        f"{path}: no recipes in this folder, expected TOML files or what was compiled from them"
    )


def _read(path: str, origin: str, found: Arrivals, *, alone: bool = False) -> None:
    try:
        recipe = load_recipe(path)
    except RecipeError as error:
        if isinstance(error, MachineProfileError) and not alone:
            found.profiles.append(origin)
            return
        # What was unpacked is named as it is in its zip.
        found.faults.append(RecipeError([Fault(f.message, f.key, origin, f.line) for f in error.faults]))
        return
    except BatikError as error:
        found.faults.append(error)
        return
    stem = path.rpartition("/")[2].partition("@")[0] if path.startswith("library:") else Path(path).stem
    found.patterns.append(Incoming(name_from(stem), recipe, origin))


def _refuse_doubles(patterns: Sequence[Incoming]) -> None:
    """Raise where two files would become one pattern; versions of one pattern in a zip are meant so."""
    first: dict[str, Incoming] = {}
    for each in patterns:
        before = first.setdefault(folded(each.name), each)
        if before is not each and before.newest and each.newest:
            if before.recipe.source == each.recipe.source:
                continue
            both = f"{before.origin} and {each.origin} would both be called {shown(each.name)}"
            raise LibraryError(f"{both}: add them one by one, with --name")


# Zips.


def _from_zip(path: str, found: Arrivals, stack: ExitStack) -> None:
    try:
        packed = stack.enter_context(zipfile.ZipFile(path))
        members = _members(packed, path)
        if MANIFEST in members:
            _from_manifest(packed, path, members, found)
            return
        folder = stack.enter_context(tempfile.TemporaryDirectory(prefix="batik-library-"))
        room = MOST_BYTES
        for name, member in members.items():
            target = Path(folder, *PurePosixPath(name).parts)
            target.parent.mkdir(parents=True, exist_ok=True)
            data = _unpacked(packed, member, path, room)
            room -= len(data)
            target.write_bytes(data)
        names = _recipes_of(members)
        if not names:
            raise LibraryError(
                f"{path}: no recipes in this zip, expected TOML files or what was compiled from them"
            )
        for name in names:
            _read(str(Path(folder, name)), f"{path}:{name}", found)
    except (zipfile.BadZipFile, zlib.error, NotImplementedError, EOFError) as error:
        raise LibraryError(f"{path} is no zip, or damaged: {error}") from error
    except OSError as error:
        raise LibraryError(f"{path}: {error.strerror or error}") from error


def _recipes_of(members: Sequence[str] | dict[str, Any]) -> list[str]:
    for suffixes in (RECIPES, COMPILED):
        names = [name for name in members if PurePosixPath(name).suffix.lower() in suffixes]
        if names:
            return sorted(names)
    return []


def _members(packed: zipfile.ZipFile, path: str) -> dict[str, zipfile.ZipInfo]:
    """Return the files in a zip that may be of use, by name.

    Raises:
        LibraryError: where a name leads out of the zip, or there is too much in it.
    """
    found: dict[str, zipfile.ZipInfo] = {}
    infos = packed.infolist()
    if len(infos) > MOST_MEMBERS:
        raise LibraryError(f"{path}: {len(infos):,} files in this zip, expected at most {MOST_MEMBERS:,}")
    for member in infos:
        name = member.filename
        parts = PurePosixPath(name).parts
        if not parts or name.startswith("/") or ".." in parts or "\\" in name or ":" in name or "\0" in name:
            raise LibraryError(f"{path}: {shown(name)} leads out of the zip; nothing was taken from it")
        if stat.S_ISLNK(member.external_attr >> 16):
            raise LibraryError(f"{path}: {shown(name)} is a link; nothing was taken from it")
        hidden = any(part.startswith((".", "__MACOSX")) for part in parts)
        useful = name == MANIFEST or PurePosixPath(name).suffix.lower() in RECIPES + COMPILED
        if member.is_dir() or hidden or not useful:
            continue
        if member.flag_bits & 1:
            raise LibraryError(f"{path}: {shown(name)} is encrypted; nothing was taken from it")
        found[name] = member
    total = sum(member.file_size for member in found.values())
    if total > MOST_BYTES:
        raise LibraryError(
            f"{path}: unpacked it would be {total:,} bytes, expected at most {MOST_BYTES:,}; "
            "nothing was taken from it"
        )
    return found


def _unpacked(packed: zipfile.ZipFile, member: zipfile.ZipInfo, path: str, room: int) -> bytes:
    """Return a file of a zip. How large it says it is counts for nothing."""
    limit = min(MOST_OF_ONE, room)
    with packed.open(member) as file:
        data = file.read(limit + 1)
    if len(data) > limit:
        raise LibraryError(
            f"{path}: {shown(member.filename)} has more than {limit:,} bytes unpacked; "
            "nothing was taken from it"
        )
    return data


def _from_manifest(
    packed: zipfile.ZipFile, path: str, members: dict[str, zipfile.ZipInfo], found: Arrivals
) -> None:
    """Read what another library packed."""
    manifest = _manifest(_unpacked(packed, members[MANIFEST], path, MOST_BYTES), path)
    room = MOST_BYTES
    for pattern in manifest:
        files = pattern["versions"]
        for number, file in enumerate(files, 1):
            if file not in members:
                raise LibraryError(f"{path}: {MANIFEST} names {shown(file)}, which is not in the zip")
            data = _unpacked(packed, members[file], path, room)
            room -= len(data)
            newest = number == len(files)
            try:
                recipe = read_recipe(data.decode("utf-8"), f"{path}:{file}")
            except UnicodeDecodeError:
                found.faults.append(LibraryError(f"{path}:{file} is no text in UTF-8"))
                continue
            except BatikError as error:
                found.faults.append(error)
                continue
            tags, notes = (pattern["tags"], pattern["notes"]) if newest else ((), ())
            found.patterns.append(Incoming(pattern["name"], recipe, path, tags, notes, newest))


def _manifest(data: bytes, path: str) -> list[dict[str, Any]]:
    """Return the patterns that a manifest tells of, each with all its keys."""

    def texts(value: Any) -> tuple[str, ...]:
        if not isinstance(value, list) or not all(isinstance(each, str) for each in value):
            raise ValueError("expected lists of texts")
        return tuple(value)

    try:
        told = json.loads(data)
        if told["format"] != FORMAT:
            words = (
                f"{path}: {MANIFEST} is of format {told['format']!r}, expected {FORMAT}: update this program"
            )
            raise LibraryError(words)
        return [
            {
                "name": checked_name(each["name"]),
                "versions": texts(each["versions"]),
                "tags": checked_tags(texts(each.get("tags", []))),
                "notes": texts(each.get("notes", [])),
            }
            for each in told["patterns"]
        ]
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        raise LibraryError(f"{path}: {MANIFEST} is damaged ({error}); nothing was taken from it") from error


def zipped(library: Library, names: Sequence[str], sink: BinaryIO) -> int:
    """Write patterns with all their versions as a zip into a sink; return how many versions there are."""
    told: list[dict[str, Any]] = []
    count = 0
    with zipfile.ZipFile(sink, "w", zipfile.ZIP_DEFLATED) as packed:
        for name in names:
            versions = library.history(name)
            plain = name.rpartition("/")[2]
            files = [f"{plain}/{version.number}.toml" for version in versions]
            for file, version in zip(files, versions, strict=True):
                _pack(packed, file, library.whole_text(version))
            details = library.about(name)
            notes = [note.text for note in details.notes]
            told.append({"name": plain, "versions": files, "tags": list(details.tags), "notes": notes})
            count += len(files)
        _pack(
            packed, MANIFEST, json.dumps({"format": FORMAT, "patterns": told}, ensure_ascii=False, indent=1)
        )
    return count


def _pack(packed: zipfile.ZipFile, name: str, text: str) -> None:
    member = zipfile.ZipInfo(name, _EPOCH)
    member.compress_type = zipfile.ZIP_DEFLATED
    member.external_attr = 0o644 << 16
    packed.writestr(member, text.encode("utf-8"))


# Files.


def file_name(version: Version, format: str) -> str:
    """Return what the file of a version is called."""
    return f"{version.name.rpartition('/')[2]}.{format}"


def written(library: Library, version: Version, format: str) -> bytes:
    """Return a version as the bytes of a file: its recipe in TOML, or what it compiles to, recipe within.

    Raises:
        BatikError: where it does not compile, or the format is unknown.
    """
    if format == "toml":
        return library.whole_text(version).encode("utf-8")
    recipe = library.recipe(f"{version.name}@{version.number}")
    page = compile_cloth(recipe) if recipe.tile is None else compile_recipe(recipe)
    return render(page, format)
