"""The process that makes pictures: text and bytes come and go through a pipe, and nothing that is run.

A request is one message, JSON. An answer is one, JSON, and after it come the bytes of each file that was
made. Before it there may be messages that tell the stage of the work.
"""

from __future__ import annotations

import contextlib
import json
import os
import signal
from collections.abc import Callable
from dataclasses import asdict, field
from multiprocessing.connection import Connection
from typing import TYPE_CHECKING, Any

from batik_vector.errors import Fault
from batik_vector.studio.asking import View, Wishes
from batik_vector.studio.drafts import Draft
from batik_vector.values import frozen

if TYPE_CHECKING:
    from batik_vector.studio.views import Looker

BEGUN = "begun"
"""The stage told first: from then on the work counts, and not that the process had to be started."""


@frozen(eq=False)
class Answer:
    """What came back; ``stage`` alone while the work is on.

    ``files`` are what was made, by name: a picture has none.
    """

    stage: str = ""
    files: dict[str, bytes] = field(default_factory=dict)
    facts: dict[str, Any] = field(default_factory=dict)
    verdict: dict[str, Any] = field(default_factory=dict)
    faults: tuple[Fault, ...] = ()
    seconds: float = 0.0
    defect: str = ""

    @property
    def svg(self) -> bytes:
        """The picture, where there is one."""
        return self.files.get("", b"")


def request_of(draft: Draft, wanted: View | Wishes) -> bytes:
    """Return what is sent for a draft, and how it is to be looked at or exported."""
    told = {"text": draft.text, "folder": draft.folder, "drawings": dict(draft.drawings), "stem": draft.stem}
    return json.dumps({**told, type(wanted).__name__.lower(): asdict(wanted)}).encode()


def answer_of(pipe: Connection) -> Answer:
    """Return the next message of an answer.

    Raises:
        EOFError, OSError: where the process has gone.
    """
    told = json.loads(pipe.recv_bytes())
    if "stage" in told:
        return Answer(told["stage"])
    files = {name: pipe.recv_bytes() for name in told["files"]}
    faults = tuple(Fault(**each) for each in told["faults"])
    return Answer("", files, told["facts"], told["verdict"], faults, told["seconds"], told["defect"])


def serve(pipe: Connection) -> None:
    """Be the process: answer until the pipe is closed."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    from batik_vector.studio.views import WARM, Looker

    looker = Looker()
    looker.look(Draft(WARM.read_text("utf-8")), View(certify=True))
    with contextlib.suppress(EOFError, OSError):
        while True:
            asked = json.loads(pipe.recv_bytes())
            pipe.send_bytes(json.dumps({"stage": BEGUN}).encode())
            drawings = tuple(asked["drawings"].items())
            draft = Draft(asked["text"], asked["folder"], drawings=drawings, stem=asked["stem"])

            def tell(stage: str) -> None:
                pipe.send_bytes(json.dumps({"stage": stage}).encode())

            told, files = _made(looker, draft, asked, tell)
            pipe.send_bytes(json.dumps(told | {"files": list(files)}).encode())
            for data in files.values():
                pipe.send_bytes(data)


def _made(
    looker: Looker, draft: Draft, asked: dict[str, Any], tell: Callable[[str], None]
) -> tuple[dict[str, Any], dict[str, bytes]]:
    """Return what is told of the work, and the files that it made."""
    told: dict[str, Any] = {"facts": {}, "verdict": {}, "faults": [], "seconds": 0.0, "defect": ""}
    files: dict[str, bytes] = {}
    try:
        if "wishes" in asked:
            from batik_vector.studio.exports import export

            held = asked["wishes"]
            formats, processes, colourways = (
                tuple(held[key]) for key in ("formats", "processes", "colourways")
            )
            wishes = Wishes(formats, processes, held["machine"], held["recipe"], colourways)
            made = export(draft, wishes, tell)
            files, faults, seconds = dict(made.files), made.faults, made.seconds
            told["facts"] = made.report
        else:
            shown = looker.look(draft, View(**asked["view"]), tell)
            files = {"": shown.svg.encode()} if shown.svg else {}
            faults, seconds = shown.faults, shown.seconds
            told |= {"facts": shown.facts, "verdict": shown.verdict}
        told |= {"faults": [vars(fault) for fault in faults], "seconds": seconds}
    except Exception:
        import traceback

        told["defect"] = traceback.format_exc()
    return told, files
