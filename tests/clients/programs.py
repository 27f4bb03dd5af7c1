"""The programs that people open the files in, called as a script would call them."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

Box = tuple[float, float, float, float]
SECONDS = 180
"""Each call takes about one; more than this is a program that hangs."""


def run(names: str | Sequence[str], *arguments: str | Path, home: Path) -> str:
    """Run a program with a home of its own and return what it wrote; it must succeed.

    Args:
        names: of the program; the first that is installed is taken.
        arguments: of the call.
        home: a folder the program may fill.
    """
    names = [names] if isinstance(names, str) else names
    found = next(filter(None, map(shutil.which, names)), None)
    if found is None:
        missing = f"{names[0]} is not installed: make test-clients installs it"
        if os.environ.get("BATIK_ALLOW_MISSING"):
            pytest.skip(missing)
        pytest.fail(missing)
    room = home / "home"
    room.mkdir(mode=0o700, exist_ok=True)
    own = {"HOME", "XDG_RUNTIME_DIR", "XDG_CONFIG_HOME", "XDG_CACHE_HOME", "XDG_DATA_HOME"}
    done = subprocess.run(
        [found, *map(str, arguments)],
        env={
            "PATH": os.environ["PATH"],
            "LC_ALL": "C.UTF-8",
            "QT_QPA_PLATFORM": "offscreen",
            **dict.fromkeys(own, str(room)),
        },
        cwd=home,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        timeout=SECONDS,
        check=False,
    )
    words = done.stdout.decode(errors="replace")
    assert done.returncode == 0, f"{names[0]} failed ({done.returncode}):\n{words[-2000:]}"
    return words


def dpi(per_mm: float) -> str:
    """Return pixels to the millimetre as programs have it."""
    return f"{per_mm * 25.4:g}"


def inkscape(svg: Path, per_mm: float) -> Path:
    """Return the page as Inkscape draws it."""
    out = svg.with_name("inkscape.png")
    run("inkscape", "--export-area-page", f"--export-dpi={dpi(per_mm)}", f"--export-filename={out}", svg,
        home=svg.parent)  # fmt: skip
    return out


def inkscape_boxes(svg: Path) -> dict[str, Box]:
    """Return left, top, width and height in mm of every object that Inkscape has found, by its id."""
    return boxes_of(run("inkscape", "--query-all", svg, home=svg.parent))


def inkscape_boxes_and_page(svg: Path, per_mm: float) -> tuple[dict[str, Box], Path]:
    """Return both of what `inkscape_boxes` and `inkscape` do; the drawing is opened once."""
    out = svg.with_name("inkscape.png")
    export = f"export-area-page;export-dpi:{dpi(per_mm)};export-filename:{out};export-do"
    return boxes_of(run("inkscape", f"--actions=query-all;{export}", svg, home=svg.parent)), out


def boxes_of(said: str) -> dict[str, Box]:
    """Return the boxes in an answer of Inkscape's, which are in CSS pixels there, 96 to the inch."""

    def rows() -> Iterator[tuple[str, Box]]:
        for line in said.splitlines():
            name, *numbers = line.split(",")
            if len(numbers) == 4:
                left, top, width, height = (float(number) * 25.4 / 96 for number in numbers)
                yield name, (left, top, width, height)

    return dict(rows())


def chromium(svg: Path, width: int, height: int) -> Path:
    """Return what a browser's window of so many CSS pixels (96 to the inch) shows of a file."""
    out = svg.with_name("chromium.png")
    run(
        ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"],
        "--headless",
        "--no-sandbox",
        "--disable-gpu",
        "--disable-dev-shm-usage",
        "--disable-background-networking",
        "--disable-component-update",
        "--disable-default-apps",
        "--disable-extensions",
        "--disable-sync",
        "--no-first-run",
        "--hide-scrollbars",
        "--force-device-scale-factor=1",
        f"--user-data-dir={svg.parent / 'profile'}",
        f"--window-size={width},{height}",
        f"--screenshot={out}",
        svg.as_uri(),
        home=svg.parent,
    )
    return out


def poppler(pdf: Path, per_mm: float) -> Path:
    """Return the page as poppler draws it."""
    out = pdf.with_name("poppler")
    run("pdftocairo", "-png", "-singlefile", "-r", dpi(per_mm), pdf, out, home=pdf.parent)
    return out.with_suffix(".png")


def mupdf(pdf: Path, per_mm: float) -> Path:
    """Return the page as MuPDF draws it."""
    out = pdf.with_name("mupdf.png")
    run("mutool", "draw", "-q", "-r", dpi(per_mm), "-o", out, pdf, home=pdf.parent)
    return out


def librecad(dxf: Path) -> Path:
    """Return the PDF that LibreCAD prints, black on white, on a page of the drawing's limits."""
    folder = dxf.with_name("printed")
    folder.mkdir()
    run("librecad", "dxf2pdf", "--monochrome", "--directory", folder, dxf, home=dxf.parent)
    return folder / dxf.with_suffix(".pdf").name


def openscad(dxf: Path) -> list[list[tuple[float, float]]]:
    """Return the outlines that OpenSCAD makes of closed contours, in mm, y up."""
    scene, out = dxf.with_suffix(".scad"), dxf.with_name("openscad.svg")
    scene.write_text(f'import("{dxf.name}");', "ascii")
    run("openscad", "-q", "-o", out, scene, home=dxf.parent)
    data = re.findall(r' d="([^"]*)"', out.read_text("ascii"))
    rings = [each for path in data for each in path.split("M") if each.strip()]
    return [
        [(float(x), -float(y)) for x, y in re.findall(r"(-?[\d.e-]+),(-?[\d.e-]+)", ring)] for ring in rings
    ]


