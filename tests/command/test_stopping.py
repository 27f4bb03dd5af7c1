from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tests.recipe.test_bad_input import BASE

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")

WORK = """
import sys
import numpy as np, shapely
import batik_vector.making.running as running
from batik_vector.export import files

files.CAN_BE_NAMELESS = False
TANGLE = shapely.Polygon(np.random.default_rng(0).random((3000, 2)))

def in_geos(*_, **__):
    print("begun", flush=True)
    shapely.make_valid(TANGLE)

def in_python(*_, **__):
    print("begun", flush=True)
    while True: pass

def writing(page, output, sink, *_):
    sink.write(b"x" * (files.BUFFER + 1))
    in_geos()

if {where!r} == "writing": running.render_output = writing
else: running.compile_recipe = {where}
sys.argv[1:] = ["compile", "k.toml", "-o", "out"]
import batik_vector.__main__
"""


@pytest.mark.parametrize("where", ["in_geos", "in_python", "writing"])
@pytest.mark.parametrize(
    ("number", "code", "words"), [(signal.SIGINT, 130, "interrupted"), (signal.SIGTERM, 143, "")]
)
def test_a_signal_ends_the_command_whatever_it_is_at(
    tmp_path: Path, where: str, number: signal.Signals, code: int, words: str
) -> None:
    """What it is at would take many minutes."""
    (tmp_path / "k.toml").write_text(BASE)
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "k.svg").write_text("before")
    script = WORK.format(where=where)
    with subprocess.Popen(
        [sys.executable, "-c", script],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as run:
        try:
            assert run.stdout is not None
            assert run.stdout.readline() == "begun\n"
            run.send_signal(number)
            _, told = run.communicate(timeout=60)
        finally:
            run.kill()
    assert (run.returncode, words in told, "Traceback" in told) == (code, True, False), told
    assert os.listdir(tmp_path / "out") == ["k.svg"]
    assert (tmp_path / "out" / "k.svg").read_text() == "before"
