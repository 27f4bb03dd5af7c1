"""Tries every numeric key of the schema at its least, its greatest and values between, in a few recipes.

    .venv/bin/python -m tools.bounds                        # 50 values of each key between its bounds
    .venv/bin/python -m tools.bounds --values 2 --only toss --recipes kawung
    .venv/bin/python -m tools.bounds --log bounds.jsonl     # goes on where the last call with this file ended
    .venv/bin/python -m tools.bounds --signals 100          # and the slowest stopped at random moments

Every key is tried once before any is tried twice: first at its greatest in one of the recipes, then at its
least, then both in the others, then at values between. What a log holds as good is not tried again.

Each try is a process of its own that may hold 4 GB: it must write a file or refuse in words, and within 20
seconds of its own time. What does neither is printed and makes the call fail. A value is set in the recipe as
it stands; a table that the recipe has not is put in.

The process is forked from one that has compiled the recipes as they stand, and remembers what they are made
of: so a try costs what its value changes. What that spared is counted as its time at most.
"""

from __future__ import annotations

import argparse
import collections
import contextlib
import dataclasses
import gc
import io
import itertools
import json
import math
import os
import random
import resource
import signal
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

from tools.numeric_keys import SAMPLES, Key, keys, recipe_with

RECIPES = ("four-square", "kawung", "lotus-pond", "group-p4g")
HEARD = 2.0
"""Seconds in which a signal must be heard."""


@dataclass(frozen=True)
class Try:
    """One recipe, to be compiled. It is written when it is tried: there are a hundred thousand."""

    recipe: str
    key: Key
    value: float

    @property
    def name(self) -> str:
        """What it is called in a log."""
        return f"{self.recipe} {self.key} {self.value!r}"

    @property
    def text(self) -> str:
        """The recipe."""
        chance = random.Random(f"{self.recipe} {self.key} {self.value}")
        return recipe_with(self.recipe, self.key, self.value, chance)


@dataclass(frozen=True)
class Outcome:
    """How a try ended. ``kind`` is "written", "refused", or what is wrong."""

    kind: str
    words: str
    cpu: float
    wall: float
    megabytes: float

    @property
    def is_good(self) -> bool:
        """Whether there is an answer or a refusal."""
        return self.kind in ("written", "refused")


def tries(recipes: Sequence[str], count: int, only: str) -> Iterator[Try]:
    """Yield every try, in rounds: one of each key in every round, the keys in random order."""
    chance = random.Random(0)
    lists = [_of_key(key, recipes, count) for key in keys() if only in str(key)]
    chance.shuffle(lists)
    for turn in itertools.zip_longest(*lists):
        yield from (each for each in turn if each is not None)


def _of_key(key: Key, recipes: Sequence[str], count: int) -> list[Try]:
    """Return the tries of a key: its greatest and its least in each recipe, then what lies between."""
    chance = random.Random(str(key))
    turned = chance.sample(recipes, len(recipes))
    low, high, *between = dict.fromkeys(key.values(count))
    bounds = [Try(recipe, key, value) for recipe in turned for value in (high, low)]
    inner = [Try(recipe, key, value) for recipe in turned for value in between]
    return bounds + chance.sample(inner, len(inner))


def tried(each: Try, seconds: float, gigabytes: float, spared: float = 0.0) -> Outcome:
    """Compile a recipe in a process of its own; ``spared`` is what the one it is forked from did for it."""
    read, write = os.pipe()
    begun = time.perf_counter()
    child = os.fork()
    if not child:
        os.close(read)
        _compile(each, write, seconds, gigabytes)
    os.close(write)
    with os.fdopen(read, "rb") as pipe:
        told = pipe.read().decode("utf-8", "replace")
    _, status, used = os.wait4(child, 0)
    kind, _, words = told.partition(" ")
    cpu = used.ru_utime + used.ru_stime + spared
    if os.WIFSIGNALED(status):
        number = os.WTERMSIG(status)
        late = number in (signal.SIGXCPU, signal.SIGKILL, signal.SIGALRM)
        kind, words = ("too slow" if late else "killed"), signal.Signals(number).name
    elif cpu > seconds:
        kind, words = "too slow", words or kind
    return Outcome(kind or "lost", words, cpu, time.perf_counter() - begun, used.ru_maxrss / 1024)


