"""Set-up tells in one line what stopped it, whatever that was, and the next call goes on.

What fails is played by a stand-in for Python that prints what pip, venv and apt were seen to print.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from tools.lowest import PROJECT, lowest

ROOT = Path(__file__).resolve().parent.parent
STAND_IN = """#!/bin/bash
# A Python that makes environments with itself in them, and whose pip says what the test wants.
case "$*" in
*"-m venv"*) mkdir -p "${@: -1}/bin" && cp "$0" "${@: -1}/bin/python" && cat "$(dirname "$0")/made.txt" ;;
*"pip --version"*) echo "pip 24" ;;
*"pip install"*)
    cat "$STAND_IN/said.txt" >&2
    exit "$(cat "$STAND_IN/code.txt")"
    ;;
*ensurepip*) exit "$(cat "$STAND_IN/ensurepip.txt")" ;;
*"-venv"*) echo python3.11-venv ;;
esac
"""

NETWORK = """WARNING: Retrying (Retry(total=0, connect=None, read=None, redirect=None, status=None)) after \
connection broken by 'NewConnectionError('<pip._vendor.urllib3.connection.HTTPSConnection object at 0x7f>: \
Failed to establish a new connection: [Errno -3] Temporary failure in name resolution')': /simple/hatchling/
ERROR: Could not find a version that satisfies the requirement hatchling>=1.24 (from versions: none)
ERROR: No matching distribution found for hatchling>=1.24
"""
FULL = "ERROR: Could not install packages due to an OSError: [Errno 28] No space left on device\n"
CLOSED = """ERROR: Could not install packages due to an OSError: [Errno 13] Permission denied: \
'/opt/x/.venv/lib/python3.11/site-packages/click'
Check the permissions.
"""
READ_ONLY = "OSError: [Errno 30] Read-only file system: '/opt/x/.venv/bin/ruff'\n"
ODD = "ERROR: Failed building wheel for numpy\nnote: This is an issue with the package mentioned above.\n"


class Project:
    """A copy of what set-up needs, and the stand-in."""

    def __init__(self, folder: Path) -> None:
        self.root = folder / "project"
        self.stand_in = folder / "stand-in"
        (self.root / "tools").mkdir(parents=True)
        self.stand_in.mkdir()
        for name in ("setup.sh", "lowest.py"):
            shutil.copy(ROOT / "tools" / name, self.root / "tools" / name)
        shutil.copy(ROOT / "Makefile", self.root)
        shutil.copy(PROJECT, self.root)
        python = self.stand_in / "python3"
        python.write_text(STAND_IN)
        python.chmod(0o755)
        (self.stand_in / "made.txt").write_text("")
        self.says("", 0)

    def says(self, said: str, code: int, ensurepip: int = 0) -> None:
        for name, value in (("said", said), ("code", code), ("ensurepip", ensurepip)):
            (self.stand_in / f"{name}.txt").write_text(str(value))

    def make(self, *args: str, path: str = "/usr/bin:/bin", **more: str) -> subprocess.CompletedProcess[str]:
        known = {"PATH": path, "STAND_IN": str(self.stand_in), "LC_ALL": "C.UTF-8", **more}
        command = ["make", "setup", f"PYTHON={self.stand_in / 'python3'}", *args]
        return subprocess.run(command, cwd=self.root, env=known, capture_output=True, text=True)


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return Project(tmp_path)


def told(done: subprocess.CompletedProcess[str]) -> str:
    """Return what was told of a failure: the last line of set-up, with make's own behind it."""
    assert done.returncode
    lines = [line for line in done.stderr.splitlines() if line.startswith("setup: ")]
    assert "Traceback" not in done.stderr
    return lines[-1]


@pytest.mark.parametrize(
    ("said", "words"),
    [
        (NETWORK, "no network, or the package index does not answer; run make again when it does"),
        (FULL, "the disk is full; free some room, then run make again"),
        (CLOSED, "may not write '/opt/x/.venv/lib/python3.11/site-packages/click'"),
        (READ_ONLY, "may not write '/opt/x/.venv/bin/ruff'"),
        (ODD, "failed: ERROR: Failed building wheel for numpy"),
        ("Killed\n", "failed: Killed"),
        ("", "failed: for no reason that it told"),
    ],
)
def test_what_stops_set_up_is_told_in_one_line_and_the_next_call_goes_on(
    project: Project, said: str, words: str
) -> None:
    project.says(said, 1)
    assert words in told(project.make())
    assert not (project.root / ".venv" / ".ready").exists()
    # What may be half there is made anew.
    (project.root / ".venv" / "half").touch()
    project.says("", 0)
    done = project.make()
    assert done.returncode == 0, done.stderr
    assert "making .venv" in done.stderr
    assert (project.root / ".venv" / ".ready").exists()
    assert project.make().stderr == ""


