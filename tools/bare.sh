#!/usr/bin/env bash
# Tries README's two commands, as they stand there, on a bare Debian of each suite named.
#
#   tools/bare.sh bookworm trixie
#
# A minimal system with python3, make and ca-certificates is made by debootstrap in a temporary folder, and a
# clone of HEAD put into it. What the samples compile to there is held against what they compile to here. All of
# it lives in a mount namespace and a process namespace of its own, which end with it, however it ends.
#
# The first suite runs all tests. Each further one runs those of what a system brings along: files and signals,
# processes, SQLite, cairo, the shell; the samples' bytes tell of its arithmetic.
set -euo pipefail
cd "$(dirname "$0")/.."

system='tests/command/test_cli.py tests/command/test_habits.py tests/command/test_stopping.py
    tests/export/test_files.py tests/export/test_png.py tests/export/test_raster.py tests/library tests/making
    tests/test_determinism.py tests/test_first_five_minutes.py tests/test_setup.py'

say() { printf '%s\n' "bare: $*" >&2; }

fail() {
    say "$@"
    exit 1
}

if [ "${1:-}" = --inside ]; then
    # In the namespaces: make the system, then run the commands in it.
    suite=$2 folder=$3
    root=$folder/root
    if ! debootstrap --variant=minbase --include=python3,make,ca-certificates "$suite" "$root" >"$folder/log" 2>&1; then
        fail "$suite: debootstrap failed: $(tail -n 1 "$folder/log")"
    fi
    mount -t proc proc "$root/proc"
    mount --rbind /dev "$root/dev"
    # The network, and whom to trust in it, are this machine's.
    cp --dereference /etc/resolv.conf "$root/etc/resolv.conf"
    ! [ -e /etc/ssl/certs/ca-certificates.crt ] ||
        cp --dereference /etc/ssl/certs/ca-certificates.crt "$root/etc/ssl/certs/ca-certificates.crt"
    cp -r "$folder/clone" "$root/srv/batik_vector"
    cp "$folder/here" "$root/srv/here"
    kept=(HOME=/srv LANG=C.UTF-8 PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin)
    # So is whether a change is judged, when random tests try the same everywhere, and how many tests, on how many samples.
    for name in http_proxy https_proxy no_proxy CI FEW PART; do
        if [ -n "${!name:-}" ]; then kept+=("$name=${!name}"); fi
    done
    in_it() { chroot "$root" env -i "${kept[@]}" sh -c "cd /srv/batik_vector && $1" </dev/null; }
    say "$suite: $(in_it 'python3 --version')"
    told="$suite: $(in_it 'python3 -c "import sys; print(sys.version.split()[0])"')"
    while read -r command; do
        began=$SECONDS
        in_it "$command" || fail "$suite: $command failed"
        told+=", ${command/ ONLY=*/ in part} $((SECONDS - began)) s"
    done <"$folder/commands"
    # Wheel and sdist, installed and at work outside of the repository; pip has what they need at hand by now.
    if [ "$suite" = bookworm ]; then
        began=$SECONDS
        in_it "tools/wheel.sh newest" || fail "$suite: tools/wheel.sh failed"
        told+=", wheels $((SECONDS - began)) s"
    fi
    bytes=$(in_it '.venv/bin/python tools/digests.py --against /srv/here' 2>&1) || fail "$suite: $bytes"
    echo "bare: $told, $bytes" >>"$folder/told"
    exit 0
fi

[ $# -gt 0 ] || fail 'usage: tools/bare.sh SUITE…, as "bookworm trixie"'
[ "$(id -u)" -eq 0 ] || fail "only root may make a system in a folder; please run: sudo make test-bare"
command -v debootstrap >/dev/null || fail "please run: apt-get install -y debootstrap"
unshare --mount --pid --fork true 2>/dev/null || fail "this system lets nobody mount, as containers do; please try on another"
[ -z "$(git status --porcelain 2>/dev/null)" ] || say "what is not committed is not tried"

folder=$(mktemp -d)
child=
# The namespaces end with the process that holds them, which hears nothing milder. Nothing is mounted out here,
# so only files are removed.
finish() {
    if [ -n "$child" ] && kill -KILL "$child" 2>/dev/null; then wait "$child" 2>/dev/null || true; fi
    rm -rf --one-file-system "$folder"
}
trap finish EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP

# README's first shell block, without its comments.
awk '/^```sh$/ { inside = 1; next } /^```$/ { if (inside) exit } inside' README.md |
    sed 's/ *#.*//' | grep . >"$folder/commands"
# One commit for all suites, whatever is committed meanwhile.
git clone --quiet --no-hardlinks . "$folder/clone"
.venv/bin/python tools/digests.py >"$folder/here"

failed=0
for suite in "$@"; do
    mkdir "$folder/$suite"
    cp -r "$folder/commands" "$folder/here" "$folder/clone" "$folder/$suite"
    [ "$suite" = "$1" ] || sed -i "s|^make test\$|& ONLY='$(echo $system)'|" "$folder/$suite/commands"
    # In the background, so that a signal is heard at once.
    unshare --mount --pid --fork --kill-child "$0" --inside "$suite" "$folder/$suite" &
    child=$!
    if wait "$child"; then
        cat "$folder/$suite/told" >>"$folder/told"
    else
        failed=1
        echo "bare: $suite FAILED" >>"$folder/told"
    fi
    child=
    rm -rf --one-file-system "${folder:?}/$suite"
done
cat "$folder/told" >&2
exit $failed
