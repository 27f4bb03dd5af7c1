#!/usr/bin/env bash
# shapely 2.1.2: get_parts and get_rings refuse an array that may not be written, which no other function does.
#
# A cache that hands out its arrays read-only, so that nobody changes them for the next reader, works with area,
# bounds, union_all, get_coordinates and the rest, and fails with
#     ValueError: buffer source array is read-only
# as soon as somebody takes the same polygons apart. Neither function's page says that it asks for a writable
# array, and neither writes. In shapely 2.2.0 both take it.
#
# Seen with shapely 2.1.2 and 2.2.0, NumPy 2.3.5, Python 3.11.7 on Linux:
#     2.1.2: area ok, union_all ok, get_coordinates ok, get_parts refuses, get_rings refuses
#     2.2.0: area ok, union_all ok, get_coordinates ok, get_parts ok, get_rings ok
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"

seen() { # version
    "$folder/venv/bin/python" -m pip install --quiet --disable-pip-version-check "shapely==$1" numpy==2.3.5
    "$folder/venv/bin/python" - <<'PY'
import numpy as np
import shapely

squares = np.array([shapely.box(0, 0, 1, 1), shapely.box(2, 0, 3, 1)], dtype=object)
squares.flags.writeable = False
told = []
for name in ("area", "union_all", "get_coordinates", "get_parts", "get_rings"):
    try:
        getattr(shapely, name)(squares)
        told.append(f"{name} ok")
    except ValueError as error:
        assert str(error) == "buffer source array is read-only", error
        told.append(f"{name} refuses")
print(f"{shapely.__version__}: {', '.join(told)}")
PY
}

expect() {
    found=$(seen "$1")
    echo "$found"
    [ "$found" = "$2" ] || { echo "changed; was: $2" >&2; exit 1; }
}

expect 2.1.2 "2.1.2: area ok, union_all ok, get_coordinates ok, get_parts refuses, get_rings refuses"
expect 2.2.0 "2.2.0: area ok, union_all ok, get_coordinates ok, get_parts ok, get_rings ok"