def test_a_missing_venv_package_is_installed_or_named(project: Project, tmp_path: Path) -> None:
    project.says("", 0, ensurepip=1)
    bin_ = tmp_path / "bin"
    bin_.mkdir()
    needed = "bash cat cp dirname env grep head id make mkdir mktemp rm sh tail touch"
    for name in needed.split(" "):
        (bin_ / name).symlink_to(shutil.which(name) or name)
    words = "please run: sudo apt-get install -y --no-install-recommends python3.11-venv"
    assert told(project.make(path=str(bin_))) == f"setup: {words}"
    apt = bin_ / "apt-get"
    apt.write_text("#!/bin/bash\necho 'E: Unable to locate package python3.11-venv'\nexit 100\n")
    apt.chmod(0o755)
    # Where we are not root, sudo is asked, and there is none.
    line = told(project.make(path=str(bin_)))
    located = "installing python3.11-venv (apt) failed: E: Unable to locate package python3.11-venv"
    assert line == f"setup: {located if os.geteuid() == 0 else words}"


def test_no_room_for_a_temporary_file_is_told(project: Project) -> None:
    line = told(project.make(TMPDIR=str(project.root / "nowhere")))
    place = project.root / "nowhere"
    assert line.endswith(f"no room for a temporary file in {place}: free some, then run make again")


def test_an_old_or_absent_python_is_told(project: Project, tmp_path: Path) -> None:
    line = told(project.make(f"PYTHON={tmp_path / 'no-python'}"))
    assert line.endswith("no-python is missing; please run: sudo apt-get install -y python3")
    (tmp_path / "old").write_text('#!/bin/bash\n[ "$1" != --version ] || echo Python 3.9.2\nexit 1\n')
    (tmp_path / "old").chmod(0o755)
    line = told(project.make(f"PYTHON={tmp_path / 'old'}"))
    assert "Python 3.9.2 is too old: 3.11 or later is needed" in line


def test_the_lowest_versions_are_those_of_the_project() -> None:
    text = PROJECT.read_text(encoding="utf-8")
    rows = dict(row.split("==") for row in lowest(text))
    asked = tomllib.loads(text)["project"]
    extras = {each for extra in asked["optional-dependencies"].values() for each in extra}
    assert len(rows) == len(asked["dependencies"]) + len(extras)
    assert f"numpy>={rows['numpy']}" in asked["dependencies"]
    with pytest.raises(ValueError, match='"numpy<3": expected a name and its lowest version'):
        list(lowest(text.replace(f"numpy>={rows['numpy']}", "numpy<3")))


def test_bare_systems_ask_kindly_for_what_they_lack() -> None:
    bare = ROOT / "tools" / "bare.sh"
    usage = subprocess.run([bare], capture_output=True, text=True)
    assert usage.returncode == 1
    assert usage.stderr == 'bare: usage: tools/bare.sh SUITE…, as "bookworm trixie"\n'
    if os.geteuid() == 0 and shutil.which("setpriv"):
        nobody = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups", "bash", "-s", "--", "sid"]
        other = subprocess.run(nobody, input=bare.read_text(), capture_output=True, text=True)
        assert other.returncode == 1
        assert other.stderr.endswith("please run: sudo make test-bare\n")


def test_what_further_bare_systems_are_tried_with_is_there() -> None:
    text = (ROOT / "tools" / "bare.sh").read_text(encoding="utf-8")
    named = text.split("system='", 1)[1].split("'", 1)[0].split()
    assert named
    assert [each for each in named if not (ROOT / each).exists()] == []
    (line,) = (
        line
        for line in (ROOT / "README.md").read_text(encoding="utf-8").splitlines()
        if line.startswith("make test ")
    )
    # As bare.sh reads it, and puts them behind it.
    assert line.partition("#")[0].rstrip() == "make test"
    dry = ["make", "--no-print-directory", "-n", "test", "ONLY=" + " ".join(named)]
    asked = subprocess.run(dry, cwd=ROOT, capture_output=True, text=True)
    assert asked.stdout.rstrip().endswith(" ".join(named))


def test_every_python_is_found_once_and_a_failure_is_told_at_the_end(tmp_path: Path) -> None:
    (tmp_path / "tools").mkdir()
    shutil.copy(ROOT / "tools" / "pythons.sh", tmp_path / "tools")
    recipe = "good:\n\t@$(PYTHON) -c pass\nbad:\n\t@false\n"
    (tmp_path / "Makefile").write_text(recipe)
    python = os.path.realpath(sys.executable)
    known = {"PATH": f"{Path(python).parent}:/usr/bin:/bin", "HOME": str(tmp_path), "PYTHON": python}
    run = [tmp_path / "tools" / "pythons.sh"]
    good = subprocess.run([*run, "good"], env=known, capture_output=True, text=True)
    version = sys.version.split()[0]
    assert good.returncode == 0, good.stderr
    assert good.stderr.count(f"pythons: {version}") == 2
    bad = subprocess.run([*run, "bad"], env=known, capture_output=True, text=True)
    assert bad.returncode == 1
    assert f"pythons: {version:8} FAILED" in bad.stderr
