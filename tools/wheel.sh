#!/usr/bin/env bash
# Builds wheel and sdist, installs them into empty environments, and works with them outside the repository.
#
#   tools/wheel.sh              with the newest versions of what is needed, then with the oldest
#   tools/wheel.sh newest       with the newest alone
#
# PYTHON is the interpreter. All is made in a temporary folder, which goes again.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
python=${PYTHON:-python3}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

say() { printf '%s\n' "wheel: $*" >&2; }

fail() {
    say "$@"
    exit 1
}

pip() { # environment, arguments…
    "$1/bin/python" -m pip --quiet --disable-pip-version-check --no-input "${@:2}" || fail "pip ${*:2} failed"
}

"$python" -m venv "$folder/build"
pip "$folder/build" install 'hatchling>=1.24'
"$folder/build/bin/python" -m hatchling build -d "$folder/dist" >"$folder/log" 2>&1 || fail "$(tail -n 1 "$folder/log")"
wheel=$(echo "$folder"/dist/*.whl)
# What the sdist builds is what the repository builds.
pip "$folder/build" wheel --no-deps --no-build-isolation -w "$folder/again" "$folder"/dist/*.tar.gz
cmp "$wheel" "$folder"/again/*.whl || fail "the sdist builds another wheel"
say "$(basename "$wheel"), $(du -k "$wheel" | cut -f1) kB; sdist $(du -k "$folder"/dist/*.tar.gz | cut -f1) kB"

# From an empty folder, with nothing of the repository to be seen.
work() { # environment
    local at="$folder/work-$(basename "$1")"
    mkdir "$at" && cd "$at"
    unset PYTHONPATH
    batik() { "$1/bin/batik-vector" "${@:2}" >"$folder/log" 2>&1 || fail "batik-vector ${*:2}: $(tail -n 3 "$folder/log")"; }
    batik "$1" new mine --kind four-square
    batik "$1" compile mine.toml -f svg,pdf,dxf,png -o made
    batik "$1" check mine.toml
    batik "$1" check made/mine.svg
    batik "$1" compile made/mine.pdf -f hpgl --machine vinyl-cutter --process cut --margin 10mm -o made
    batik "$1" compile library:sample/kawung -o made
    batik "$1" schema
    "$1/bin/python" -c 'import json, sys; assert json.load(sys.stdin)["$defs"]["motif.flower"]' <"$folder/log"
    for name in mine.svg mine.pdf mine.dxf mine.png mine.hpgl kawung.svg; do
        [ -s "made/$name" ] || fail "no $name was made"
    done
    "$1/bin/python" -c 'import batik_vector, sys; sys.exit(not batik_vector.__file__.startswith(sys.prefix))' ||
        fail "what ran was not what was installed"
    cd "$root"
}

for versions in newest ${1:-oldest}; do
    [ -d "$folder/$versions" ] && continue
    "$python" -m venv "$folder/$versions"
    oldest=()
    if [ "$versions" = oldest ]; then
        "$python" tools/lowest.py >"$folder/oldest.txt"
        oldest=(--constraint "$folder/oldest.txt")
    fi
    pip "$folder/$versions" install "${oldest[@]}" "$wheel"
    work "$folder/$versions"
    say "$versions: new, compile, check and schema work ($("$folder/$versions/bin/python" -m pip list 2>/dev/null |
        awk '$1 == "numpy" || $1 == "shapely" { printf "%s%s %s", sep, $1, $2; sep = ", " }'))"
done
