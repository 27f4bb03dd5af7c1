from __future__ import annotations

import asyncio
import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest

from batik_vector.command.watch import watch_command
from batik_vector.errors import RecipeError
from batik_vector.studio import watching
from batik_vector.studio.drafts import Draft
from batik_vector.studio.following import follow
from batik_vector.studio.watching import GONE, REST, Watched
from tests.calling import runner
from tests.recipe.test_bad_input import BASE

DRAWN = BASE + '[motif.own]\nkind = "svg"\nfile = "leaf.svg"\n[[place]]\nmotif = "own"\nwidth = 20\n'
LEAF = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><circle cx="4" cy="4" r="{}"/></svg>'


@pytest.fixture
def recipe(tmp_path: Path) -> Path:
    path = tmp_path / "k.toml"
    path.write_text(DRAWN)
    (tmp_path / "leaf.svg").write_text(LEAF.format(3))
    return path


def touch(path: Path, text: str) -> None:
    """Save as editors do: a new file takes the old one's place."""
    beside = path.with_name("saving.tmp")
    beside.write_text(text)
    os.replace(beside, path)


class Clock:
    """Sleeps for nobody, and does what is to happen meanwhile."""

    def __init__(self, *acts: object) -> None:
        self.acts = iter(acts)
        self.slept = 0.0

    def __call__(self, seconds: float) -> None:
        self.slept += seconds
        act = next(self.acts, None)
        if callable(act):
            act()


def test_the_recipe_and_all_that_it_names_are_watched(recipe: Path) -> None:
    watched = Watched(str(recipe))
    assert [Path(each).name for each in watched.files] == ["k.toml", "leaf.svg"]
    assert watched.changed() == ()
    touch(recipe.with_name("leaf.svg"), LEAF.format(2))
    assert [Path(each).name for each in watched.changed()] == ["leaf.svg"]


def test_what_a_later_save_names_is_watched_from_then_on(recipe: Path) -> None:
    recipe.write_text(BASE)
    watched = Watched(str(recipe))
    assert len(watched.files) == 1
    touch(recipe, DRAWN)
    watched.seen()
    assert len(watched.files) == 2
    assert watched.changed() == ()


def test_a_recipe_that_does_not_read_is_watched_with_what_it_names(recipe: Path) -> None:
    recipe.write_text(DRAWN + "nonsense = 1\n")
    assert len(Watched(str(recipe)).files) == 2
    recipe.write_text(DRAWN + "this is no TOML\n")
    assert len(Watched(str(recipe)).files) == 1


def test_several_writes_of_one_save_are_one_change(recipe: Path) -> None:
    watched = Watched(str(recipe))
    clock = Clock(
        lambda: touch(recipe, DRAWN + "# half\n"),
        lambda: touch(recipe, DRAWN + "# half, and the rest\n"),
        lambda: touch(recipe.with_name("leaf.svg"), LEAF.format(1)),
    )
    changes = watched.changes(clock)
    assert len(next(changes)) == 1
    assert watched.changed() == ()


def test_a_recipe_on_its_way_into_place_is_waited_for(recipe: Path) -> None:
    watched = Watched(str(recipe))
    text = recipe.read_text()
    recipe.unlink()
    clock = Clock(None, None, lambda: recipe.write_text(text + "# back\n"))
    watched.settled(clock)
    assert recipe.exists()
    assert clock.slept < GONE


def test_a_recipe_that_is_gone_is_told_after_a_while(recipe: Path) -> None:
    watched = Watched(str(recipe))
    recipe.unlink()
    clock = Clock()
    watched.settled(clock)
    assert GONE <= clock.slept <= GONE + 3 * REST


def test_what_is_saved_while_one_works_is_the_next_change(recipe: Path) -> None:
    changes = Watched(str(recipe)).changes(Clock())
    touch(recipe, DRAWN + "# one\n")
    next(changes)
    touch(recipe, DRAWN + "# two\n")
    assert next(changes) == (str(recipe),)


@pytest.mark.parametrize("name", ["none.toml", "k.svg"])
def test_what_nobody_saves_is_refused(recipe: Path, name: str) -> None:
    recipe.with_name("k.svg").write_text("<svg/>")
    with pytest.raises(RecipeError, match=r"no such file|compiled from a recipe"):
        Watched(str(recipe.with_name(name)))


def test_the_command_goes_on_over_faults(recipe: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    saves = iter((DRAWN.replace("[tile]", "[tile]\nsise = 3"), DRAWN + "# mended\n"))

    def changes(self: Watched) -> Iterator[tuple[str, ...]]:
        for text in saves:
            touch(recipe, text)
            yield (str(recipe),)

    monkeypatch.setattr(Watched, "changes", changes)
    out = recipe.with_name("out")
    done = runner().invoke(watch_command, [str(recipe), "-o", str(out), "-f", "svg,dxf", "--json"])
    reports = [json.loads(line) for line in done.stdout.splitlines()]
    assert [each["exit"] for each in reports] == [0, 2, 0]
    assert reports[1]["faults"][0]["key"] == "tile"
    assert "sise" in done.stderr
    assert sorted(path.name for path in out.iterdir()) == ["k.dxf", "k.svg"]
    assert b"# mended" in (out / "k.svg").read_bytes()


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
def test_a_real_save_is_compiled_and_ctrl_c_ends_it(recipe: Path) -> None:
    with subprocess.Popen(
        [sys.executable, "-m", "batik_vector", "watch", recipe.name, "-o", "out"],
        cwd=recipe.parent,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    ) as run:
        try:
            assert run.stderr is not None
            told = until(run.stderr, "watching")
            assert "out/k.svg" in told
            touch(recipe, DRAWN + "# a second one\n")
            until(run.stderr, "saved")
            until(run.stderr, "vertices")
            run.send_signal(signal.SIGINT)
            rest = run.stderr.read()
            assert run.wait(timeout=60) == 130
        finally:
            run.kill()
    assert "Traceback" not in rest
    assert "# a second one" in (recipe.parent / "out" / "k.svg").read_text()


def until(lines: Iterable[str], word: str) -> str:
    told = ""
    for line in lines:
        told += line
        if word in line:
            return told
    raise AssertionError(told)


def test_files_are_asked_rarely_enough() -> None:
    assert 1 / watching.PERIOD <= 20


def test_the_page_follows_what_is_saved_elsewhere(recipe: Path) -> None:
    drafts: list[Draft] = []

    async def saved(text: str) -> Draft:
        before = len(drafts)
        recipe.write_text(text, "utf-8")
        async with asyncio.timeout(20):
            while len(drafts) == before:
                await asyncio.sleep(0.02)
        return drafts[-1]

    async def run() -> None:
        watched = Watched(str(recipe))
        following = asyncio.create_task(follow(SimpleNamespace(follow=drafts.append), watched))  # type: ignore[arg-type]
        good = recipe.read_text("utf-8")
        assert (await saved(good + "# more\n")).text.endswith("# more\n")
        # What is wrong is shown, too; a file that is gone is waited for.
        assert (await saved("tile = [")).faults
        recipe.unlink()
        await asyncio.sleep(0.3)
        assert (await saved(good)).text == good
        following.cancel()

    asyncio.run(run())
