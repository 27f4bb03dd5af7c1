"""Prints the sha256 of what every sample compiles to: ``<sha256>  four-square.svg``, one line each.

SVG and DXF are the same wherever the package is the same. PDFs are packed by zlib, whose version is named
with them: ``four-square.pdf (zlib 1.3.1)``. ``--against FILE`` prints nothing but what differs from an
earlier list, and fails where anything does.
"""

from __future__ import annotations

import argparse
import hashlib
import subprocess
import sys
import tempfile
import zlib
from collections.abc import Iterator
from pathlib import Path

SAMPLES = Path(__file__).resolve().parent.parent / "samples"


def digests() -> Iterator[tuple[str, str]]:
    """Yield the name and the sha256 of each file."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "batik_vector", "compile", *sorted(map(str, SAMPLES.glob("*.toml")))]
        done = subprocess.run([*command, "-f", "svg,dxf,pdf", "-o", folder], capture_output=True, text=True)
        if done.returncode:
            sys.exit(done.stderr[-2000:])
        for path in sorted(Path(folder).iterdir()):
            packed = f" (zlib {zlib.ZLIB_RUNTIME_VERSION})" if path.suffix == ".pdf" else ""
            yield path.name + packed, hashlib.sha256(path.read_bytes()).hexdigest()


def main() -> int:
    """Print the list, or what differs."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--against", type=Path, metavar="FILE")
    against = parser.parse_args().against
    if against is None:
        for name, digest in digests():
            print(f"{digest}  {name}")
        return 0
    lines = against.read_text(encoding="utf-8").splitlines()
    known = {name: digest for digest, _, name in (line.partition("  ") for line in lines)}
    ours = dict(digests())
    both = known.keys() & ours.keys()
    differ = sorted(name for name in both if known[name] != ours[name])
    for name in differ:
        print(f"{name}: other bytes than in {against.name}")
    print(f"{len(both) - len(differ)} files of the same bytes, {len(differ)} of others", file=sys.stderr)
    return 1 if differ or not both else 0


if __name__ == "__main__":
    sys.exit(main())
