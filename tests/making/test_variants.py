"""What a sweep varies: ranges, lists and samples as people write them, and names that say what was varied."""

from __future__ import annotations

import math
import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from batik_vector.errors import RecipeError
from batik_vector.making.variants import LONGEST, Axis, parse_axis, short_names, variants


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("n=8,16,24", ("8", "16", "24")),
        ("n=8:24:3", ("8", "16", "24")),
        ("dist=0.4:4:10", ("0.4", "0.8", "1.2", "1.6", "2", "2.4", "2.8", "3.2", "3.6", "4")),
        ("dist=4:0.4:2", ("4", "0.4")),
        ("t=0.01:1:3:log", ("0.01", "0.1", "1")),
        ("t=-1:-100:3:log", ("-1", "-10", "-100")),
        ("width=20mm:40mm:3", ("20 mm", "30 mm", "40 mm")),
        ("width=20:40 mm:3", ("20 mm", "30 mm", "40 mm")),
        ("n=3:3:1", ("3",)),
        ("size=[100, 50],[120, 60]", ("[100, 50]", "[120, 60]")),
        ('name="a,b",c', ('"a,b"', "c")),
        ("n=1,1,2", ("1", "2")),
    ],
)
def test_values_are_read_as_people_write_them(text: str, values: tuple[str, ...]) -> None:
    assert parse_axis(text).values == values


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("n", "expected KEY=VALUES"),
        ("n=", "expected KEY=VALUES"),
        ("=3", "expected KEY=VALUES"),
        ("n=1:2:0", "0 values, expected 1 to 100,000"),
        ("n=1:2:1000000000", "1,000,000,000 values"),
        ("n=0:5:3:log", "expected ends of one sign"),
        ("n=1:1", "nothing between"),
        ("n=1e999:2:3", "finite"),
        ("n=1mm:2cm:3", "expected one unit"),
        ("n=[100, 50],[120", 'a bracket is not closed in "[120"'),
        ('n="a","b', "a quote is not closed"),
    ],
)
def test_what_is_no_range_is_told(text: str, words: str) -> None:
    with pytest.raises(RecipeError, match=re.escape(words)):
        parse_axis(text)


def test_all_combinations_are_made_the_last_axis_first() -> None:
    found = list(variants([parse_axis("a.n=1,2"), parse_axis("a.m=x,y")], "s"))
    assert [each.changes for each in found] == [
        ("a.n=1", "a.m=x"), ("a.n=1", "a.m=y"), ("a.n=2", "a.m=x"), ("a.n=2", "a.m=y"),
    ]  # fmt: skip
    assert [each.name for each in found] == ["s_n-1_m-x", "s_n-1_m-y", "s_n-2_m-x", "s_n-2_m-y"]


def test_too_many_are_told_with_their_count() -> None:
    axes = [parse_axis(f"k{i}=0:1:1000") for i in range(3)]
    with pytest.raises(RecipeError, match="1,000,000,000 variants, expected at most 100,000"):
        variants(axes, "s")
    with pytest.raises(RecipeError, match=r"--vary n: has no count of values"):
        variants([parse_axis("n=1:2")], "s")
    with pytest.raises(RecipeError, match=r"--vary n: is varied twice"):
        variants([parse_axis("n=1,2"), parse_axis("n=3,4")], "s")


def test_names_are_short_tell_keys_apart_and_stay_in_their_folder() -> None:
    assert short_names(["place[0].layout.dist", "motif.a.pistil.count", "motif.b.pistil.count"]) == [
        "dist", "a-pistil-count", "b-pistil-count",
    ]  # fmt: skip
    names = [each.name for each in variants([parse_axis("f=../../etc/passwd,..,C:\\x,a/b,é,")], "s")]
    assert len(set(names)) == len(names)
    assert not any(set(name) & set('/\\:*?"<>|') or ".." in name.partition("_")[2][:4] for name in names)
    long = list(variants([parse_axis(f"text={'x' * 300},{'x' * 300}y")], "s"))
    assert [each.name for each in long] == ["s_0", "s_1"]
    assert all(len(each.name.encode()) <= LONGEST for each in long)


@settings(max_examples=30, deadline=None)
@given(st.integers(1, 6), st.integers(16, 400), st.integers(0, 9))
def test_a_sample_is_spread_evenly_and_hangs_on_its_seed(axes: int, count: int, seed: int) -> None:
    asked = [Axis(f"k{i}", bounds=(0.0, 1.0)) for i in range(axes)]
    found = list(variants(asked, "s", sample=count, seed=seed))
    assert found == list(variants(asked, "s", sample=count, seed=seed))
    assert found != list(variants(asked, "s", sample=count, seed=seed + 1))
    for axis in range(axes):
        values = sorted(float(each.changes[axis].partition("=")[2]) for each in found)
        assert 0 <= values[0] <= values[-1] <= 1
        # No gap is wider than two of the parts, of a power of the prime, that each hold a point.
        gaps = [b - a for a, b in zip([0.0, *values], [*values, 1.0], strict=True)]
        prime = (2, 3, 5, 7, 11, 13)[axis]
        assert max(gaps) <= 2 * prime / count + 0.01


def test_a_sample_of_whole_numbers_holds_both_ends() -> None:
    found = {each.changes[0] for each in variants([parse_axis("n=4:7")], "s", sample=40)}
    assert found == {"n=4", "n=5", "n=6", "n=7"}
    assert all(
        math.isfinite(float(each.changes[0][2:]))
        for each in variants([parse_axis("n=1e-9:1e9")], "s", sample=9)
    )
