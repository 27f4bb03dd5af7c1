"""The process that makes pictures: text and bytes come and go through a pipe, and nothing that is run.

A request is one message, JSON. An answer is one, JSON, and where there is a picture a second one, its bytes.
Before it there may be messages that tell the stage of the work.
"""

from __future__ import annotations

import contextlib
import json
import os
import signal
from dataclasses import asdict, field
from multiprocessing.connection import Connection
from typing import Any

from batik_vector.errors import Fault
from batik_vector.studio.drafts import Draft
from batik_vector.values import frozen

WARM = '[motif.a]\nkind = "flower"\n[[place]]\nmotif = "a"\nwidth = 80\n[tile]\nsize = [100, 100]\n'
"""Compiled at first, so that all is imported when somebody waits."""


@frozen(eq=False)
class Answer:
    """What came back; ``stage`` alone while the work is on."""

    stage: str = ""
    svg: bytes = b""
    facts: dict[str, Any] = field(default_factory=dict)
    verdict: dict[str, Any] = field(default_factory=dict)
    faults: tuple[Fault, ...] = ()
    seconds: float = 0.0
    defect: str = ""


def request_of(draft: Draft, view: Any) -> bytes:
    """Return what is sent for a draft and a view."""
    return json.dumps(
        {
            "text": draft.text,
            "folder": draft.folder,
            "drawings": dict(draft.drawings),
            "stem": draft.stem,
            "view": asdict(view),
        }
    ).encode()


def answer_of(pipe: Connection) -> Answer:
    """Return the next message of an answer.

    Raises:
        EOFError, OSError: where the process has gone.
    """
    told = json.loads(pipe.recv_bytes())
    if "stage" in told:
        return Answer(told["stage"])
    svg = pipe.recv_bytes() if told["picture"] else b""
    faults = tuple(Fault(**each) for each in told["faults"])
    return Answer("", svg, told["facts"], told["verdict"], faults, told["seconds"], told["defect"])


def serve(pipe: Connection) -> None:
    """Be the process: answer until the pipe is closed."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    from batik_vector.studio.views import Looker, View

    looker = Looker()
    looker.look(Draft(WARM), View())
    with contextlib.suppress(EOFError, OSError):
        while True:
            asked = json.loads(pipe.recv_bytes())
            draft = Draft(
                asked["text"],
                asked["folder"],
                drawings=tuple(asked["drawings"].items()),
                stem=asked["stem"],
            )
            _answer(pipe, looker, draft, View(**asked["view"]))


def _answer(pipe: Connection, looker: Any, draft: Draft, view: Any) -> None:
    def tell(stage: str) -> None:
        pipe.send_bytes(json.dumps({"stage": stage}).encode())

    told: dict[str, Any] = {"facts": {}, "verdict": {}, "faults": [], "seconds": 0.0, "defect": ""}
    svg = b""
    try:
        shown = looker.look(draft, view, tell)
        svg = shown.svg.encode()
        told |= {
            "facts": shown.facts,
            "verdict": shown.verdict,
            "faults": [vars(fault) for fault in shown.faults],
            "seconds": shown.seconds,
        }
    except Exception:
        import traceback

        told["defect"] = traceback.format_exc()
    pipe.send_bytes(json.dumps(told | {"picture": bool(svg)}).encode())
    if svg:
        pipe.send_bytes(svg)
