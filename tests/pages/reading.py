"""A page as whoever follows it reads it: its blocks, and the calls in its sentences."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
DOCS = ROOT / "docs"
PAGES = ["../README.md", *sorted(path.relative_to(DOCS).as_posix() for path in DOCS.rglob("*.md"))]
"""All pages, as docs/ names them."""

SEEN = re.compile(
    r"^```(?P<kind>[^\n]*)\n(?P<text>.*?)^```$|(?<!`)`(?P<call>(?:batik-vector|vpype batik) [^`]+)`",
    re.MULTILINE | re.DOTALL,
)
MADE = re.compile(r"(?!.*\b[A-Z]{4,}\b)(?!.* (-h|--help)).*(\w\.[a-z]|library:)", re.DOTALL)
"""A call in a sentence that can be made: it names a file, and has no FILE to fill in."""


@dataclass(frozen=True)
class Block:
    """A fenced block of a page, or (``kind = "said"``) a call in a sentence."""

    kind: str
    text: str

    @property
    def lines(self) -> list[str]:
        """What is typed, line by line: joined where a backslash says so, and with its comments."""
        if self.kind == "console":
            typed = [line[2:] for line in self.text.splitlines() if line.startswith("$ ")]
        else:
            typed = re.sub(r"\\\n\s*", " ", self.text).splitlines()
        return [line.rstrip() for line in typed if bare(line)]

    @property
    def shown(self) -> list[str]:
        """What a console shows of what its lines print, line by line of those."""
        return [part.partition("\n")[2].strip() for part in re.split(r"^\$ ", self.text, flags=re.M)[1:]]


def bare(line: str) -> str:
    """Return a line of a shell without its comment."""
    return re.sub(r"(^|\s+)#( .*|$)", "", line).strip()


def blocks(page: str) -> list[Block]:
    """Return the blocks of a page and the calls in its sentences, in their order."""
    found = []
    for seen in SEEN.finditer((DOCS / page).read_text(encoding="utf-8")):
        if seen["call"] is None:
            found.append(Block(seen["kind"], seen["text"]))
        elif MADE.match(seen["call"]):
            found.append(Block("said", " ".join(seen["call"].split())))
    return found


def calls(page: str) -> list[str]:
    """Return what a page types into a shell, line by line."""
    typed = ("sh", "console", "said")
    return [line for block in blocks(page) if block.kind in typed for line in block.lines]
