#!/usr/bin/env bash
# shapely 2.2.0 (GEOS 3.14.1): of a mixed collection all overlays are answered, but with an empty polygon two are not.
#
# make_valid of an outline with a hair (a superellipse leaf with a thin tip) gives a collection of a polygon and a
# line, which is valid. Against a square all four overlays take it, the line left out where areas are asked for.
# Against an empty polygon union and symmetric difference take it, too, and so does collection minus nothing; but
# nothing minus the collection, and the intersection in either order, raise "Should never reach here".
#
# So a script that lays shapes over one another, cutting each out of what is there, fails at its very first shape,
# when nothing is there yet, and works from the second on: keep the polygons of what make_valid gives.
#
# Seen with shapely 2.2.0, NumPy 2.3.5, Python 3.11.7 on Linux (x86-64):
#     square: union 4, intersection 0.5, difference 3.5, symmetric_difference 3.5; nothing: union 0.5, intersection raised, difference raised, symmetric_difference 0.5; from it nothing: difference 0.5, intersection raised
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/python" -m pip install --quiet --disable-pip-version-check shapely==2.2.0 numpy==2.3.5

found=$("$folder/venv/bin/python" - <<'PY'
import shapely

# A triangle that runs out into a hair: there and back along one line.
leaf = shapely.make_valid(shapely.Polygon([(0, 0), (1, 0), (1, 1), (2, 2), (1, 1)]))
assert leaf.geom_type == "GeometryCollection", leaf
assert leaf.is_valid
square, nothing = shapely.box(0, 0, 2, 2), shapely.Polygon()


def told(name, one, other):
    try:
        return f"{name} {getattr(shapely, name)(one, other).area:g}"
    except shapely.GEOSException as error:
        assert "Should never reach here" in str(error)
        return f"{name} raised"


names = ("union", "intersection", "difference", "symmetric_difference")
lines = [f"{word}: " + ", ".join(told(name, one, leaf) for name in names)
         for word, one in (("square", square), ("nothing", nothing))]
lines.append("from it nothing: " + ", ".join(told(name, leaf, nothing) for name in ("difference", "intersection")))
print("; ".join(lines))
PY
)
echo "$found"
expected="square: union 4, intersection 0.5, difference 3.5, symmetric_difference 3.5; nothing: union 0.5, intersection raised, difference raised, symmetric_difference 0.5; from it nothing: difference 0.5, intersection raised"
[ "$found" = "$expected" ] || { echo "changed; was: $expected" >&2; exit 1; }
