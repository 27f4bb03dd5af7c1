#!/usr/bin/env bash
# hp2xx 3.4.4: HP-GL that goes through it comes out in pieces of eight or nine moves, the pen lifted between.
#
# `hp2xx -t -m hpgl` reads a circle of 100 sides, one PU and then PD all round, and writes the same places to the
# unit. But after each eight or nine moves it writes PA;PU to the place where the pen stands already: one stroke is
# twelve. And the drawing's lower left corner goes to (0, 0), though -t asks for the true size and no place is told: a
# circle from 500 to 3500 units comes back from 0 to 3000.
#
# So who cleans or converts a plot with it gets a pen that taps on the paper eleven times on its way round, and
# drawings for several pens or passes that were plotted alone no longer register.
#
# Needs apt of Debian 12 and the libraries that hp2xx asks for there (libtiff6, libpng16-16, libx11-6).
#
# Seen with hp2xx 3.4.4-12+b1 of Debian 12 (amd64):
#     in: 1 stroke, 100 moves, from 500 500; out: 12 strokes, 100 moves, from 0 0
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
(cd "$folder" && chmod 755 . && apt-get download -qq hp2xx=3.4.4-12+b1 2>/dev/null && dpkg -x hp2xx_*.deb hp2xx)

python3 - "$folder/circle.hpgl" <<'PY'
import math
import sys

turns = [2 * math.pi * k / 100 for k in range(101)]
places = [(round(2000 + 1500 * math.cos(t)), round(2000 + 1500 * math.sin(t))) for t in turns]
first, *rest = (f"{x},{y}" for x, y in places)
with open(sys.argv[1], "w") as file:
    file.write(f"IN;SP1;PU{first};PD{','.join(rest)};PU;SP0;")
PY
"$folder/hp2xx/usr/bin/hp2xx" -q -t -m hpgl -f "$folder/out.hpgl" "$folder/circle.hpgl"

found=$(python3 - "$folder" <<'PY'
import re
import sys


def told(name: str) -> str:
    text = open(f"{sys.argv[1]}/{name}.hpgl").read()
    places, strokes, moves, at, down = [], 0, 0, None, False
    for word, numbers in re.findall(r"(PU|PD)([^;]*)", text):
        pairs = re.findall(r"([\d.]+),([\d.]+)", numbers)
        for x, y in pairs:
            here = float(x), float(y)
            if word == "PD":
                strokes += not down
                moves += 1
            places.append(here)
            at, down = here, word == "PD"
        if not pairs and word == "PU":
            down = False
    low = [round(min(side)) for side in zip(*places)]
    return f"{strokes} stroke{'s' if strokes > 1 else ''}, {moves} moves, from {low[0]} {low[1]}"


print(f"in: {told('circle')}; out: {told('out')}")
PY
)
echo "$found"
expected="in: 1 stroke, 100 moves, from 500 500; out: 12 strokes, 100 moves, from 0 0"
[ "$found" = "$expected" ] || { echo "changed; was: $expected" >&2; exit 1; }
