"""Does what a page says, in a folder where the files lie that it takes for granted."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
import tomllib
from glob import glob
from itertools import takewhile
from pathlib import Path
from typing import Any

import click

from batik_vector.command.cli import cli
from tests.calling import runner
from tests.pages.reading import DOCS, ROOT, bare, blocks

SAMPLES = ROOT / "samples"
DRAWINGS = Path(__file__).with_name("drawings")
CASES = {
    "checkerboard": "c02-checkerboard",
    "unit": "c22-half-drop-unit",
    "rounded": "c20-hexagon-rounded-page",
}
"""Drawings that pages name, as the tests of `check` have them."""

OUTSIDE = {
    "make demo": "asks for an environment of its own: make test-bare",
    "make test": "is what runs this",
    "python3 -m venv .venv": "asks for an environment of its own: tools/wheel.sh",
    ". .venv/bin/activate": "asks for an environment of its own: tools/wheel.sh",
    "pip install ./batik_vector": "asks a package index: tools/wheel.sh",
    "pip install batik-vector vpype": "asks a package index: tools/wheel.sh",
    "pip install 'batik-vector[studio]'": "asks a package index: tools/wheel.sh",
    "pip install 'batik-vector[notebook]'": "asks a package index: tools/wheel.sh",
    "pipx install batik-vector": "asks a package index: tools/wheel.sh",
    "uvx batik-vector new mine --kind kawung": "asks a package index: tools/wheel.sh",
    "podman build -t batik-vector .": "asks for podman: by hand, docs/releasing.md",
    'podman run --rm --userns=keep-id -v "$PWD":/work batik-vector compile mine.toml':
        "asks for podman: by hand, docs/releasing.md",
    'docker run --rm --user "$(id -u):$(id -g)" -v "$PWD":/work batik-vector compile mine.toml':
        "asks for docker: by hand, docs/releasing.md",
    "inkscape mine.svg": "opens a window: tests/clients/test_svg.py",
    "make inkscape-extension": "writes into the repository: tests/clients/test_inkscape_extension.py",
    "unzip out/batik-vector-inkscape.zip -d ~/.config/inkscape/extensions":
        "needs what the line before it makes: tests/clients/test_inkscape_extension.py",
    'eval "$(_BATIK_VECTOR_COMPLETE=zsh_source batik-vector)"': "is for zsh: tests/command/test_habits.py",
    "_BATIK_VECTOR_COMPLETE=fish_source batik-vector | source": "is for fish: tests/command/test_habits.py",
    "dask scheduler": "serves until it is stopped: tests/making",
    "dask worker tcp://10.0.0.5:8786": "needs a second machine: tests/making",
}  # fmt: skip
"""Lines that are not run here, and why, or where else they are."""

READ_ALONE = {
    r"batik-vector studio\b": "serves until it is stopped: tests/studio",
    r"batik-vector watch\b": "goes on until it is stopped: tests/making",
    r".* --scheduler tcp:": "needs a cluster: tests/making",
    r"vpype batik ": "needs vpype: tests/clients/test_pages.py",
}
"""Calls that are only read here, by how they begin, and why."""

NEEDS = {"from batik_vector.notebook import": "needs ipywidgets: tests/clients/test_pages.py"}
"""Python that is not run here, by words in it, and why."""

SMALLER = {
    " -n 24": " -n 1",
    " -n 10": " -n 1",
    "count=12,16,20,24": "count=12,24",
    "gap=0.4mm:2.4mm:5": "gap=0.4mm:2.4mm:2",
}
"""What is asked for in greater numbers than a test needs."""

BEFORE = {
    "../README.md": [
        "batik-vector compile kawung.toml -f pdf && mv kawung.pdf old.pdf && cp samples/kawung.toml .",
        "batik-vector new typo --kind flower && sed -i '24s/count/coutn/' typo.toml",
    ],
    "command.md": ["batik-vector compile mine.toml"],
    "library.md": [
        "batik-vector library add kawung.toml",
        "sed -i 's/^title.*/title = \"2\"/' kawung.toml && batik-vector library add kawung.toml",
        "sed -i 's/^title.*/title = \"3\"/' kawung.toml && batik-vector library add kawung.toml",
        "mkdir orders && cp kawung.toml orders/spring.toml && cp kawung.toml lasem-bird.toml",
        "batik-vector library add lasem-bird.toml --tag wedding",
    ],
    "audit.md": ["cp kawung.toml drawing.toml", "batik-vector compile drawing.toml", "rm mine.toml",
                 """printf 'base = "canting"\\n' > mine.toml"""],
    "colour.md": ["""printf '[colourway.red]\\npalette = "bangbangan"\\n' >> kawung.toml"""],
    "wax.md": ["cp samples/wax-javanese.toml kawung.toml"],
}  # fmt: skip
"""What was done before a page begins."""

ADDED = {
    ("tutorial.md", ""): "cloth.toml",
    ("first-five-minutes.md", ""): "mine.toml",
    ("batify.md", "[[motif.batik.dress]]"): "bird-batik.toml",
}
"""The recipe to which what a page shows is added, by how that begins."""


def read(line: str) -> None:
    """Let the command read a call as it would, without making it: its options and its arguments are known."""
    words = list(takewhile(lambda word: word not in ("<", ">"), shlex.split(line, comments=True)))[1:]
    command: click.Command = cli
    context = cli.make_context("batik-vector", list(words), resilient_parsing=False) if words else None
    while isinstance(command, click.Group):
        known = [word for word in words if word in command.commands]
        if not known:
            return
        at = words.index(known[0])
        command, words = command.commands[known[0]], words[at + 1 :]
        if not isinstance(command, click.Group):
            command.make_context(known[0], list(words), parent=context)


def stage(page: str) -> None:
    """Fill the current folder with what the page takes for granted."""
    text = (DOCS / page).read_text(encoding="utf-8")
    shutil.copytree(SAMPLES, "samples", ignore=shutil.ignore_patterns("*.png"))
    done("batik-vector new kawung --kind kawung")
    for name in set(re.findall(r"[\w-]+(?=\.toml)", text)) - {"kawung"}:
        if (SAMPLES / f"{name}.toml").exists():
            shutil.copy(SAMPLES / f"{name}.toml", ".")
    for drawing in (*SAMPLES.glob("*.svg"), *DOCS.glob("pictures/*.svg"), *DRAWINGS.glob("*.svg")):
        shutil.copy(drawing, ".")
    for name, case in CASES.items():
        shutil.copy(ROOT / "tests" / "command" / "cases" / f"{case}.svg", f"{name}.svg")
    if "batik-vector new mine" not in text:
        done("batik-vector new mine --kind flower")
    for line in BEFORE.get(page, []):
        done(line)


def do(page: str) -> None:
    """Do all that a page says, in the current folder, and hold what it shows against what is told."""
    stage(page)
    made: dict[str, object] = {}
    told = ""
    for block in blocks(page):
        if block.kind == "python":
            if any(words in block.text for words in NEEDS):
                continue
            exec(compile(block.text, page, "exec"), made)
        elif block.kind == "toml":
            told = recipe_of(page, block.text)
        elif block.kind == "text":
            assert plain(block.text) in plain(told), (page, block.text, told)
        elif block.kind == "console":
            for line, shown in zip(block.lines, block.shown, strict=True):
                told = done(line, {0, 1, 2})
                pattern = ".*?".join(map(re.escape, plain(shown).split("…")))
                assert re.search(pattern, plain(told)), (page, line, told)
        else:
            told = "".join(done(line) for line in block.lines)


def plain(words: str) -> str:
    """Return words on one line, without what differs from machine to machine."""
    return " ".join(re.sub(r"[\d.,]+ (kB|s|vertices)\b", r"N \1", words).split())


def done(line: str, expected: set[int] | None = None) -> str:
    """Do a line, and return what is told of it."""
    call = bare(line)
    if call in OUTSIDE:
        return ""
    if any(re.match(begins, call) for begins in READ_ALONE):
        if call.startswith("batik-vector "):
            read(call)
        return ""
    for much, little in SMALLER.items():
        call = call.replace(much, little)
    if expected is None:
        # What a machine would fail at is told by the audit.
        expected = {2} if "# fails" in line else {0, 1} if re.search(r" check .*--machine", call) else {0}
    told = ""
    for step in call.split(" && "):
        given: bytes | None = None
        for part in step.split(" | "):
            does = called if part.startswith("batik-vector ") else shelled
            # What looks for words in a pipe may find none.
            given, words = does(part, {0, 1} if part.startswith("grep ") else expected, given)
            told += words
        told += given.decode(errors="replace") if given else ""
    return told


def called(call: str, expected: set[int], given: bytes | None = None) -> tuple[bytes, str]:
    """Make a call in this process, with what files it says; return what it prints and tells."""
    words = shlex.split(call)[1:]
    words = [found for word in words for found in (sorted(glob(word)) if word.startswith("*") else [word])]
    target: Path | None = None
    if "<" in words:
        at = words.index("<")
        given = Path(words[at + 1]).read_bytes()
        del words[at : at + 2]
    if ">" in words:
        at = words.index(">")
        target = Path(words[at + 1]).expanduser()
        del words[at : at + 2]
    result = runner().invoke(cli, words, input=given)
    assert result.exit_code in expected, (call, result.stderr)
    if target:
        target.write_bytes(result.stdout_bytes)
    return b"" if target else result.stdout_bytes, result.stderr


def shelled(call: str, expected: set[int], given: bytes | None = None) -> tuple[bytes, str]:
    """Let a shell do a line, with the command of this environment before any other."""
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    if call.startswith("man ") and shutil.which("man") is None:
        return b"", ""
    done = subprocess.run(
        ["bash", "-ec", call], env={**os.environ, "PATH": path}, input=given, capture_output=True, check=False
    )
    assert done.returncode in expected, (call, done.stderr)
    return done.stdout, done.stderr.decode(errors="replace")


def recipe_of(page: str, text: str) -> str:
    """Use what a page shows of a recipe, and return what is told."""
    tables = tomllib.loads(text)
    if "project" in tables:
        assert text.splitlines()[0] in (ROOT / "examples" / "plugin" / "pyproject.toml").read_text(
            encoding="utf-8"
        )
        return ""
    if "base" in tables:
        Path("shown.toml").write_text(text, encoding="utf-8")
        kind = next(each for each in ("hpgl", "gcode", "limits") if each in tables)
        if kind == "limits":
            return done("batik-vector check kawung.toml --machine shown.toml")
        call = f"compile kawung.toml -f {kind} --machine shown.toml --process plot --dry-run"
        return done(f"batik-vector {call}")
    for (of, begins), recipe in ADDED.items():
        if page == of and text.startswith(begins):
            with Path(recipe).open("a", encoding="utf-8") as file:
                file.write("\n" + text)
            return ""
    Path("shown.toml").write_text(whole(text, tables), encoding="utf-8")
    return done("batik-vector compile shown.toml --dry-run")


def whole(text: str, tables: dict[str, Any]) -> str:
    """Make a whole recipe of a part of one: what it names and does not say is what is usual."""
    inks = sorted({*tables.get("ink", {}), *re.findall(r'ink\s*= "([\w-]+)"', text)}) or ["wax"]
    placed = re.findall(r'^motif\s*= *(.+)$|\{ motif = (".+?")', text, re.M)
    named = set(re.findall(r'"([\w-]+)"', " ".join(a or b for a, b in placed)))
    named |= set(tables.get("motif", {}))
    own = (
        text
        if named
        else in_the_rest(text, "samples/wax-javanese.toml" if "bath" in tables else "kawung.toml")
    )
    for motif in sorted(named - set(tables.get("motif", {}))):
        length = 15 if 'scale  = "1 mm"' in text else 1
        curve = f'{{ kind = "superellipse", length = {length}, width = {length / 2} }}'
        own += f'\n[motif.{motif}]\nkind = "rosette"\nelements = [{{ curve = {curve}, ink = "{inks[0]}" }}]\n'
    for ink in sorted(set(inks) - set(tomllib.loads(own).get("ink", {}))):
        own += f'\n[ink.{ink}]\ncolour = "#f4efe2"\n'
    if "[[place]]" not in own:
        own += "".join(
            f'\n[[place]]\nmotif = "{motif}"\nwidth = 40\nink = "{inks[0]}"\n' for motif in sorted(named)
        )
    if "[tile]" not in own:
        own += "\n[tile]\nsize = [120, 120]\n"
    return own


def in_the_rest(text: str, recipe: str) -> str:
    """Put tables into a recipe that has the rest, in place of its own; what they place lies on top."""
    heads = set(re.findall(r"^\[.+\]$", re.sub(r" +#.*$", "", text, flags=re.M), re.M)) - {"[[place]]"}
    parts = re.split(r"(?m)^(?=\[)", Path(recipe).read_text(encoding="utf-8"))
    return "".join(part for part in parts if part.partition("\n")[0].rstrip() not in heads) + "\n" + text
