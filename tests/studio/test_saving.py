from __future__ import annotations

import threading
from pathlib import Path

import pytest

from batik_vector.errors import RecipeError
from batik_vector.library import Library
from batik_vector.studio.drafts import Draft
from batik_vector.studio.saving import NewerError, Saving, fingerprint, save, save_file
from tests.studio.test_drafts import FLOWER


@pytest.fixture
def shelf(tmp_path: Path) -> str:
    return str(tmp_path / "shelf")


def test_a_draft_becomes_the_newest_version(shelf: str) -> None:
    draft = Draft(FLOWER)
    assert save(draft, Saving("rose", library=shelf)) == ("rose", 1, True)
    assert save(draft, Saving("rose", 1, shelf)) == ("rose", 1, False)
    tagged = Saving("rose", 1, shelf, tags=("red",), note="better")
    assert save(draft.with_value("seed", 2), tagged) == ("rose", 2, True)
    with Library(shelf) as library:
        assert [each.text for each in library.history("rose")] == [FLOWER, draft.with_value("seed", 2).text]
        assert library.about("rose").tags == ("red",)


def test_who_saves_over_what_he_has_not_seen_is_told(shelf: str) -> None:
    save(Draft(FLOWER), Saving("rose", library=shelf))
    mine, theirs = (Draft(FLOWER).with_value("seed", seed) for seed in (1, 2))
    assert save(theirs, Saving("rose", 1, shelf))[1] == 2
    with pytest.raises(NewerError, match="has version 2 by now, and this began with version 1"):
        save(mine, Saving("rose", 1, shelf))
    with pytest.raises(NewerError, match="began with nothing"):
        save(mine, Saving("rose", library=shelf))
    assert save(mine, Saving("rose", 1, shelf, over=True))[1] == 3
    with Library(shelf) as library:
        assert [each.text for each in library.history("rose")] == [FLOWER, theirs.text, mine.text]


def test_of_many_who_save_at_once_all_but_one_are_told(shelf: str) -> None:
    save(Draft(FLOWER), Saving("rose", library=shelf))
    told: list[object] = []

    def saving(seed: int) -> None:
        try:
            told.append(save(Draft(FLOWER).with_value("seed", seed), Saving("rose", 1, shelf))[1])
        except NewerError as error:
            told.append(error)

    threads = [threading.Thread(target=saving, args=(seed,)) for seed in (1, 2, 3)]
    for each in threads:
        each.start()
    for each in threads:
        each.join()
    assert sorted(map(str, told)) == sorted(["2", *(str(each) for each in told if each != 2)])
    assert sum(isinstance(each, NewerError) for each in told) == 2


def test_what_does_not_compile_is_not_saved(shelf: str) -> None:
    with pytest.raises(RecipeError):
        save(Draft(FLOWER).with_value("motif.a.petal.count", 999), Saving("rose", library=shelf))
    with Library(shelf) as library:
        assert library.entries(own=True) == []


def test_a_file_is_written_where_it_is_as_it_was_seen(tmp_path: Path) -> None:
    path = tmp_path / "rose.toml"
    draft = Draft(FLOWER)
    seen = save_file(draft, path)
    assert (path.read_text(), seen) == (FLOWER, fingerprint(FLOWER))
    more = draft.with_value("seed", 3)
    seen = save_file(more, path, seen)
    path.write_text("by another program")
    with pytest.raises(NewerError, match="says something else"):
        save_file(draft, path, seen)
    assert path.read_text() == "by another program"
    save_file(draft, path, "*")
    with pytest.raises(NewerError):
        save_file(more, path)
    assert path.read_text() == FLOWER


def test_drawings_go_with_a_draft_that_stands_nowhere(tmp_path: Path) -> None:
    draft = Draft(FLOWER).with_drawing("leaf.svg", "<svg/>")
    save_file(draft, tmp_path / "a.toml")
    assert Draft.read(tmp_path / "a.toml").drawings == (("leaf.svg", "<svg/>"),)
