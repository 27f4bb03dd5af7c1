#!/usr/bin/env bash
# Makes the machine ready, step by step, doing only what is not yet done.
#
#   tools/setup.sh python     .venv with this package and its development tools, and cairo
#   tools/setup.sh peers      .venv-bench with what the benchmarks measure us against
#   tools/setup.sh clients    the real programs that tests/clients opens files in
#
# What the system lacks is installed by apt where we are root or sudo asks no password; elsewhere the one
# command that does it is printed.
set -euo pipefail
cd "$(dirname "$0")/.."

python=${PYTHON:-python3}
venv=.venv
peers=.venv-bench

say() { printf '%s\n' "setup: $*" >&2; }

fail() {
    say "$@"
    exit 1
}

as_root=()
may_install() {
    command -v apt-get >/dev/null || return 1
    [ "$(id -u)" -eq 0 ] && return 0
    as_root=(sudo -n)
    command -v sudo >/dev/null && sudo -n true 2>/dev/null
}

apt() {
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Dpkg::Use-Pty=0 "$@" </dev/null >"$log" 2>&1
}

system_needs() { # packages…
    may_install || fail "please run: sudo apt-get install -y --no-install-recommends $*"
    say "installing $* (apt)"
    log=$(mktemp)
    # A machine just made has no package lists, and an old one has stale ones.
    if ! apt install -y --no-install-recommends "$@"; then
        { apt update && apt install -y --no-install-recommends "$@"; } || {
            cat "$log" >&2
            rm -f "$log"
            fail "apt could not install $*"
        }
    fi
    rm -f "$log"
}

environment() { # folder
    if ! "$1/bin/python" -m pip --version >/dev/null 2>&1; then
        # Debian keeps ensurepip, without which a venv has no pip, in a package of its own.
        "$python" -c 'import ensurepip, venv' 2>/dev/null ||
            system_needs "$("$python" -c 'import sys; print("python{}.{}-venv".format(*sys.version_info))')"
        say "making $1"
        "$python" -m venv --clear "$1"
    fi
}

python_ready() {
    command -v "$python" >/dev/null || fail "$python is missing; please run: sudo apt-get install -y python3"
    "$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))' ||
        fail "$("$python" --version) is too old: 3.11 or later is needed (make PYTHON=python3.12 …)"
    environment "$venv"
    say "installing the package and its tools into $venv (pip)"
    "$venv/bin/python" -m pip install --quiet --disable-pip-version-check --no-input --editable '.[dev]'
    # Cairo is the one library that no wheel brings along.
    "$venv/bin/python" -c 'import cairosvg' 2>/dev/null || system_needs libcairo2
    "$venv/bin/python" -c 'import cairosvg'
}

peer() { # where to, requirement: install it without what else it asks for, or note why not
    local log missing=$peers/missing/${2%%==*}
    log=$(mktemp)
    if ! "$peers/bin/python" -m pip install --quiet --disable-pip-version-check --no-input --no-deps \
        ${1:+--target "$1"} "$2" >"$log" 2>&1; then
        say "$2 cannot be installed: the benchmarks leave it out"
        grep -iE 'error' "$log" | tail -n 1 >"$missing" || echo "pip failed" >"$missing"
    fi
    rm -f "$log"
}

peers_ready() {
    environment "$peers"
    rm -rf "$peers/missing" "$peers/plug-ins"
    mkdir -p "$peers/missing"
    # pycairo has no wheels and is built; without it, its rows are left out.
    if ! pkg-config --exists cairo 2>/dev/null; then
        (system_needs gcc pkg-config libcairo2-dev python3-dev) || say "pycairo may not build"
    fi
    say "installing what the benchmarks are measured against into $peers (pip)"
    local line folder=
    while read -r line; do
        case $line in
        '# plug-ins'*) folder=$peers/plug-ins ;;
        '' | '#'*) ;;
        *) peer "$folder" "$line" ;;
        esac
    done <benchmarks/requirements.txt
    "$peers/bin/python" -c 'import cairocffi' 2>/dev/null || (system_needs libcairo2) || say "cairosvg lacks cairo"
}

clients_ready() {
    local missing=() row
    for row in inkscape:inkscape librecad:librecad qpdf:qpdf pdftocairo:poppler-utils mutool:mupdf-tools; do
        command -v "${row%%:*}" >/dev/null || missing+=("${row#*:}")
    done
    command -v chromium >/dev/null || command -v chromium-browser >/dev/null ||
        command -v google-chrome >/dev/null || missing+=(chromium)
    [ ${#missing[@]} -eq 0 ] || system_needs "${missing[@]}"
}

case ${1:-} in
python) python_ready ;;
peers) peers_ready ;;
clients) clients_ready ;;
*) fail "usage: tools/setup.sh python|peers|clients" ;;
esac
