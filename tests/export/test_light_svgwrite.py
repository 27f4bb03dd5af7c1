"""svgwrite is imported lightly, and is whole for whoever uses it beside us."""

from __future__ import annotations

import subprocess
import sys

SCRIPT = """
import sys
from batik_vector.export import light_svgwrite

svgwrite = light_svgwrite.svgwrite()
assert svgwrite is light_svgwrite.svgwrite() is sys.modules["svgwrite"]
print([name for name in ("urllib.request", "ssl", "svgwrite.data.svgparser") if name in sys.modules])

drawing = svgwrite.Drawing(debug=True)
print(drawing.path(d="M0 0L1 1").tostring())
try:
    drawing.path(d="nonsense").tostring()
except TypeError as error:
    print(error)
try:
    svgwrite.container.urlopen("nowhere:")
except OSError as error:
    print(error)

import urllib.request
import svgwrite.data.svgparser
print(urllib.request.Request.__module__, svgwrite.data.svgparser.is_valid_pathdata("M0 0"))
"""


def test_what_svgwrite_takes_with_it_waits_until_it_is_called() -> None:
    done = subprocess.run([sys.executable, "-c", SCRIPT], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    light, path, refused, nowhere, whole = done.stdout.splitlines()
    assert light == "[]"
    assert path == '<path d="M0 0L1 1" />'
    assert "'nonsense' is not a valid value" in refused
    assert "unknown url type: nowhere" in nowhere
    assert whole == "urllib.request True"


def test_where_svgwrite_is_imported_already_it_is_that() -> None:
    script = (
        "import svgwrite\nfrom batik_vector.export import light_svgwrite\n"
        "print(light_svgwrite.svgwrite() is svgwrite)"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout == "True\n"


def test_beside_other_threads_nothing_stands_in_for_anything() -> None:
    script = """
import sys, threading
from batik_vector.export import light_svgwrite

done = threading.Event()
threading.Thread(target=done.wait).start()
light_svgwrite.svgwrite()
print("ssl" in sys.modules)
done.set()
"""
    run = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert run.stdout == "True\n"
