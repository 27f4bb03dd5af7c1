#!/usr/bin/env bash
# shapely 2.1.2 (GEOS 3.13.1): a shape drawn in by far more than half its breadth comes back as small areas.
#
# A negative buffer of a shape that no circle of that radius fits into is empty, as it is for a distance just
# past half the breadth. For much larger distances some of it returns: the star of five leaves below has no point
# farther than 5.7 from its border and is gone at 1.2 and at 2 times as much, and at 3 times there are areas
# again, where nothing can be. The coarser the arcs (quad_segs), the larger they are; with 16 there are none here.
#
# So "what is left after drawing in by w/2" is no measure of what is broader than w: a script that looks for
# thin parts by opening (in and out again) lets pass a shape that is thin all over. Ask the distance of what is
# left to the border.
#
# Seen with shapely 2.1.2, NumPy 2.3.5, Python 3.11.7 on Linux (x86-64):
#     largest circle inside 5.7; 2: 0.00, 0.00, 2.54; 4: 0.00, 0.00, 0.04; 16: 0.00, 0.00, 0.00
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/python" -m pip install --quiet --disable-pip-version-check shapely==2.1.2 numpy==2.3.5

found=$("$folder/venv/bin/python" - <<'PY'
import numpy as np
import shapely

t = np.linspace(0, 2 * np.pi, 90, endpoint=False)
x = 10 * np.sign(np.cos(t)) * np.abs(np.cos(t)) ** 1.1
y = 4.5 * np.sign(np.sin(t)) * np.abs(np.sin(t)) ** 1.5
leaf = shapely.Polygon(np.column_stack([x + 10, y]))
leaves = [shapely.affinity.rotate(leaf, 72 * number + 45, origin=(0, 0)) for number in range(5)]
star = shapely.union_all([*leaves, shapely.Point(0, 0).buffer(4)])
inner = shapely.maximum_inscribed_circle(star).length
told = [f"largest circle inside {inner:.1f}"]
for quad_segs in (2, 4, 16):
    left = [float(star.buffer(-share * inner, quad_segs=quad_segs).area) for share in (1.2, 2, 3)]
    told.append(f"{quad_segs}: " + ", ".join(f"{area:.2f}" for area in left))
print("; ".join(told))
PY
)
echo "$found"
expected="largest circle inside 5.7; 2: 0.00, 0.00, 2.54; 4: 0.00, 0.00, 0.04; 16: 0.00, 0.00, 0.00"
[ "$found" = "$expected" ] || { echo "changed; was: $expected" >&2; exit 1; }