def _compile(each: Try, pipe: int, seconds: float, gigabytes: float) -> None:
    """Do the work of a child, tell by the pipe how it ended, and end."""
    from batik_vector.errors import BatikError

    told = "crashed"
    try:
        resource.setrlimit(resource.RLIMIT_AS, (int(gigabytes * 1e9),) * 2)
        resource.setrlimit(resource.RLIMIT_CPU, (math.ceil(seconds) + 1,) * 2)
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stderr(io.StringIO()):
            path = Path(folder) / "tried.toml"
            path.write_text(each.text, encoding="utf-8")
            told = _run(path, Path(folder) / "out")
    except BatikError as error:
        told = f"refused {error}"
    except MemoryError:
        told = "no memory"
    except BaseException as error:
        told = f"crashed {type(error).__name__}: {error}"
    finally:
        os.write(pipe, told.encode()[:4000])
        os._exit(0)


def _run(path: Path, folder: Path) -> str:
    from batik_vector.making.jobs import planned, read_jobs
    from batik_vector.making.running import run

    for job in planned(read_jobs([str(path)]), folder):
        report = run(job, lambda stage: None)
    return f"written {report['vertices']:,} vertices"


def stopped(each: Try, wait: float, number: signal.Signals) -> tuple[float, int, list[str]]:
    """Run the command on a recipe, stop it after some seconds; return how long it took to end, and how.

    The last is what it left in the folder.
    """
    import subprocess

    with tempfile.TemporaryDirectory() as folder:
        path, out = Path(folder) / "tried.toml", Path(folder) / "out"
        path.write_text(each.text, encoding="utf-8")
        out.mkdir()
        command = [sys.executable, "-m", "batik_vector", "compile", str(path), "-o", str(out)]
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(wait)
        begun = time.perf_counter()
        process.send_signal(number)
        code = process.wait()
        return time.perf_counter() - begun, code, sorted(os.listdir(out))


