"""The documentation site, from the pages of this repository: ``python -m tools.site`` writes out/site.

The pages are those people read in the repository; nothing is written twice. They are put together in a
folder with the gallery and with the reference of the public names, made from their docstrings, and Sphinx
makes the site of them. Every link within it is then followed.
"""

from __future__ import annotations

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urldefrag

import batik_vector

ROOT = Path(__file__).resolve().parents[1]
DOCS = ROOT / "docs"
OUT = ROOT / "out" / "site"
NOT_PAGES = ("figures/README.md",)
ELSEWHERE = {
    "README.md": "index.md",
    "samples/README.md": "gallery.md",
    "samples/FIGURES.md": "paper.md",
    "samples/DRAWINGS.md": "drawings.md",
    "benchmarks/README.md": "benchmarks.md",
}
"""Pages of the repository that stand outside of docs/, and what the site calls them."""
LINK = re.compile(r"(!?)\[((?:[^][]|\[[^]]*\])*)\]\(([^)\s]+)\)")
PICTURE = re.compile(r'(<img\b[^>]*\bsrc=")([^"]+)(")')
FENCE = re.compile(r"^(```.*?^```\s*?$)", re.MULTILINE | re.DOTALL)
MENU = {
    "Begin": "tutorial first-five-minutes gallery studio",
    "Your job": "howto/designer howto/workshop howto/printer howto/cutter howto/plotter howto/programmer",
    "More on": "fills structures wax print pens cutting stencils plotting machines drawings audit elsewhere "
    "library sweeps watch command",
    "Reference": "recipe api mathematics paper plugins architecture benchmarks releasing",
}
"""The pages as the side of the site lists them; others come behind what there is more on."""


def menu(names: list[str]) -> str:
    """Return the lists of pages at the side of the site."""
    known = {title: words.split() for title, words in MENU.items()}
    listed = {name for each in known.values() for name in each}
    known["More on"] += [name for name in names if name not in listed and name != "index"]
    parts = [
        "\n".join(["", "```{toctree}", ":hidden:", f":caption: {title}", "", *each, "```", ""])
        for title, each in known.items()
    ]
    return "".join(parts)


def assembled(folder: Path) -> None:
    """Put the pages of the site together in a folder."""
    for path in sorted(DOCS.rglob("*")):
        name = path.relative_to(DOCS).as_posix()
        target = folder / name
        if path.is_dir() or name in NOT_PAGES or path.suffix == ".toml":
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        if path.suffix == ".md":
            target.write_text(page(path, Path(name)), encoding="utf-8")
        else:
            shutil.copyfile(path, target)
    for origin, name in ELSEWHERE.items():
        if name != "index.md":
            (folder / name).write_text(page(ROOT / origin, Path(name)), encoding="utf-8")
    (folder / "samples").mkdir()
    for path in sorted((ROOT / "samples").iterdir()):
        if path.suffix in (".png", ".toml", ".svg", ".py"):
            shutil.copyfile(path, folder / "samples" / path.name)
    (folder / "api.md").write_text(reference(), encoding="utf-8")
    names = [path.relative_to(folder).with_suffix("").as_posix() for path in sorted(folder.rglob("*.md"))]
    with (folder / "index.md").open("a", encoding="utf-8") as index:
        index.write(menu(names))


def page(path: Path, at: Path) -> str:
    """Return a page with its links as the site has them; ``at`` is where it stands in the site."""
    parts = FENCE.split(path.read_text(encoding="utf-8"))
    for number in range(0, len(parts), 2):  # what lies between blocks of code
        text = LINK.sub(lambda found: _link(found, path, at), parts[number])
        parts[number] = PICTURE.sub(lambda found: found[1] + _moved(found[2], path, at)[0] + found[3], text)
    return "".join(parts)


def _link(found: re.Match[str], path: Path, at: Path) -> str:
    mark, words, target = found.groups()
    if re.match(r"[a-z]+:|#", target):
        return found[0]
    moved, there = _moved(target, path, at)
    # What the site has no page for is named alone.
    return f"{mark}[{words}]({moved})" if there else words


def _moved(target: str, path: Path, at: Path) -> tuple[str, bool]:
    """Return a link of a file as the site has it, and whether the site has what it names."""
    name, anchor = urldefrag(target)
    whole = Path(os.path.normpath(path.parent / name)).relative_to(ROOT).as_posix()
    if whole in ELSEWHERE:
        new = ELSEWHERE[whole]
    elif whole.startswith("docs/") and (ROOT / whole).is_file():
        new = whole.removeprefix("docs/")
    elif whole.startswith("samples/"):
        new = whole
    else:
        return target, False
    return os.path.relpath(new, at.parent) + (f"#{anchor}" if anchor else ""), True


