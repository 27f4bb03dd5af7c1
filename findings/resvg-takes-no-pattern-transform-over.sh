#!/usr/bin/env bash
# resvg 0.5.0 (resvg_py): a <pattern> takes all over from the one that its href names but its patternTransform.
#
# SVG 2, 14.3: what a pattern does not give itself is the referenced pattern's, patternTransform too.
# A cell of 8 by 8 with a square of 4 by 4, moved 3 down, shows 4 by 1 of a square of 4 by 4 at the page's corner.
# Named directly it does. Through a second pattern that is nothing but an href, width, height and contents come
# over, and the move does not: the whole square shows, 16 instead of 4. Chromium 156 paints 4 both ways.
#
# So a swatch that is put together from a base pattern and a variant shows its marks in other places in resvg than
# in a browser, without a word. Who writes patterns repeats the transform on each; who reads them must not take
# resvg's picture as the measure there.
#
# Seen with resvg_py 0.5.0, Pillow 12.0.0, Python 3.11.7 on Linux:
#     named directly: 4 pixels from row 3; by href: 16 pixels from row 0
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/python" -m pip install --quiet --disable-pip-version-check resvg_py==0.5.0 pillow==12.0.0

found=$("$folder/venv/bin/python" - <<'PY'
import io

from PIL import Image
from resvg_py import svg_to_bytes

PAGE = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100" viewBox="0 0 100 100"><defs>'
    '<pattern id="base" patternUnits="userSpaceOnUse" width="8" height="8" patternTransform="translate(0 3)">'
    '<rect width="4" height="4" fill="#c00000"/></pattern><pattern id="variant" href="#base"/></defs>'
    '<rect width="4" height="4" fill="url(#{})"/></svg>'
)


def painted(name: str) -> str:
    png = bytes(svg_to_bytes(svg_string=PAGE.format(name)))
    alpha = Image.open(io.BytesIO(png)).convert("RGBA").getchannel("A").point(lambda level: 255 * (level > 127))
    return f"{alpha.histogram()[255]} pixels from row {alpha.getbbox()[1]}"


print(f"named directly: {painted('base')}; by href: {painted('variant')}")
PY
)
echo "$found"
expected="named directly: 4 pixels from row 3; by href: 16 pixels from row 0"
[ "$found" = "$expected" ] || { echo "changed; was: $expected" >&2; exit 1; }
