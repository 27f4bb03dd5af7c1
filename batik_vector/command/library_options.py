"""What the commands of the library share: their options, and their report."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import click

from batik_vector.command.telling import reported

file_option = click.option(
    "--library",
    "path",
    metavar="FILE",
    help="The library's file.  [default: that of BATIK_LIBRARY, or your own]",
)
as_json_option = click.option(
    "--json", "as_json", is_flag=True, help="Print one report for machines on stdout."
)


@contextmanager
def report_of(as_json: bool, what: str) -> Iterator[list[Any]]:
    """Collect what a call finds under a key of its report; see :func:`reported`."""
    with reported(as_json) as report:
        del report["recipes"]
        found: list[Any] = []
        report[what] = found
        yield found