def reference() -> str:
    """Return the page of the public names, from their docstrings."""
    lines = ["# The Python interface", "", "Names are imported from `batik_vector` itself.", ""]
    kinds: dict[str, list[str]] = {"Functions": [], "Classes": [], "Errors": []}
    for name in sorted(batik_vector.__all__):
        value = getattr(batik_vector, name)
        if name.startswith("__"):
            continue
        kind = (
            "Functions"
            if not isinstance(value, type)
            else "Errors"
            if issubclass(value, Exception)
            else "Classes"
        )
        kinds[kind].append(name)
    for kind, names in kinds.items():
        lines += [f"## {kind}", ""]
        for name in names:
            what = "autofunction" if kind == "Functions" else "autoclass"
            members = "\n:members:\n:member-order: bysource" if kind == "Classes" else ""
            lines += ["```{eval-rst}", f".. {what}:: batik_vector.{name}"]
            lines += [f"   {each}" for each in members.split("\n") if each] + ["```", ""]
    return "\n".join(lines)


class _Page(HTMLParser):
    """What a page names, and what can be named in it."""

    def __init__(self) -> None:
        super().__init__()
        self.named: list[str] = []
        self.anchors: set[str] = set()
        self.pictures: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Note links, sources and anchors."""
        found = dict(attrs)
        self.anchors |= {each for each in (found.get("id"), found.get("name")) if each}
        key = "href" if tag in ("a", "link") else "src" if tag in ("img", "script") else ""
        if found.get(key):
            self.named.append(found[key] or "")
        if tag == "img":
            self.pictures.append(found.get("src") or "")


def read(path: Path) -> _Page:
    """Return what a page of the site names."""
    found = _Page()
    found.feed(path.read_text(encoding="utf-8"))
    return found


def dead_links(site: Path) -> Iterator[str]:
    """Yield the links within a site that lead nowhere, each with the page that it stands on."""
    pages = {path: read(path) for path in sorted(site.rglob("*.html"))}
    for path, found in pages.items():
        for target in found.named:
            name, anchor = urldefrag(target)
            if re.match(r"[a-z]+:|//", name):
                continue
            there = Path(os.path.normpath(path.parent / unquote(name.partition("?")[0]))) if name else path
            if not there.exists():
                yield f"{path.relative_to(site)}: {target}"
            elif anchor and there in pages and unquote(anchor) not in pages[there].anchors:
                yield f"{path.relative_to(site)}: {target}: no such place there"


def built(out: Path, source: Path) -> None:
    """Make the site of the pages in a folder; whatever Sphinx warns of ends it."""
    call = [
        sys.executable,
        "-m",
        "sphinx",
        "-b",
        "html",
        "-W",
        "--keep-going",
        "-q",
        "-c",
        str(ROOT / "tools" / "sphinx"),
    ]
    subprocess.run([*call, str(source), str(out)], check=True, env={**os.environ, "PYTHONPATH": str(ROOT)})
    # What Sphinx keeps for itself, with times in it, is nobody's page.
    shutil.rmtree(out / ".doctrees", ignore_errors=True)
    # Pictures in paragraphs of HTML it takes as they stand.
    for path in sorted(out.rglob("*.html")):
        for name in read(path).pictures:
            there = Path(os.path.normpath(path.parent / name))
            if out in there.parents and not there.exists() and (source / there.relative_to(out)).is_file():
                there.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(source / there.relative_to(out), there)


def main() -> None:
    """Make the site, and follow its links."""
    parser = argparse.ArgumentParser(description="Make the documentation site.")
    parser.add_argument("-o", dest="out", type=Path, default=OUT, help="where it goes")
    out: Path = parser.parse_args().out
    shutil.rmtree(out, ignore_errors=True)
    with tempfile.TemporaryDirectory(prefix="batik-site-") as folder:
        assembled(Path(folder))
        try:
            built(out, Path(folder))
        except subprocess.CalledProcessError as error:
            sys.exit(f"site: sphinx ended with {error.returncode}")
    dead = list(dead_links(out))
    if dead:
        sys.exit("site: links that lead nowhere:\n" + "\n".join(dead))
    print(f"{out / 'index.html'}: {len(list(out.rglob('*.html')))} pages")


if __name__ == "__main__":
    main()
