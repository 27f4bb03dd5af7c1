#!/usr/bin/env bash
# resvg 0.5.0 (resvg_py): a clip that is itself clipped in shares of the box takes the box of the first mark for all.
#
# CSS Masking 1, 3 and 6.1: a clip path given in objectBoundingBox units is measured by the element that is clipped,
# each its own, also where it clips another clip path. Two squares of 20 by 20, each clipped to its own left half
# through an outer clip that is as large as the page, must show 200 pixels each. Alone each does. Drawn together, the
# second one is cut by the half of the first one's box and is gone without a word. Clipped by the inner clip directly,
# both are right. Chromium 156 shows 200 and 200.
#
# So the marks of a drawing that were all clipped alike by a nested clip, as an export of artboards within artboards
# may hold, are missing in resvg's picture: who judges a tile by it sees empty cloth.
#
# Seen with resvg_py 0.5.0, Pillow 12.0.0, Python 3.11.7 on Linux:
#     nested: first alone 200, second alone 200, together 200 and 0; direct: together 200 and 200
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/python" -m pip install --quiet --disable-pip-version-check resvg_py==0.5.0 pillow==12.0.0

found=$("$folder/venv/bin/python" - <<'PY'
import io

from PIL import Image
from resvg_py import svg_to_bytes

HEAD = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100" viewBox="0 0 100 100"><defs>'
    '<clipPath id="outer" clip-path="url(#inner)"><rect width="100" height="100"/></clipPath>'
    '<clipPath id="inner" clipPathUnits="objectBoundingBox"><rect width=".5" height="1"/></clipPath></defs>'
)


def square(place, clip):
    return f'<rect x="{place}" y="{place}" width="20" height="20" clip-path="url(#{clip})"/>'


def shown(*marks):
    """Pixels in the upper and in the lower half of the page."""
    png = bytes(svg_to_bytes(svg_string=HEAD + "".join(marks) + "</svg>"))
    alpha = Image.open(io.BytesIO(png)).convert("RGBA").getchannel("A")
    halves = alpha.crop((0, 0, 100, 50)), alpha.crop((0, 50, 100, 100))
    return [sum(half.histogram()[128:]) for half in halves]


first, second = (square(place, "outer") for place in (10, 60))
direct = (square(place, "inner") for place in (10, 60))
print(
    f"nested: first alone {shown(first)[0]}, second alone {shown(second)[1]}, "
    + "together {} and {}; direct: together {} and {}".format(*shown(first, second), *shown(*direct))
)
PY
)
echo "$found"
expected="nested: first alone 200, second alone 200, together 200 and 0; direct: together 200 and 200"
[ "$found" = "$expected" ] || { echo "changed; was: $expected" >&2; exit 1; }
