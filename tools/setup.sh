#!/usr/bin/env bash
# Makes the machine ready, step by step, doing only what is not yet done.
#
#   tools/setup.sh python     an environment with this package, and cairo
#   tools/setup.sh tools      into the same, what tests and checks it
#   tools/setup.sh studio     into the same, what the studio needs
#   tools/setup.sh site       into the same, what makes the documentation site
#   tools/setup.sh peers      .venv-bench with what the benchmarks measure us against, .venv-bench-pages with pages
#   tools/setup.sh clients    the real programs that tests/clients opens files in; in .venv-vpype vpype with our plug-in, vsketch, readers of HPGL
#   tools/setup.sh bare       what makes a bare system
#
# PYTHON is the interpreter, VENV the folder of the environment; with LOWEST=1 it gets the oldest versions that
# pyproject.toml allows. What the system lacks is installed by apt where
# we are root or sudo asks no password; elsewhere the one command that does it is printed. Whatever stops it, one
# line says what and the next call goes on.
set -euo pipefail
cd "$(dirname "$0")/.."

python=${PYTHON:-python3}
venv=${VENV:-.venv}
peers=.venv-bench
pages=.venv-bench-pages
plotting=.venv-vpype
log=

say() { printf '%s\n' "setup: $*" >&2; }

fail() {
    say "$@"
    exit 1
}

trap 'rm -f "$log"' EXIT
log=$(mktemp 2>/dev/null) || fail "no room for a temporary file in ${TMPDIR:-/tmp}: free some, then run make again"

# What to say of a step that failed, from what it printed.
because() { # what was being done
    if grep -qiE 'no space left on device|disk quota exceeded|not enough free space|write error: no space' "$log"; then
        fail "$1: the disk is full; free some room, then run make again"
    elif grep -qiE 'permission denied|read-only file system' "$log"; then
        local where
        where=$(grep -iE 'permission denied|read-only file system' "$log" | grep -oE "'?/[^':]+'?" | head -n 1) || true
        fail "$1: may not write ${where:-there}; make it yours, then run make again"
    elif grep -qiE 'name resolution|name or service not known|temporary failure resolving|could not resolve|failed to establish|unable to connect|could not connect|network is unreachable|connection (refused|timed out|failed)|max retries exceeded|connectionerror|cannot initiate the connection|connecttimeout' "$log"; then
        fail "$1: no network, or the package index does not answer; run make again when it does"
    fi
    # The last complaint is the one that ended it.
    local words
    words=$(grep -E '^(ERROR|E|error)[: ]' "$log" | tail -n 1) || words=$(tail -n 1 "$log")
    fail "$1 failed: ${words:-for no reason that it told}"
}

step() { # what it does, command…
    local what=$1
    shift
    say "$what"
    "$@" </dev/null >"$log" 2>&1 || because "$what"
}

as_root=()
may_install() {
    command -v apt-get >/dev/null || return 1
    [ "$(id -u)" -eq 0 ] && return 0
    as_root=(sudo -n)
    command -v sudo >/dev/null && sudo -n true 2>/dev/null
}

apt() {
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Dpkg::Use-Pty=0 "$@"
}

apt_install() { # packages…
    apt install -y --no-install-recommends "$@" && return
    # A machine just made has no package lists, and an old one has stale ones.
    apt update && apt install -y --no-install-recommends "$@"
}

system_needs() { # packages…
    may_install || fail "please run: sudo apt-get install -y --no-install-recommends $*"
    step "installing $* (apt)" apt_install "$@"
}

environment() { # folder
    # What was stopped half-way is begun again.
    if [ -e "$1/.unfinished" ] || ! "$1/bin/python" -m pip --version >/dev/null 2>&1; then
        # Debian keeps ensurepip, without which a venv has no pip, in a package of its own.
        "$python" -c 'import ensurepip, venv' 2>/dev/null ||
            system_needs "$("$python" -c 'import sys; print("python{}.{}-venv".format(*sys.version_info))')"
        step "making $1" "$python" -m venv --clear "$1"
    fi
    touch "$1/.unfinished" 2>"$log" || because "beginning in $1"
}

pip_install() { # folder, arguments…
    local folder=$1
    shift
    "$folder/bin/python" -m pip install --quiet --disable-pip-version-check --no-input --retries 2 "$@"
}

python_known() {
    command -v "$python" >/dev/null || fail "$python is missing; please run: sudo apt-get install -y python3"
    "$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))' ||
        fail "$("$python" --version) is too old: 3.11 or later is needed (make PYTHON=python3.12 …)"
}

installed() { # in words, what pip calls it
    local oldest=()
    if [ -n "${LOWEST:-}" ]; then
        "$venv/bin/python" tools/lowest.py >"$venv/lowest.txt"
        oldest=(--constraint "$venv/lowest.txt")
    fi
    step "installing $1 into $venv (pip)" pip_install "$venv" "${oldest[@]}" --editable "$2"
}

python_ready() {
    python_known
    environment "$venv"
    installed "the package" .
    # Cairo is the one library that no wheel brings along.
    "$venv/bin/python" -c 'import cairosvg' 2>/dev/null || system_needs libcairo2
    "$venv/bin/python" -c 'import cairosvg'
    rm -f "$venv/.unfinished"
}

