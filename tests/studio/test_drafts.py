from __future__ import annotations

import functools
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.errors import RecipeError
from batik_vector.studio.drafts import Draft, changes_between, parsed
from batik_vector.studio.history import History, Patch
from batik_vector.studio.parameters import Control, controls
from batik_vector.studio.text import rewriting
from tests.studio.text.test_rewriting import TEXTS, comments
from tests.thorough import examples, long

ROOT = Path(__file__).parents[2]
FLOWER = """title = "A flower"
[ink.wax]
[motif.a]
kind = "flower"
petal = { count = 8 }   # petals
[[place]]
motif = "a"
width = "28 cm"
[tile]
size = ["300 mm", 300]
"""


def test_lengths_keep_their_unit_and_numbers_their_kind() -> None:
    draft = Draft(FLOWER)
    assert draft.with_value("place[0].width", 290).value("place[0].width") == "29 cm"
    assert draft.with_value("tile.size[0]", 310.5).value("tile.size") == ["310.5 mm", 300]
    assert draft.with_value("tile.size[1]", 310.5).value("tile.size") == ["300 mm", 310.5]
    assert draft.with_value("place[0].gap", 2).value("place[0].gap") == "2 mm"
    assert draft.with_value("motif.a.petal.count", 12.0).text == FLOWER.replace("8 }", "12 }")
    third = draft.with_value("motif.a.petal.length", 1 / 3).value("motif.a.petal.length")
    assert third == 0.333333


def test_many_numbers_are_set_at_once_as_they_are_one_by_one() -> None:
    draft = Draft(FLOWER)
    values = (
        ("place[0].width", 290, "29 cm"),
        ("motif.a.petal.count", 12, 12),
        ("tile.size[1]", 310.5, 310.5),
    )
    slowly = draft
    for path, _, written in values:
        slowly = slowly.with_text(rewriting.with_value(slowly.text, parsed(path), written))
    quickly = draft.with_values([(path, value) for path, value, _ in values])
    assert quickly.text == slowly.text
    assert quickly.tables == Draft(quickly.text).tables
    # What is not written yet, or is more than a number, goes the long way.
    mixed = draft.with_values({"place[0].width": 290, "place[0].gap": 2})
    assert (mixed.value("place[0].width"), mixed.value("place[0].gap")) == ("29 cm", "2 mm")
    with pytest.raises(RecipeError, match="64 bits"):
        draft.with_value("motif.a.petal.count", 2**70).tables  # noqa: B018


def test_a_number_of_a_pair_that_is_not_written_brings_the_other_along() -> None:
    draft = Draft(FLOWER)
    assert draft.with_value("place[0].at[1]", 20).value("place[0].at") == ["150 mm", "20 mm"]
    assert draft.with_value("place[0].phase[0]", 5).value("place[0].phase") == ["5 mm", "0 mm"]


def test_a_table_that_is_not_written_is_written_with_what_it_was_by_default() -> None:
    draft = Draft(FLOWER)
    before, after = draft.recipe, draft.with_value("motif.a.leaf.count", 5).recipe
    flower, other = before.motif["a"], after.motif["a"]
    assert other.leaf.count == 5  # type: ignore[union-attr]
    assert other.leaf.length == flower.leaf.length  # type: ignore[union-attr]
    assert draft.with_value("place[0].layout.turn", 9).value("place[0].layout") == {
        "kind": "single",
        "turn": 9,
    }


def test_none_takes_a_value_out_and_what_is_not_there_stays_away() -> None:
    draft = Draft(FLOWER)
    assert draft.with_value("title", None).value("title") is None
    assert draft.without("seed") is draft
    assert draft.without("motif.b.petal") is draft


def test_a_draft_that_does_not_read_is_kept_and_told() -> None:
    draft = Draft(FLOWER).with_value("motif.a.petal.count", 999)
    assert draft.value("motif.a.petal.count") == 999
    (fault,) = draft.faults
    assert (fault.key, fault.line) == ("motif.a.petal.count", 5)
    torn = draft.with_text(FLOWER + "]")
    assert torn.faults[0].line == 11
    assert torn.title == "untitled"
    with pytest.raises(RecipeError, match="no valid TOML"):
        torn.with_value("seed", 3)
    assert torn.with_text(FLOWER).faults == ()


@pytest.mark.parametrize("path", ["place[7].turn", "motif.a.petal.count.x", "title[0]", "a b", "[0]"])
def test_a_path_that_leads_nowhere_is_told(path: str) -> None:
    with pytest.raises(RecipeError):
        Draft(FLOWER).with_value(path, 3)


def test_members_come_go_and_move() -> None:
    draft = Draft(FLOWER).inserted("ink.sky", {"colour": "#aaccee"}, 0)
    assert list(draft.tables["ink"]) == ["sky", "wax"]
    with pytest.raises(RecipeError, match="there already"):
        draft.inserted("ink.sky", {})
    draft = draft.inserted("place", {"motif": "a", "width": 30, "ink": "sky"}, 0)
    assert [each["width"] for each in draft.tables["place"]] == [30, "28 cm"]
    assert draft.moved("place[0]", 1).tables["place"][1]["width"] == 30
    # What said no ink as there was but one goes on to be drawn with that.
    assert draft.removed("place[0]").tables["place"] == [{"motif": "a", "width": "28 cm", "ink": "wax"}]
    assert draft.inserted("output", {"format": "svg"}).tables["output"] == [{"format": "svg"}]


