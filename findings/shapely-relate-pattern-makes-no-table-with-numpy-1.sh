#!/usr/bin/env bash
# shapely with NumPy 1.26: relate_pattern with one fixed pattern refuses arrays that broadcast to a table.
#
# Every predicate of shapely takes (n, 1) against (m,) and gives an (n, m) table, and with NumPy 2 so does
# relate_pattern. With NumPy 1.26, which the same wheel of shapely allows, the call fails once both n and m are
# more than one, and what it says points at the one plain string that it was given:
#     ValueError: pattern keyword only supports scalar argument
# One row of pairs, both sides as long, is answered by either.
#
# Seen with shapely 2.1.2 and 2.2.0, NumPy 1.26.4 and 2.3.5, Python 3.11.7 on Linux:
#     2.1.2 with 1.26.4: intersects (3, 2), relate (3, 2), relate_pattern refuses, in pairs (6,)
#     2.1.2 with 2.3.5: intersects (3, 2), relate (3, 2), relate_pattern (3, 2), in pairs (6,)
#     2.2.0 with 1.26.4: intersects (3, 2), relate (3, 2), relate_pattern refuses, in pairs (6,)
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"

seen() { # shapely, NumPy
    "$folder/venv/bin/python" -m pip install --quiet --disable-pip-version-check "shapely==$1" "numpy==$2"
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
print(f"{shapely.__version__} with {np.__version__}: {', '.join(told)}")
PY
}

expect() { # shapely, NumPy, what relate_pattern says
    found=$(seen "$1" "$2")
    echo "$found"
    was="$1 with $2: intersects (3, 2), relate (3, 2), relate_pattern $3, in pairs (6,)"
    [ "$found" = "$was" ] || { echo "changed; was: $was" >&2; exit 1; }
}

expect 2.1.2 1.26.4 refuses
expect 2.1.2 2.3.5 "(3, 2)"
expect 2.2.0 1.26.4 refuses
