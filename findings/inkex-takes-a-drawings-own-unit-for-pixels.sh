#!/usr/bin/env bash
# inkex 1.4.1: unittouu turns millimetres into pixels in a drawing whose unit has no name.
#
# An SVG's unit is what its width and viewBox make of it: a page of 100 mm with a viewBox of 200 has units of half a
# millimetre, and 10 mm are 20 of them. inkex looks for a unit with a name that is about as large, such as mm, in or
# pt, and takes px where none is, so svg.unittouu("10mm") says 37.8 there: what an extension then draws is 1.9 times
# too large, and with a viewBox of 1000 it is 2.6 times too small. svg.scale beside it is right in all of them.
#
# So an extension that is to draw in true size asks for svg.scale (CSS pixels to a unit), and not for unittouu.
#
# Seen with inkex 1.4.1, lxml 5.3.0, NumPy 2.3.5, Python 3.11.7 on Linux (x86-64); true, by unittouu, by scale:
#     100: 10.0 10.0 10.0; 200: 20.0 37.8 20.0; 1000: 100.0 37.8 100.0; 123: 12.3 37.8 12.3
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
# Without what its windows need.
"$folder/venv/bin/python" -m pip install --quiet --disable-pip-version-check --no-deps \
    inkex==1.4.1 lxml==5.3.0 numpy==2.3.5 cssselect==1.2.0 tinycss2==1.4.0 webencodings==0.5.1

found=$("$folder/venv/bin/python" - <<'PY'
from inkex import load_svg

told = []
for side in (100, 200, 1000, 123):
    page = f'<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 {side} {side}"/>'
    svg = load_svg(page).getroot()
    told.append(f"{side}: {side / 10:.1f} {svg.unittouu('10mm'):.1f} {10 * 96 / 25.4 / svg.scale:.1f}")
print("; ".join(told))
PY
)
echo "$found"
expected="100: 10.0 10.0 10.0; 200: 20.0 37.8 20.0; 1000: 100.0 37.8 100.0; 123: 12.3 37.8 12.3"
[ "$found" = "$expected" ] || {
    echo "it is otherwise now: expected $expected" >&2
    exit 1
}
