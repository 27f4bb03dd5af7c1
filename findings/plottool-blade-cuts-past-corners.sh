#!/usr/bin/env bash
# plottool 0.1.0: a drag knife led by HPGL.bladeOffset strays by nearly its whole offset at the corners of a square.
#
# bladeOffset lengthens each side past its corner by the offset and then goes straight on to a place four offsets
# along the next side; the corner in which a ring begins and ends is left as it is, and so is one before a side
# shorter than that. A trailing tip (a tractrix: it moves only towards the holder) then cuts beside the square: by
# 0.23 mm for a blade that trails by 0.25 mm, and by 0.11 mm after optimizeCut, which starts in a side and cuts on
# past the start. Led on an arc about each corner the same tip stays within 0.001 mm.
#
# So what is cut for a corner that has to fit is rounded or hooked there.
#
# Seen with plottool 0.1.0, NumPy 2.4.6, Python 3.11.7 on Linux:
#     bladeOffset: 0.230 mm; optimizeCut and bladeOffset: 0.108 mm
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
# What it asks for besides are windows and serial ports, which its module hpgl does without.
"$folder/venv/bin/python" -m pip install --quiet --disable-pip-version-check numpy==2.4.6
"$folder/venv/bin/python" -m pip install --quiet --disable-pip-version-check --no-deps plottool==0.1.0

found=$("$folder/venv/bin/python" - <<'PY'
import cmath
import math
from itertools import pairwise

import hpgl

OFFSET, UNITS, SIDE = 0.25, 40, 20.0


def tip(way: list[complex]) -> list[complex]:
    """Where the tip goes: pulled straight on, tan(angle / 2) falls as exp(-way / offset)."""
    pointing = (way[1] - way[0]) / abs(way[1] - way[0])
    places = []
    for begin, end in pairwise(way):
        length = abs(end - begin)
        ahead = (end - begin) / length
        angle = cmath.phase(pointing / ahead)
        parts = max(1, math.ceil(length / 0.02))
        for part in range(1, parts + 1):
            gone = length * part / parts
            left = 2 * math.atan(math.tan(angle / 2) * math.exp(-gone / OFFSET))
            pointing = ahead * cmath.rect(1, left)
            places.append(begin + ahead * gone - OFFSET * pointing)
    return places


def off(place: complex) -> float:
    """How far a place is from the square's outline."""
    x, y = abs(place.real), abs(place.imag)
    half = SIDE / 2
    if max(x, y) <= half:
        return half - max(x, y)
    return math.hypot(max(x - half, 0), max(y - half, 0))


def strays(first: bool) -> float:
    half = round(SIDE / 2 * UNITS)
    corners = [(-half, -half), (half, -half), (half, half), (-half, half), (-half, -half)]
    drawing = hpgl.HPGL(None)
    drawing.parse("IN;PU%d,%d;" % corners[0] + "".join("PD%d,%d;" % each for each in corners[1:]) + "PU;")
    if first:
        drawing.optimizeCut(OFFSET)
    drawing.bladeOffset(OFFSET)
    (way,) = drawing.getPaths()
    # The first offset of the way is the blade's, set down behind where it begins.
    return max(map(off, tip([complex(*each) / UNITS for each in way])))


print(f"bladeOffset: {strays(False):.3f} mm; optimizeCut and bladeOffset: {strays(True):.3f} mm")
PY
)
echo "$found"
expected="bladeOffset: 0.230 mm; optimizeCut and bladeOffset: 0.108 mm"
[ "$found" = "$expected" ] || { echo "changed; was: $expected" >&2; exit 1; }