def main() -> int:
    """Try everything, print what is wrong and the slowest, and say how it came out."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n\n")[0])
    parser.add_argument("--values", type=int, default=50, help="values between the bounds of each key")
    parser.add_argument("--recipes", nargs="+", default=RECIPES, help="samples in which keys are set")
    parser.add_argument("--only", default="", help="part of the names of the keys that are tried")
    parser.add_argument("--seconds", type=float, default=20.0, help="of its own time that a try may take")
    parser.add_argument("--gigabytes", type=float, default=4.0, help="that a try may hold")
    parser.add_argument("--jobs", type=int, default=2, help="tries at a time")
    parser.add_argument("--signals", type=int, default=0, help="moments at which the slowest are stopped")
    parser.add_argument("--log", type=Path, help="file of earlier outcomes, which grows by the new ones")
    parser.add_argument("--until", type=float, default=math.inf, help="seconds after which no try is begun")
    asked = parser.parse_args()
    _warm()
    spared = _compiled(asked.recipes)
    begun = time.monotonic()
    known = _logged(asked.log)
    work = list(tries(asked.recipes, asked.values, asked.only))
    found = [(each, known[each.name]) for each in work if each.name in known]

    def one(each: Try) -> None:
        if each.name in known or time.monotonic() - begun > asked.until:
            return
        outcome = tried(each, asked.seconds, asked.gigabytes, spared[each.recipe])
        found.append((each, outcome))
        if asked.log:
            with asked.log.open("a", encoding="utf-8") as log:
                log.write(json.dumps({"try": each.name, **dataclasses.asdict(outcome)}) + "\n")
        if not outcome.is_good:
            print(_line(each, outcome), flush=True)

    with ThreadPoolExecutor(asked.jobs) as pool:
        list(pool.map(one, work))
    wrong = sum(not outcome.is_good for _, outcome in found)
    _sum_up(found, work)
    return 1 if wrong + (_signals(found, asked.signals) if asked.signals else 0) else 0


def _logged(path: Path | None) -> dict[str, Outcome]:
    """Return the good outcomes of a log by the names of their tries: what went wrong is tried again."""
    if path is None or not path.exists():
        return {}
    rows = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]
    outcomes = {row.pop("try"): Outcome(**row) for row in rows}
    return {name: outcome for name, outcome in outcomes.items() if outcome.is_good}


def _warm() -> None:
    """Import what a try needs, so that its process finds it there."""
    import batik_vector.compiling.borders
    import batik_vector.export.dxf
    import batik_vector.export.pdf
    import batik_vector.making.running
    import batik_vector.recipe.reading.validator
    import batik_vector.tiling.cloth.field
    import batik_vector.tiling.cloth.yardage
    import batik_vector.tiling.tossing.toss  # noqa: F401

    with contextlib.suppress(ImportError):
        import cairosvg  # noqa: F401


def _compiled(recipes: Sequence[str]) -> dict[str, float]:
    """Compile each recipe as it stands, so that a process forked knows its parts; return what each took."""
    took = {}
    for recipe in recipes:
        begun = time.process_time()
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stderr(io.StringIO()):
            _run(SAMPLES / f"{recipe}.toml", Path(folder))
        took[recipe] = time.process_time() - begun
    gc.collect()
    gc.freeze()  # A collection in a fork would copy every page that the two share.
    return took


def _line(each: Try, outcome: Outcome) -> str:
    return (
        f"{outcome.kind:9} {each.recipe:11} {each.key} = {each.value:g}  "
        f"{outcome.cpu:.1f} s ({outcome.wall:.1f}) {outcome.megabytes:.0f} MB  {outcome.words[:200]}"
    )


def _sum_up(found: Sequence[tuple[Try, Outcome]], work: Sequence[Try]) -> None:
    kinds = collections.Counter(outcome.kind for _, outcome in found)
    print(
        f"\n{len(found):,} tries of {len(work):,}: {', '.join(f'{n:,} {kind}' for kind, n in kinds.items())}"
    )
    all_keys = {str(each.key) for each in work}
    tried_keys = {
        "keys": {str(each.key) for each, _ in found},
        "at the greatest": {str(each.key) for each, _ in found if each.value == each.key.high},
        "at the least": {str(each.key) for each, _ in found if each.value == each.key.low},
    }
    for words, names in tried_keys.items():
        print(f"  {words}: {len(names)} of {len(all_keys)}")
    if not found:
        return
    print(f"most memory {max(outcome.megabytes for _, outcome in found):.0f} MB; the slowest:")
    for each, outcome in sorted(found, key=lambda pair: -pair[1].cpu)[:15]:
        print("  " + _line(each, outcome))


def _signals(found: Sequence[tuple[Try, Outcome]], moments: int) -> int:
    """Stop the slowest tries at random moments; return how many did not hear it in time."""
    # What a shell runs in the background ignores Ctrl-C, and so would what it starts.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    slowest = sorted((pair for pair in found if pair[1].is_good), key=lambda pair: -pair[1].cpu)[:10]
    chance, wrong, longest = random.Random(1), 0, 0.0
    for number in range(moments):
        each, outcome = slowest[number % len(slowest)]
        signum = signal.SIGINT if number % 2 else signal.SIGTERM
        wait = chance.uniform(0.1, outcome.wall + 0.3)
        seconds, code, left = stopped(each, wait, signum)
        longest = max(longest, seconds)
        torn = [name for name in left if name.startswith(".")]
        if seconds > HEARD or torn or code not in (0, 1, 2, 128 + signum, -signum):
            wrong += 1
            print(
                f"not heard: {each.recipe} {each.key} = {each.value:g} after {wait:.2f} s: "
                f"{signum.name}, {seconds:.2f} s, exit {code}, left {left}"
            )
    print(f"{moments} signals, {wrong} of them not heard in {HEARD:g} s; the longest took {longest:.2f} s")
    return wrong


if __name__ == "__main__":
    sys.exit(main())
