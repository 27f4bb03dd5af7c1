#!/usr/bin/env bash
# shapely 2.1.2: relate_pattern with one fixed pattern refuses arrays that broadcast to a table.
#
# Every predicate of shapely takes (n, 1) against (m,) and gives an (n, m) table; so does relate_pattern for small
# tables and for any where one side is a scalar. Where NumPy has to go through the table in more than one inner
# loop, it says of the one plain string that it was given
#     ValueError: pattern keyword only supports scalar argument
# Asked in pairs (one row, both sides as long) the same question is answered. In shapely 2.2.0 the table works.
#
# Seen with shapely 2.1.2 and 2.2.0, NumPy 2.3.5, Python 3.11.7 on Linux:
#     2.1.2: intersects (3, 2), relate (3, 2), relate_pattern refuses, in pairs (6,)
#     2.2.0: intersects (3, 2), relate (3, 2), relate_pattern (3, 2), in pairs (6,)
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"

seen() { # version
    "$folder/venv/bin/python" -m pip install --quiet --disable-pip-version-check "shapely==$1" numpy==2.3.5
    "$folder/venv/bin/python" - <<'PY'
import numpy as np
import shapely

here = np.array([shapely.box(n, 0, n + 2, 1) for n in range(3)], dtype=object)
there = here[:2]
told = [
    f"intersects {shapely.intersects(here[:, None], there).shape}",
    f"relate {shapely.relate(here[:, None], there).shape}",
]
try:
    told.append(f"relate_pattern {shapely.relate_pattern(here[:, None], there, 'T********').shape}")
except ValueError as error:
    assert str(error) == "pattern keyword only supports scalar argument", error
    told.append("relate_pattern refuses")
a, b = (each.ravel() for each in np.broadcast_arrays(here[:, None], there))
told.append(f"in pairs {shapely.relate_pattern(a, b, 'T********').shape}")
print(f"{shapely.__version__}: {', '.join(told)}")
PY
}

expect() {
    found=$(seen "$1")
    echo "$found"
    [ "$found" = "$2" ] || { echo "changed; was: $2" >&2; exit 1; }
}

expect 2.1.2 "2.1.2: intersects (3, 2), relate (3, 2), relate_pattern refuses, in pairs (6,)"
expect 2.2.0 "2.2.0: intersects (3, 2), relate (3, 2), relate_pattern (3, 2), in pairs (6,)"
