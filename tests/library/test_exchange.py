"""Patterns leave as files and come back; zips from strangers are looked through first."""

from __future__ import annotations

import io
import json
import stat
import zipfile
from collections.abc import Iterator, Mapping
from pathlib import Path

import pytest

from batik_vector import LibraryError, compile_recipe, load_recipe, write_artwork
from batik_vector.library import Library, exchange
from batik_vector.library.exchange import MANIFEST, arrivals, written, zipped
from tests.library.test_store import NOTHING, RECIPE, recipe

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def library(tmp_path: Path) -> Iterator[Library]:
    with Library(tmp_path / "my.library") as opened:
        yield opened


def names(*paths: Path | str) -> list[str]:
    return [each.name for each in arrivals([str(path) for path in paths]).patterns]


def text(number: int) -> str:
    return RECIPE.format(number=number)


def packed(path: Path, files: Mapping[str, str | bytes]) -> Path:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return path


def test_a_zip_of_the_library_makes_another_library_of_the_same(library: Library, tmp_path: Path) -> None:
    library.add("dots", recipe(1), measured=NOTHING, tags=["round", "new year"], note="One\nand two")
    library.add("dots", recipe(2), measured=NOTHING)
    library.add("bird", load_recipe(ROOT / "samples" / "lasem-bird.toml"), measured=NOTHING)
    first, second = io.BytesIO(), io.BytesIO()
    assert zipped(library, ["dots", "bird", "sample/kawung"], first) == 4
    zipped(library, ["dots", "bird", "sample/kawung"], second)
    assert first.getvalue() == second.getvalue()
    target = tmp_path / "all.zip"
    target.write_bytes(first.getvalue())
    found = arrivals([str(target)])
    assert found.faults == []
    with Library(tmp_path / "other.library") as other:
        for each in found.patterns:
            other.add(each.name, each.recipe, measured=NOTHING, tags=each.tags, note="\n".join(each.notes))
        assert [each.name for each in other.entries(own=True)] == ["bird", "dots", "kawung"]
        for name in ("dots", "bird"):
            assert [each.text for each in other.history(name)] == [
                each.text for each in library.history(name)
            ]
            assert other.version(name).drawings == library.version(name).drawings
        assert other.about("dots").tags == ("new year", "round")
        assert [note.text for note in other.notes("dots")] == ["One\nand two"]


@pytest.mark.parametrize("format_", ["svg", "pdf", "dxf", "gcode", "png"])
def test_a_compiled_file_carries_its_recipe_back(library: Library, tmp_path: Path, format_: str) -> None:
    library.add("dots", recipe(2), measured=NOTHING)
    path = tmp_path / f"dots.{format_}"
    path.write_bytes(written(library, library.version("dots"), format_))
    (found,) = arrivals([str(path)]).patterns
    assert found.name == "dots"
    assert library.add("dots", found.recipe, measured=NOTHING).fresh is False


def test_profiles_of_machines_beside_recipes_are_left_out(tmp_path: Path) -> None:
    (tmp_path / "dots.toml").write_text(text(1))
    (tmp_path / "mine.toml").write_text('base = "pen-plotter"\n[tool]\nwidth = "0.3 mm"\n')
    files = {"a.toml": text(1), "b.toml": 'says = "Another"\n'}
    for where, profile in ((tmp_path, tmp_path / "mine.toml"), (packed(tmp_path / "all.zip", files), "")):
        found = arrivals([str(where)])
        assert [len(found.patterns), len(found.faults)] == [1, 0]
        assert found.profiles == [str(profile) if profile else f"{where}:b.toml"]
    (fault,) = arrivals([str(tmp_path / "mine.toml")]).faults
    assert str(fault).startswith(f"{tmp_path / 'mine.toml'}: is the profile of a machine, expected a recipe")
    (tmp_path / "dots.toml").unlink()
    with pytest.raises(LibraryError, match="no recipes, only profiles of machines, such as "):
        arrivals([str(tmp_path)])


def test_a_toml_compiles_from_itself_alone(library: Library, tmp_path: Path) -> None:
    library.add("bird", load_recipe(ROOT / "samples" / "lasem-bird.toml"), measured=NOTHING)
    path = tmp_path / "bird.toml"
    path.write_bytes(written(library, library.version("bird"), "toml"))
    assert library.add("bird", load_recipe(path), measured=NOTHING).fresh is False


def test_folders_give_their_recipes_and_others_what_was_compiled(tmp_path: Path) -> None:
    folder = tmp_path / "mine"
    folder.mkdir()
    with pytest.raises(LibraryError, match="no recipes in this folder"):
        names(folder)
    write_artwork(compile_recipe(recipe(3)), folder / "drawn.svg")
    assert names(folder) == ["drawn"]
    (folder / "b c.toml").write_text(text(1), encoding="utf-8")
    (folder / "a.toml").write_text(text(2), encoding="utf-8")
    assert names(folder) == ["a", "b c"]
    assert names(folder / "a.toml", folder / "drawn.svg") == ["a", "drawn"]


def test_two_recipes_never_become_one_pattern_unnoticed(tmp_path: Path) -> None:
    for number, folder in enumerate(("one", "two"), 1):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "dots.toml").write_text(text(number), encoding="utf-8")
    with pytest.raises(LibraryError, match='would both be called "dots": add them one by one'):
        names(tmp_path / "one", tmp_path / "two")
    with pytest.raises(LibraryError, match="2 recipes, expected one to be called"):
        arrivals([str(tmp_path / "one"), str(tmp_path / "two")], name="both")
    assert arrivals([str(tmp_path / "one")], name="Uno").patterns[0].name == "Uno"