def test_what_is_locked_is_known_by_all_around_it() -> None:
    draft = Draft(FLOWER).locking("motif.a.petal").locking("place[0].width")
    assert draft.is_locked("motif.a.petal.count")
    assert draft.is_locked("place[0].width")
    assert not draft.is_locked("motif.a.leaf.count")
    assert draft.locking("motif.a.petal", False).locked == ("place[0].width",)


def test_a_compiled_file_and_the_library_are_read(tmp_path: Path) -> None:
    from batik_vector import compile_recipe, write_artwork

    sample = ROOT / "samples" / "lasem-bird.toml"
    draft = Draft.read(sample)
    assert (draft.stem, draft.faults, draft.drawings) == ("lasem-bird", (), ())
    made = write_artwork(compile_recipe(draft.recipe), tmp_path / "bird.svg")
    again = Draft.read(made)
    assert again.text == draft.text
    assert [name for name, _ in again.drawings] == ["lasem-bird.svg"]
    assert Draft.of_text(again.whole) == Draft(again.text, drawings=again.drawings)
    assert Draft.of_text(again.whole).faults == ()
    shelved = Draft.read("library:sample/kawung")
    assert (shelved.stem, shelved.folder, shelved.faults) == ("kawung", None, ())


KNOWN = sorted(name for name, text in TEXTS.items() if len(text) < 4000)


@functools.cache
def known(name: str) -> list[Control]:
    """Return the controls of a sample's draft."""
    return list(controls(Draft(TEXTS[name])).values())


@long
@settings(max_examples=examples(20, 60), deadline=None, derandomize=True)
@given(st.sampled_from(KNOWN), st.data())
def test_a_slider_anywhere_changes_what_it_says_and_no_comment(name: str, data: st.DataObject) -> None:
    moving = [each for each in known(name) if each.kind in ("number", "whole") and each.span]
    control = data.draw(st.sampled_from(moving))
    value = drawn(data, control)
    draft = Draft(TEXTS[name])
    after = draft.with_value(control.path, value)
    assert controls(after, ())[control.path].value == pytest.approx(value, rel=1e-5, abs=1e-9)
    assert comments(after.text) == comments(draft.text)
    said = list(changes_between(draft, after))
    assert all(each.split("[")[0].split(".")[0] == control.path.split("[")[0].split(".")[0] for each in said)
    assert len(after.text.splitlines()) - len(draft.text.splitlines()) in (0, 1, 2, 3)
    # Taken back by the one step that it was.
    history = History(draft)
    history.did(after, "turned")
    assert history.undo() == draft


def drawn(data: st.DataObject, control: Control) -> float:
    assert control.span is not None
    low, high = control.span
    if control.kind == "whole":
        return data.draw(st.integers(int(low), min(int(high), int(low) + 1000)))
    return data.draw(st.floats(low, high))


@given(st.text("ab\n", max_size=30), st.text("ab\n", max_size=30))
def test_a_patch_leads_there_and_back(old: str, new: str) -> None:
    patch = Patch.between(old, new)
    assert (patch.on(old), patch.off(new)) == (new, old)
    assert len(patch.old) + len(patch.new) <= len(old) + len(new)
    if old == new:
        assert (patch.old, patch.new) == ("", "")


MOVES = st.lists(
    st.one_of(st.integers(0, 9), st.sampled_from(["undo", "redo", "settle", "drag", "lock"])), max_size=12
)


@settings(max_examples=30, deadline=None)
@given(MOVES)
def test_undo_and_redo_are_each_others_inverse(moves: list[int | str]) -> None:
    history = History(Draft(FLOWER))
    shadow, here = [history.now], 0
    open_drag = False
    for number, move in enumerate(moves):
        if move == "undo":
            assert history.can_undo == (here > 0)
            here = max(here - 1, 0)
            open_drag = False
            assert history.undo() == shadow[here]
        elif move == "redo":
            assert history.can_redo == (here < len(shadow) - 1)
            here = min(here + 1, len(shadow) - 1)
            open_drag = False
            assert history.redo() == shadow[here]
        elif move == "settle":
            history.settle()
            open_drag = False
        else:
            now = history.now
            draft = (
                now.locking("seed", not now.is_locked("seed"))
                if move == "lock"
                else now.with_value("seed", number)
            )
            del shadow[here + 1 :]
            if move == "drag" and open_drag:
                here -= 1
                del shadow[here + 1 :]
            history.did(draft, str(move), "drag" if move == "drag" else "")
            shadow.append(draft)
            here += 1
            open_drag = move == "drag"
    assert history.now == shadow[here]
    assert len(history) == len(shadow) - 1
    while history.can_undo:
        history.undo()
    assert history.now == shadow[0]
    while history.can_redo:
        history.redo()
    assert history.now == shadow[-1]


def test_a_slider_dragged_back_to_where_it_was_is_no_step() -> None:
    history = History(Draft(FLOWER))
    for value in (9, 10, 9, 8):
        history.did(history.now.with_value("motif.a.petal.count", value), "petals", "petals")
    assert not history.can_undo
    assert history.now == Draft(FLOWER)


def test_steps_have_names() -> None:
    history = History(Draft(FLOWER))
    history.did(history.now.with_value("seed", 1), "seed")
    history.did(history.now.with_value("seed", 2), "seed again")
    history.undo()
    assert (history.undo_label, history.redo_label) == ("seed", "seed again")
    assert list(history.steps()) == [("seed", True), ("seed again", False)]
    history.did(history.now.with_value("seed", 3), "another")
    assert list(history.steps()) == [("seed", True), ("another", True)]
