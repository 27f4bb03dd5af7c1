"""Patterns are kept with all their versions, and changed whole or not at all."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from batik_vector import LibraryError, Recipe, load_recipe, read_recipe
from batik_vector.library import Library
from batik_vector.library.measuring import Measured

ROOT = Path(__file__).resolve().parents[2]
RECIPE = """# Dots {number}.
title = "Dots {number}"
[motif.dot]
kind = "rosette"
elements = [{{ curve = {{ kind = "circle" }} }}]
[ink.wax]
[[place]]
motif = "dot"
width = {number}
[tile]
size = [40, 40]
"""
NOTHING = Measured()


def recipe(number: int = 1) -> Recipe:
    return read_recipe(RECIPE.format(number=number))


@pytest.fixture
def library(tmp_path: Path) -> Iterator[Library]:
    with Library(tmp_path / "my.library") as opened:
        yield opened


def own(library: Library) -> list[str]:
    return [each.name for each in library.entries(own=True)]


def test_every_version_is_kept_and_the_same_twice_is_one(library: Library) -> None:
    first = library.add("dots", recipe(1), origin="dots.toml")
    assert (first.number, first.fresh) == (1, True)
    assert library.add("dots", recipe(1)) == first._replace(fresh=False)
    assert library.add("Dots", recipe(2)).number == 2
    assert library.version("dots").text == RECIPE.format(number=2)
    assert library.version("dots@1").text == RECIPE.format(number=1)
    assert [(each.number, each.title, each.origin) for each in library.history("dots")] == [
        (1, "Dots 1", "dots.toml"),
        (2, "Dots 2", ""),
    ]
    assert own(library) == ["dots"]
    assert library.check() == []


def test_an_old_version_is_restored_as_the_newest_with_what_was_measured_of_it(library: Library) -> None:
    library.add("dots", recipe(1))
    library.add("dots", recipe(20))
    features = library.features("dots@1")
    assert library.restore("dots@1")[1:] == ("dots", 3, True)
    assert library.version("dots").text == RECIPE.format(number=1)
    assert library.features("dots") == features != library.features("dots@2")
    assert library.details("dots").svg == library.details("dots@1").svg
    assert library.restore("dots@3").fresh is False
    assert library.check() == []


def test_what_is_removed_comes_back_with_all_its_versions(library: Library) -> None:
    library.add("dots", recipe(1), tags=["round"])
    library.add("dots", recipe(2))
    library.remove("dots")
    assert own(library) == []
    assert library.search("dots", own=True) == []
    assert [each.name for each in library.entries(removed=True)] == ["dots"]
    with pytest.raises(LibraryError, match="it was removed, and restore brings it back"):
        library.version("dots")
    library.restore("dots")
    assert library.entries(own=True)[0].tags == ("round",)
    assert len(library.history("dots")) == 2
    library.remove("dots")
    assert library.add("dots", recipe(3)).number == 3
    library.remove("dots", for_good=True)
    assert library.entries(own=True) == library.entries(removed=True) == []
    assert library.add("dots", recipe(1)).number == 1
    assert library.check() == []


def test_removing_several_is_all_or_none(library: Library) -> None:
    library.add("dots", recipe(1))
    with pytest.raises(LibraryError, match='no pattern "dits": did you mean "dots"'):
        library.remove("dots", "dits")
    assert own(library) == ["dots"]


def test_tags_and_notes_are_kept_searched_and_taken(library: Library) -> None:
    library.add("dots", recipe(1), tags=["Wedding", "new year"], note="For the elders")
    assert library.entries(tags=["wedding"], own=True)[0].tags == ("new year", "wedding")
    assert [hit.name for hit in library.search("elders")] == ["dots"]
    assert library.tag("dots", ["wedding"], remove=True) == ("new year",)
    assert library.search("wedding", own=True) == []
    with pytest.raises(LibraryError, match='has no tag "wedding": it has new year'):
        library.tag("dots", ["wedding"], remove=True)
    assert [note.text for note in library.note("dots", " Mürbe ")] == ["For the elders", "Mürbe"]
    assert [hit.name for hit in library.search("murbe", own=True)] == ["dots"]
    assert library.check() == []


def test_samples_and_starters_are_there_and_read_only(library: Library) -> None:
    names = set(library.names())
    assert {"sample/kawung", "starter/kawung", "sample/lasem-bird"} <= names
    assert library.version("kawung").name == "sample/kawung"
    assert library.version("yardage").name == "starter/yardage"
    kept = library.version("sample/kawung")
    assert kept.text == (ROOT / "samples" / "kawung.toml").read_text(encoding="utf-8")
    for change in (
        lambda: library.tag("kawung", ["x"]),
        lambda: library.note("kawung", "x"),
        lambda: library.remove("sample/kawung"),
        lambda: library.remove("sample/kawung", for_good=True),
    ):
        with pytest.raises(LibraryError, match="comes with batik-vector and is read-only"):
            change()
    with pytest.raises(LibraryError, match="is no name of a pattern"):
        library.add("sample/kawung", recipe())
    library.add("kawung", recipe(3), measured=NOTHING)
    assert library.version("kawung").title == "Dots 3"
    assert set(library.names()) == names | {"kawung"}


def test_a_drawing_that_a_motif_needs_is_kept_once_and_compiles_from_the_library(
    library: Library, monkeypatch: pytest.MonkeyPatch
) -> None:
    bird = load_recipe(ROOT / "samples" / "lasem-bird.toml")
    library.add("bird", bird, measured=NOTHING)
    library.add("bird", load_recipe(ROOT / "samples" / "lasem-bird.toml", ["title='B'"]), measured=NOTHING)
    assert dict(library.version("bird").drawings) == dict(bird.drawing)
    assert library.recipe("bird@1").source == bird.source
    monkeypatch.setenv("BATIK_LIBRARY", str(library.path))
    monkeypatch.chdir("/")
    assert load_recipe("library:bird@1").source == bird.source
    assert load_recipe("library:bird").title == "B"
    assert load_recipe("library:bird@1", ["title='C'"]).title == "C"


def test_a_picture_is_drawn_when_it_is_asked_for_and_kept(library: Library) -> None:
    assert library.about("sample/group-pg").svg == b""
    details = library.details("sample/group-pg")
    assert details.svg.startswith(b"<?xml")
    assert details.png.startswith(b"\x89PNG")
    assert library.about("sample/group-pg") == details
    assert details.features["inks"] == 3


def test_many_are_saved_together_or_none(library: Library) -> None:
    def one_and_two() -> None:
        with library.together():
            library.add("one", recipe(1), measured=NOTHING)
            library.add("../two", recipe(2), measured=NOTHING)

    with pytest.raises(LibraryError, match="no name of a pattern"):
        one_and_two()
    assert own(library) == []
    with library.together():
        library.add("one", recipe(1), measured=NOTHING)
        # What fails within is undone by itself.
        with pytest.raises(LibraryError):
            library.remove("one", "three")
        library.add("two", recipe(2), measured=NOTHING)
    assert own(library) == ["one", "two"]


def test_a_recipe_from_python_has_no_text_to_keep(library: Library) -> None:
    from dataclasses import replace

    with pytest.raises(LibraryError, match="made in Python"):
        library.add("dots", replace(recipe(), source=""))


@pytest.mark.parametrize(
    ("reference", "words"),
    [
        ("kawnug", 'no pattern "kawnug": did you mean "sample/kawung"'),
        ("sample/kawnug", 'did you mean "sample/kawung"'),
        ("dots@3", '"dots" has no version 3: expected 1 to 2'),
        ("dots@0", "expected the number of a version behind the @, such as dots@1"),
        ("dots@x", "expected the number of a version"),
        ("dots@", "expected the number of a version"),
        ("", 'no pattern ""'),
        ("q" * 500, "no pattern"),
        ("\0\x1b[2J", "no pattern"),
    ],
)
def test_what_is_not_there_is_told(library: Library, reference: str, words: str) -> None:
    library.add("dots", recipe(1), measured=NOTHING)
    library.add("dots", recipe(2), measured=NOTHING)
    with pytest.raises(LibraryError) as told:
        library.version(reference)
    assert words in str(told.value)
    assert str(told.value).isprintable()
    assert len(str(told.value)) < 200