def rs274(program: Path) -> list[str]:
    """Return the canonical motions and settings that LinuxCNC's interpreter makes of a program."""
    tools = program.with_name("tools.tbl")
    tools.write_text("".join(f"T{number} P{number}\n" for number in range(1, 100)))
    words = run("rs274", "-t", tools, "-g", program, home=program.parent)
    return re.findall(r"^ *\d+ N\.*\d* +([A-Z].*)$", words, re.MULTILINE)


def page_mm(pdf: Path, box: str = "MediaBox") -> tuple[float, float, float, float]:
    """Return a box of the first page in mm, as poppler reads it."""
    for line in run("pdfinfo", "-box", pdf, home=pdf.parent).splitlines():
        if line.startswith(f"{box}:"):
            left, low, right, high = (float(word) * 25.4 / 72 for word in line.split()[1:])
            return left, low, right, high
    raise AssertionError(f"pdfinfo names no {box}")


ROOT = Path(__file__).parents[2]
VPYPE, VPYPE_PYTHON = (str(ROOT / ".venv-vpype" / "bin" / name) for name in ("vpype", "python"))


def vpype(svg: Path) -> Path:
    """Return the SVG that vpype writes of what it has read: a layer for each of its pens."""
    out = svg.with_name("vpype.svg")
    run(VPYPE, "read", svg, "write", out, home=svg.parent)
    return out


Plotted = list[tuple[int, list[tuple[float, float]]]]
"""Strokes as a program has understood them: the pen of each and its places, in units of 0.025 mm."""


def hp2xx(hpgl: Path) -> Plotted:
    """Return what hp2xx draws at true size, from the plain HP-GL that it makes of a file."""
    out = hpgl.with_name("hp2xx.hpgl")
    run("hp2xx", "-q", "-t", "-m", "hpgl", "-f", out, hpgl, home=hpgl.parent)
    strokes: Plotted = []
    pen, at = 0, (0.0, 0.0)
    down = False
    for name, rest in re.findall(r"(SP|PU|PD)([^;]*)", out.read_text()):
        if name == "SP":
            pen, down = int(rest), False
            continue
        x, y = (float(number) for number in rest.split(","))
        if name == "PD":
            if not down:
                strokes.append((pen, [at]))
            strokes[-1][1].append((x, y))
        at, down = (x, y), name == "PD"
    return strokes


def ezhpgl(hpgl: Path) -> Plotted:
    """Return what ezhpgl has read, which knows one unit alone."""
    out = hpgl.with_suffix(".json")
    code = "import sys, ezhpgl; ezhpgl.readfile(sys.argv[1]).write_json(sys.argv[2])"
    run(VPYPE_PYTHON, "-c", code, hpgl, out, home=hpgl.parent)
    found = json.loads(out.read_text())
    assert found["completeness"] == "complete"
    assert found["diagnostics"] == []
    return [
        (each["style"]["pen"], [(p["x"] * 40, p["y"] * 40) for p in each["geometry"]["points"]])
        for page in found["pages"]
        for each in page["operations"]
    ]


def hpgl_buddy(hpgl: Path) -> str:
    """Return what the checker of a 7475A says of a file that it accepts."""
    return run(str(ROOT / ".venv-vpype" / "bin" / "hpgl-buddy"), "check", hpgl, home=hpgl.parent)


def inkscape_export(svg: Path, kind: str) -> Path:
    """Return what Inkscape makes of a drawing as another kind of file: ``hpgl``, or ``dxf``, which is R12."""
    out = svg.with_suffix(f".{kind}")
    run("inkscape", f"--export-type={kind}", f"--export-filename={out}", svg, home=svg.parent)
    return out


def inkscape_saved(svg: Path) -> Path:
    """Return a drawing as Inkscape saves it in its own kind of SVG."""
    out = svg.with_name("saved.svg")
    run("inkscape", "--export-type=svg", f"--export-filename={out}", svg, home=svg.parent)
    return out


def inkscape_r14(svg: Path) -> Path:
    """Return what Inkscape writes as a DXF of release 14, as polylines; only its window can ask for it."""
    out = svg.with_suffix(".r14.dxf")
    folder = run("inkscape", "--system-data-directory", home=svg.parent).splitlines()[-1]
    script = Path(folder, "extensions", "dxf_outlines.py")
    run("/usr/bin/python3", script, "--POLY=true", f"--output={out}", svg, home=svg.parent)
    return out


def plates(pdf: Path, per_mm: float) -> dict[str, Path]:
    """Return the plates that Ghostscript separates a page into: pictures in which ink is black, by name."""
    out = pdf.with_name("plate.tif")
    device = ("-sDEVICE=tiffsep", "-dGraphicsAlphaBits=4", f"-r{dpi(per_mm)}", f"-sOutputFile={out}")
    run("gs", "-q", "-dNOPAUSE", "-dBATCH", "-dSAFER", *device, pdf, home=pdf.parent)
    return {path.stem[len("plate(") : -1]: path for path in pdf.parent.glob("plate(*).tif")}