def test_what_is_wrong_with_one_keeps_back_no_other(tmp_path: Path) -> None:
    (tmp_path / "bad.toml").write_text(text(1).replace("circle", "cirle"), encoding="utf-8")
    (tmp_path / "good.toml").write_text(text(1), encoding="utf-8")
    found = arrivals([str(tmp_path), str(tmp_path / "missing.toml")])
    assert [each.name for each in found.patterns] == ["good"]
    words = [str(error) for error in found.faults]
    assert f"{tmp_path / 'bad.toml'}:5:" in words[0]
    assert "missing.toml: no such file" in words[1]


def test_a_zip_of_recipes_and_their_drawings_is_taken_as_a_folder(tmp_path: Path) -> None:
    bird = ROOT / "samples" / "lasem-bird.toml"
    files: dict[str, str | bytes] = {
        "sub/lasem-bird.toml": bird.read_bytes(),
        "sub/lasem-bird.svg": bird.with_suffix(".svg").read_bytes(),
        "bad.toml": "title = ",
        "__MACOSX/sub/._lasem-bird.toml": b"\0",
        "readme.txt": "hello",
    }
    path = packed(tmp_path / "mine.zip", files)
    found = arrivals([str(path)])
    (each,) = found.patterns
    assert (each.name, each.origin) == ("lasem-bird", f"{path}:sub/lasem-bird.toml")
    assert list(each.recipe.drawing) == ["lasem-bird.svg"]
    # Where it was unpacked is nobody's business.
    assert str(found.faults[0]).startswith(f"{path}:bad.toml:1: is no valid TOML")


@pytest.mark.parametrize(
    "name",
    ["../dots.toml", "/etc/dots.toml", "a/../../dots.toml", "..\\dots.toml", "C:/dots.toml", "C:dots.toml"],
)
def test_a_zip_that_leads_elsewhere_is_refused(tmp_path: Path, name: str) -> None:
    path = packed(tmp_path / "bad.zip", {"good.toml": text(1), name: text(2)})
    with pytest.raises(LibraryError, match="leads out of the zip; nothing was taken"):
        names(path)
    assert list(tmp_path.rglob("*")) == [path]


def test_a_link_in_a_zip_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "bad.zip"
    with zipfile.ZipFile(path, "w") as archive:
        link = zipfile.ZipInfo("dots.toml")
        link.external_attr = (stat.S_IFLNK | 0o777) << 16
        archive.writestr(link, "/etc/passwd")
    with pytest.raises(LibraryError, match=r'"dots.toml" is a link'):
        names(path)


def test_a_zip_bomb_is_refused_by_what_it_says_and_by_what_it_does(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(exchange, "MOST_BYTES", 3_000_000)
    monkeypatch.setattr(exchange, "MOST_OF_ONE", 2_000_000)
    bomb = packed(tmp_path / "bomb.zip", {f"{n}.toml": b"#" * 1_900_000 for n in range(4)})
    with pytest.raises(
        LibraryError, match=r"unpacked it would be 7,600,000 bytes, expected at most 3,000,000"
    ):
        names(bomb)
    one = packed(tmp_path / "one.zip", {"1.toml": b"#" * 2_500_000})
    with pytest.raises(LibraryError, match="has more than 2,000,000 bytes unpacked"):
        names(one)
    # A size that is told wrong is no way round: zipfile reads no more than was told, and its sum is wrong.
    data = one.read_bytes().replace((2_500_000).to_bytes(4, "little"), (100).to_bytes(4, "little"))
    one.write_bytes(data)
    with pytest.raises(LibraryError, match=r"is no zip, or damaged"):
        names(one)
    monkeypatch.setattr(exchange, "MOST_MEMBERS", 3)
    with pytest.raises(LibraryError, match="4 files in this zip, expected at most 3"):
        names(bomb)


@pytest.mark.parametrize(
    ("manifest", "words"),
    [
        ("{", "is damaged"),
        ("[]", "is damaged"),
        ('{"format": 1}', "is damaged"),
        ('{"format": 2, "patterns": []}', "is of format 2, expected 1: update"),
        ({"name": "../x", "versions": ["1.toml"]}, "is no name of a pattern"),
        ({"name": "x", "versions": "1.toml"}, "expected lists of texts"),
        ({"name": "x", "versions": ["2.toml"]}, 'names "2.toml", which is not in the zip'),
        ({"name": "x", "versions": ["1.toml"], "tags": ["a, b"]}, "is no tag"),
        ("[" * 100_000, "is damaged"),
    ],
)
def test_a_bad_manifest_is_told(tmp_path: Path, manifest: str | dict[str, object], words: str) -> None:
    said = manifest if isinstance(manifest, str) else json.dumps({"format": 1, "patterns": [manifest]})
    path = packed(tmp_path / "bad.zip", {MANIFEST: said, "1.toml": text(1)})
    with pytest.raises(LibraryError, match=r"bad\.zip|no name|no tag") as told:
        names(path)
    assert words in str(told.value)


def test_what_is_no_zip_is_told(tmp_path: Path) -> None:
    path = tmp_path / "no.zip"
    with pytest.raises(LibraryError, match="No such file"):
        names(path)
    path.write_bytes(b"PK\3\4 nothing")
    with pytest.raises(LibraryError, match=r"is no zip, or damaged"):
        names(path)
    with pytest.raises(LibraryError, match="no recipes in this zip"):
        names(packed(path, {"a.txt": "x"}))
