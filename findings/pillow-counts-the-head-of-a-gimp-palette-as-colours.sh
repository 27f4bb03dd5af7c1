#!/usr/bin/env bash
# Pillow 11.1.0: the colours of a GIMP palette stand as many places too late as its head has lines after the first.
#
# A GPL file has a line "GIMP Palette", a few lines such as "Name:" and "Columns:", remarks, and then a colour on each
# line. The first of them is colour 0. GimpPaletteFile counted names and remarks along, and filled their places, and
# those behind the last up to 256, with greys of its own (0 0 0, 1 1 1, 3 3 3). Whoever took the first entries for the
# inks of a recipe got blacks, from a file without a fault; another remark in the file shifted them all again.
# Pillow 11.2.1 returns the colours that are there and no others.
#
# Seen with Pillow 11.1.0 and 11.2.1, Python 3.11.7 on Linux, a palette of one colour (21 26 46) below a name and a remark:
#     11.1.0: 768 bytes, begins 0 0 0 1 1 1 21 26 46 3 3 3; with a remark more the colour is number 3
#     11.2.1: 3 bytes, begins 21 26 46; with a remark more the colour is number 0
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"

found=
for version in 11.1.0 11.2.1; do
    "$folder/venv/bin/python" -m pip install --quiet --disable-pip-version-check "pillow==$version"
    found+=$("$folder/venv/bin/python" - <<'PY'
import io

import PIL
from PIL.GimpPaletteFile import GimpPaletteFile

COLOUR = bytes((21, 26, 46))


def read(head):
    return GimpPaletteFile(io.BytesIO(b"GIMP Palette\nName: inks\n" + head + b" 21  26  46\tground\n")).getpalette()[0]


once, twice = read(b"#\n"), read(b"#\n# from the dye house\n")
begins = " ".join(map(str, once[:12]))
print(
    f"{PIL.__version__}: {len(once)} bytes, begins {begins}; "
    f"with a remark more the colour is number {twice.find(COLOUR) // 3}"
)
PY
)$'\n'
done
printf '%s' "$found"
expected='11.1.0: 768 bytes, begins 0 0 0 1 1 1 21 26 46 3 3 3; with a remark more the colour is number 3
11.2.1: 3 bytes, begins 21 26 46; with a remark more the colour is number 0
'
[ "$found" = "$expected" ] || { echo "changed; was: $expected" >&2; exit 1; }
