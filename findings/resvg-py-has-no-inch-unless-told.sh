#!/usr/bin/env bash
# resvg_py 0.5.0: an inch has no pixels unless dpi is given, so a page in mm, cm, in or pt has "an invalid size".
#
# svg_to_bytes draws a page of 60 or of 60px as it stands. The same call with width="60mm" raises
#     ValueError: SVG has an invalid size
# as if the file were broken: the dpi that the binding hands on is 0 where none is given, and a page that is
# told in true lengths comes to nothing. resvg's own command counts 96 to the inch, as CSS does. With dpi=96 the
# page is 227 pixels wide. With a width of its own (width=600) it is refused all the same.
#
# So a script that draws previews works for all drawings in pixels, and calls every one in millimetres faulty.
#
# Seen with resvg_py 0.5.0, Pillow 12.0.0, Python 3.11.7 on Linux:
#     60px: 60; 60mm: SVG has an invalid size; 60mm at width=600: SVG has an invalid size; 60mm at dpi=96: 227
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/python" -m pip install --quiet --disable-pip-version-check resvg_py==0.5.0 pillow==12.0.0

found=$("$folder/venv/bin/python" - <<'PY'
import io

from PIL import Image
from resvg_py import svg_to_bytes


def breadth(size: str, **options: int) -> str:
    page = f'<svg xmlns="http://www.w3.org/2000/svg" width="{size}" height="{size}"><rect width="9" height="9"/></svg>'
    try:
        return str(Image.open(io.BytesIO(bytes(svg_to_bytes(svg_string=page, **options)))).width)
    except ValueError as error:
        return str(error)


print(
    f"60px: {breadth('60px')}; 60mm: {breadth('60mm')}; 60mm at width=600: {breadth('60mm', width=600)}; "
    f"60mm at dpi=96: {breadth('60mm', dpi=96)}"
)
PY
)
echo "$found"
invalid="SVG has an invalid size"
expected="60px: 60; 60mm: $invalid; 60mm at width=600: $invalid; 60mm at dpi=96: 227"
[ "$found" = "$expected" ] || { echo "changed; was: $expected" >&2; exit 1; }
