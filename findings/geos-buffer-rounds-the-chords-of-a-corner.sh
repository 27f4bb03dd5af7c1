#!/usr/bin/env bash
# shapely 2.1.2 (GEOS 3.13.1): a buffer's corner of 45° with quad_segs=3 gets one chord or two by how it lies.
#
# quad_segs is told to be the number of chords in a quarter circle. A corner of another angle gets its share,
# rounded to the nearest whole number: of one and a half chords there is one, so that it is off the true arc by
# up to 2.25 times what a quarter circle is (the square of 1.5). And where the share lies half way, the last bit
# of the angle decides: the same wedge, turned in steps of half a degree, is rounded by two chords at some places
# and by one at others. Even values, of which 45° has a whole number, do not waver.
#
# So a tolerance that is kept at square corners is missed at others, and a drawing with a rotation of its own
# loses it when all its marks are grown alike: ask for one and a half times as many chords.
#
# Seen with shapely 2.1.2, NumPy 2.3.5, Python 3.11.7 on Linux (x86-64):
#     GEOS 3.13.1; 2: {1: 720}; 3: {1: 203, 2: 517}; 4: {2: 720}; 5: {2: 225, 3: 495}
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/python" -m pip install --quiet --disable-pip-version-check shapely==2.1.2 numpy==2.3.5

found=$("$folder/venv/bin/python" - <<'PY'
from collections import Counter

import numpy as np
import shapely


def chords(turn: float, quad_segs: int) -> int:
    """Return how many chords the corner of 45° (of the outline) has when the wedge lies turned by so much."""
    legs = np.radians([turn, turn + 135])
    wedge = shapely.Polygon([(0, 0), *(100 * np.column_stack([np.cos(legs), np.sin(legs)]))])
    ring = shapely.get_coordinates(wedge.buffer(10, quad_segs=quad_segs))[:-1]
    return int((np.abs(np.hypot(*ring.T) - 10) < 1e-6).sum()) - 1


told = [f"GEOS {shapely.geos_version_string}"]
for quad_segs in (2, 3, 4, 5):
    counted = Counter(chords(turn / 2, quad_segs) for turn in range(720))
    told.append(f"{quad_segs}: {dict(sorted(counted.items()))}")
print("; ".join(told))
PY
)
echo "$found"
expected="GEOS 3.13.1; 2: {1: 720}; 3: {1: 203, 2: 517}; 4: {2: 720}; 5: {2: 225, 3: 495}"
[ "$found" = "$expected" ] || { echo "changed; was: $expected" >&2; exit 1; }
