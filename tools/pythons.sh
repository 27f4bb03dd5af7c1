#!/usr/bin/env bash
# Runs make's targets on every Python from 3.11 on that this machine has: on the path, from pyenv, from uv.
#
#   tools/pythons.sh lint test
#
# Each version has an environment of its own; PYTHON's own is .venv. One failure does not keep the others from
# being tried, and the last lines tell how each went.
set -uo pipefail
cd "$(dirname "$0")/.."

ask='
import sys
if sys.version_info >= (3, 11) and sys.version_info.releaselevel == "final" and sys.prefix == sys.base_prefix:
    print(sys.version.split()[0], sys.executable)
'

found() {
    {
        command -v "${PYTHON:-python3}"
        type -ap python3 python3.{11..19}
        printf '%s\n' ~/.pyenv/versions/*/bin/python3 ~/.local/share/uv/python/*/bin/python3
    } 2>/dev/null | while read -r each; do
        if [ -x "$each" ]; then "$each" -c "$ask" 2>/dev/null; fi
    done
}

# The first of each minor version: the one that PYTHON names comes before all others. Of these that one and the
# newest, between which the others lie; with ALL=1 all of them.
mapfile -t pythons < <(found | awk '{ split($1, part, "."); if (!seen[part[1] "." part[2]]++) print }')
if [ -z "${ALL:-}" ] && [ ${#pythons[@]} -gt 2 ]; then
    newest=$(printf '%s\n' "${pythons[@]:1}" | sort -V | tail -n 1)
    pythons=("${pythons[0]}" "$newest")
fi
if [ ${#pythons[@]} -eq 0 ]; then
    echo "pythons: none from 3.11 on was found" >&2
    exit 1
fi

failed=0
told=()
for line in "${pythons[@]}"; do
    version=${line%% *} python=${line#* }
    venv=.venv
    [ "$line" = "${pythons[0]}" ] || venv=.venv-$version
    began=$SECONDS
    echo "pythons: $version ($python)" >&2
    if make --no-print-directory PYTHON="$python" VENV="$venv" "$@"; then verdict=passed; else verdict=FAILED failed=1; fi
    told+=("$(printf 'pythons: %-8s %s, %d s' "$version" "$verdict" $((SECONDS - began)))")
done
printf '%s\n' "${told[@]}" >&2
exit $failed
