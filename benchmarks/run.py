"""The benchmark: batik_vector and its peers, in turn, on one drawing; its tables go into README.md.

python -m benchmarks.run                     everything; about twenty minutes on two cores
python -m benchmarks.run --quick             a smoke run of small sizes; README.md stays as it is
python -m benchmarks.run --only svg,dxf      some sections, told on the terminal
python -m benchmarks.run --page FILE.json    the tables of an earlier run again, into README.md
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from benchmarks import machine
from benchmarks.contests import SECTIONS, facts
from benchmarks.contests.plans import FULL, QUICK, Plan
from benchmarks.results import Results
from benchmarks.running import find_out, folders, run
from benchmarks.tables import page
from benchmarks.timing import ROOT

README = Path(__file__).with_name("README.md")
KEPT = ROOT / "out" / "benchmarks.json"
"""Where all runs of the last call are kept."""
BEGIN, END = "<!-- measured: written by `make bench`, not by hand -->", "<!-- end of what was measured -->"


def measured(plan: Plan, sections: Sequence[str]) -> Results:
    """Run some sections."""
    results = Results(facts={"about": machine.about()})

    def say(words: str) -> None:
        if sys.stderr.isatty():
            print(f"\r\033[K{words}", end="", file=sys.stderr, flush=True)

    with folders() as places:
        for section in sections:
            if not sys.stderr.isatty():
                print(f"{section} …", file=sys.stderr, flush=True)
            for contest in SECTIONS[section](plan):
                run(contest, results, places, say)
            for fact in facts(section, plan):
                say(f"finding out: {fact.name}")
                find_out(fact, results, places)
    say("")
    return results


def put_into(text: str, tables: str) -> str:
    """Return a page with the tables between its marks.

    Raises:
        ValueError: where the page has no marks.
    """
    head, begin, rest = text.partition(BEGIN)
    _, end, tail = rest.partition(END)
    if not begin or not end:
        raise ValueError(f"the page lacks {BEGIN!r} or {END!r}")
    return f"{head}{BEGIN}\n\n{tables}\n{END}{tail}"


def sections_of(words: str) -> list[str]:
    """Return the sections that are named, in their own order.

    Raises:
        argparse.ArgumentTypeError: where one is unknown.
    """
    names = [name.strip() for name in words.split(",") if name.strip()]
    for name in names:
        if name not in SECTIONS:
            raise argparse.ArgumentTypeError(f'no section "{name}": expected {", ".join(SECTIONS)}')
    return [name for name in SECTIONS if name in names]


def main() -> None:
    """Run what the command line asks for, and tell or write the tables."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.run", description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="small sizes, README.md left as it is")
    parser.add_argument("--only", type=sections_of, default=list(SECTIONS), metavar="SECTION,…")
    parser.add_argument("--rounds", type=int, help="how often everything runs  [default: 5]")
    parser.add_argument("--page", type=Path, metavar="FILE.json", help="write the tables of an earlier run")
    asked = parser.parse_args()
    plan = QUICK if asked.quick else FULL
    if asked.rounds:
        plan = replace(plan, rounds=asked.rounds)
    if asked.page:
        results = Results.from_json(asked.page.read_text(encoding="utf-8"))
    else:
        results = measured(plan, asked.only)
        KEPT.parent.mkdir(exist_ok=True)
        KEPT.write_text(results.to_json(), encoding="utf-8")
    text = README.read_text(encoding="utf-8")
    tables = page(results, plan, asked.only, text.partition(END)[2])
    if asked.quick or len(asked.only) < len(SECTIONS):
        print(tables)
        return
    README.write_text(put_into(text, tables), encoding="utf-8")
    print(f"{README.relative_to(ROOT)} written; all runs are in {KEPT.relative_to(ROOT)}", file=sys.stderr)


if __name__ == "__main__":
    main()
