"""What the commands share: reports for machines, faults in words, and the stage of work that takes long."""

from __future__ import annotations

import gc
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import click

from batik_vector._version import __version__
from batik_vector.errors import BatikError, RecipeError


def complain(words: str) -> None:
    """Print an error for people."""
    for line in words.splitlines():
        click.echo(f"batik-vector: error: {line}", err=True)


def counted(count: int, what: str) -> str:
    """Return a count with the word for what was counted: 1 pattern, 2 patterns."""
    return f"{count:,} {what}{'s' * (count != 1)}"


@contextmanager
def stages(quiet: bool) -> Iterator[Callable[[str], None]]:
    """Show the stage of work that takes long, on a terminal."""
    if quiet or not sys.stderr.isatty():
        yield lambda stage: None
        return
    from tqdm import tqdm

    with tqdm(bar_format="{desc} {elapsed}", delay=1, leave=False) as bar:
        yield lambda stage: bar.set_description_str(stage)


@contextmanager
def reported(as_json: bool) -> Iterator[dict[str, Any]]:
    """Collect the report of a call; print it if asked to, also where the call fails; exit as it says."""
    report: dict[str, Any] = {"version": __version__, "exit": 0, "recipes": [], "faults": []}
    with faults_told(report):
        yield report
    if as_json:
        import json

        click.echo(json.dumps(report, indent=2))
    if report["exit"]:
        click.get_current_context().exit(report["exit"])


@contextmanager
def faults_told(report: dict[str, Any]) -> Iterator[None]:
    """Tell an error and go on, so that one recipe does not keep back the others."""
    try:
        yield
    except BatikError as error:
        complain(str(error))
        report["exit"] = max(report["exit"], error.exit_code)
        if isinstance(error, RecipeError):
            report["faults"] += [vars(fault) for fault in error.faults]
        else:
            report["faults"].append({"message": str(error), "key": "", "source": "", "line": None})


def collecting() -> None:
    """Begin to collect garbage, where it is not, once all that a command needs is imported."""
    if not gc.isenabled():
        gc.freeze()
        gc.enable()


def sheet_told(as_json: bool, make: Callable[[Callable[[str], None]], dict[str, Any]]) -> None:
    """Draw a sheet of one recipe and tell where it was written.

    Args:
        as_json: whether the report is printed in place of the paths.
        make: draws it; it is given what tells the stage of work, and returns what is reported.
    """
    with reported(as_json) as report:
        with faults_told(report), stages(as_json) as tell:
            report["recipes"].append(make(tell))
        if not as_json:
            for each in report["recipes"]:
                for path in each["files"]:
                    click.echo(path, err=True)
