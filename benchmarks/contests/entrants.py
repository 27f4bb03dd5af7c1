"""Who takes part in what: commands run in turn, or asked once.

Commands are written with ``{folder}``, where a drawing of the contest's size
lies ready and where files go.
"""

from __future__ import annotations

from dataclasses import dataclass

from benchmarks.timing import OWN, PEERS

BATIK = "batik_vector"
"""The entrant that all others are measured by."""


@dataclass(frozen=True)
class Entrant:
    """One that takes part.

    ``inside`` says that the command times parts of its own work and prints them; otherwise its process is
    timed as a whole. ``drawn`` are the files that are read back to see that the drawing is the same.
    ``tiny`` is the same command for four marks: what memory it needs is not the drawing's. ``rounds`` are the
    first rounds, in which alone it takes part, where each of them takes minutes.
    """

    name: str
    says: str
    command: tuple[str, ...]
    inside: bool = False
    drawn: tuple[str, ...] = ()
    tiny: tuple[str, ...] = ()
    rounds: int | None = None


@dataclass(frozen=True)
class Contest:
    """Entrants that run in turn, round after round. ``rings`` is how large a drawing they find ready."""

    name: str
    entrants: tuple[Entrant, ...]
    rounds: int
    rings: int = 0


@dataclass(frozen=True)
class Fact:
    """What a command finds out once, told as JSON, with a drawing of ``rings`` marks ready."""

    name: str
    command: tuple[str, ...]
    rings: int = 0


def own(module: str, *words: str) -> tuple[str, ...]:
    """Return the command that runs a module of ours in our environment."""
    return str(OWN / "python"), "-m", f"benchmarks.{module}", *words


def peer(script: str, *words: str) -> tuple[str, ...]:
    """Return the command that runs a peer's script in the peers' environment."""
    return str(PEERS / "python"), "-m", f"benchmarks.peers.{script}", *words


def compiling(formats: str, recipe: str = "drawing") -> tuple[str, ...]:
    """Return the command that compiles the ready recipe."""
    return str(OWN / "batik-vector"), "compile", f"{{folder}}/{recipe}.toml", "-o", "{folder}", "-f", formats