tools_ready() {
    python_known
    environment "$venv"
    # The studio asks for newer versions of what the package can do with older ones of.
    if [ -n "${LOWEST:-}" ]; then
        installed "what tests it" '.[dev]'
    else
        installed "what tests it" '.[dev,studio]'
    fi
    rm -f "$venv/.unfinished"
}

studio_ready() {
    python_known
    environment "$venv"
    installed "the studio" '.[studio]'
    rm -f "$venv/.unfinished"
}

site_ready() {
    python_known
    environment "$venv"
    installed "what makes the site" '.[docs]'
    rm -f "$venv/.unfinished"
}

peer() { # where to, requirement: install it without what else it asks for, or note why not
    local missing=$peers/missing/${2%%==*}
    if ! pip_install "$peers" --no-deps ${1:+--target "$1"} "$2" >"$log" 2>&1; then
        say "$2 cannot be installed: the benchmarks leave it out"
        grep -iE 'error' "$log" | tail -n 1 >"$missing" || echo "pip failed" >"$missing"
    fi
}

peers_ready() {
    python_known
    environment "$peers"
    rm -rf "$peers/missing" "$peers/plug-ins"
    mkdir -p "$peers/missing"
    # pycairo has no wheels and is built; without it, its rows are left out.
    if ! pkg-config --exists cairo 2>/dev/null; then
        (system_needs gcc pkg-config libcairo2-dev python3-dev) || say "pycairo may not build"
    fi
    say "installing what the benchmarks are measured against into $peers (pip)"
    local line folder= asking=()
    while read -r line; do
        case $line in
        '# plug-ins'*) folder=$peers/plug-ins ;;
        '# pages'*) folder=pages ;;
        '' | '#'*) ;;
        *) if [ "$folder" = pages ]; then asking+=("$line"); else peer "$folder" "$line"; fi ;;
        esac
    done <benchmarks/requirements.txt
    environment "$pages"
    pip_install "$pages" "${asking[@]}" >"$log" 2>&1 || say "pages cannot be installed: benchmarks.pages leaves them out"
    rm -f "$pages/.unfinished"
    "$peers/bin/python" -c 'import cairocffi' 2>/dev/null || (system_needs libcairo2) || say "cairosvg lacks cairo"
    rm -f "$peers/.unfinished"
}

programs_ready() { # program:package…
    local missing=() row
    for row in "$@"; do
        command -v "${row%%:*}" >/dev/null || missing+=("${row#*:}")
    done
    [ ${#missing[@]} -eq 0 ] || system_needs "${missing[@]}"
}

clients_ready() {
    local browser=chromium:chromium name
    for name in chromium-browser google-chrome; do
        ! command -v $name >/dev/null || browser=$name:chromium
    done
    programs_ready inkscape:inkscape librecad:librecad qpdf:qpdf pdftocairo:poppler-utils mutool:mupdf-tools \
        gs:ghostscript hp2xx:hp2xx rsvg-convert:librsvg2-bin $browser
    # An interpreter of G-code; not every distribution has it.
    (programs_ready rs274:linuxcnc-uspace) || say "LinuxCNC cannot be installed: its tests will say so"
    (programs_ready firefox-esr:firefox-esr) || say "Firefox cannot be installed: its test will say so"
    (programs_ready openscad:openscad) || say "OpenSCAD cannot be installed: its test will say so"
    # Inkscape's writers of other formats are Python, and take the system's.
    /usr/bin/python3 -c 'import cssselect, lxml, numpy' 2>/dev/null ||
        system_needs python3-cssselect python3-lxml python3-numpy
    # vpype asks for other versions of what we ask for, and gets the ones that the benchmarks pin.
    python_known
    environment "$plotting"
    step "installing vpype into $plotting (pip)" pip_install "$plotting" --constraint benchmarks/requirements.txt \
        vpype matplotlib --editable .
    # Without its viewer, which draws on a screen.
    step "installing vsketch into $plotting (pip)" pip_install "$plotting" --no-deps vsketch==1.2.0
    step "installing readers of HPGL into $plotting (pip)" pip_install "$plotting" ezhpgl==0.1.0a2 hpgl-buddy==1.8.0
    step "installing Jupyter's notebooks into $plotting (pip)" pip_install "$plotting" \
        ipywidgets==8.1.9 nbconvert==7.17.2 ipykernel==7.4.0
    rm -f "$plotting/.unfinished"
    # What drives the browser on the studio's page.
    environment "$venv"
    step "installing drivers of browsers and axe into $venv (pip)" pip_install "$venv" playwright==1.65.2 axe-core-python==0.1.0 \
        marionette-driver==3.7.1
    rm -f "$venv/.unfinished"
}

case ${1:-} in
python) python_ready ;;
tools) tools_ready ;;
studio) studio_ready ;;
site) site_ready ;;
peers) peers_ready ;;
clients) clients_ready ;;
bare) programs_ready debootstrap:debootstrap git:git ;;
*) fail "usage: tools/setup.sh python|tools|studio|site|peers|clients|bare" ;;
esac
