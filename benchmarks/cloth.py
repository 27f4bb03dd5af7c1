"""What a cloth costs as it grows longer: CPU seconds per square metre, and memory beyond the interpreter's.

    python benchmarks/cloth.py [RECIPE.toml]

Each length is compiled in a process of its own, three times, and the median told; files go to a folder
that is removed. The tile is compiled first and timed apart, since it costs the same for any length.
"""

from __future__ import annotations

import resource
import statistics
import subprocess
import sys
import tempfile
import time
from dataclasses import replace
from pathlib import Path

RECIPE = Path(__file__).resolve().parents[1] / "samples" / "chrysanthemum-line.toml"
WIDTH, LENGTHS = 1500.0, (1000.0, 2000.0, 5000.0, 10_000.0)
FORMATS = ("svg", "pdf", "dxf")
RUNS = 3


def one(recipe: str, length: float, format_: str) -> None:
    """Print the vertices, the CPU seconds, and the peak beyond the imports in MiB, of one cloth."""
    from batik_vector import compile_cloth, compile_recipe, load_recipe, write_artwork
    from batik_vector.tiling.yardage import YardageSpec

    spec = YardageSpec(width=WIDTH, length=length, selvedge=15.0, marks=True, limit=400_000_000)
    read = replace(load_recipe(recipe), yardage=spec)
    bare = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    tile = compile_recipe(read)
    begun = time.process_time()
    page = compile_cloth(read, tile=tile)
    with tempfile.TemporaryDirectory() as folder:
        write_artwork(page, Path(folder) / f"cloth.{format_}")
    spent = time.process_time() - begun
    print(page.vertex_count, spent, (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - bare) / 1024)


def measured(recipe: Path, length: float, format_: str) -> tuple[int, float, float]:
    """Return the medians of several processes."""
    call = [sys.executable, __file__, "--one", str(recipe), str(length), format_]
    runs = [subprocess.run(call, check=True, capture_output=True, text=True).stdout for _ in range(RUNS)]
    columns = zip(*([float(word) for word in run.split()] for run in runs), strict=True)
    vertices, cpu, peak = (statistics.median(column) for column in columns)
    return round(vertices), cpu, peak


def main() -> None:
    """Measure and print."""
    if sys.argv[1:2] == ["--one"]:
        one(sys.argv[2], float(sys.argv[3]), sys.argv[4])
        return
    recipe = Path(sys.argv[1]) if len(sys.argv) > 1 else RECIPE
    print(f"{recipe.name}, {WIDTH / 1000:g} m wide")
    print(f"{'format':<8}{'metres':>8}{'vertices':>12}{'CPU s':>8}{'s per m²':>10}{'peak MiB':>10}")
    for format_ in FORMATS:
        for length in LENGTHS:
            vertices, cpu, peak = measured(recipe, length, format_)
            share = cpu / (WIDTH * length / 1e6)
            print(f"{format_:<8}{length / 1000:>8g}{vertices:>12,}{cpu:>8.2f}{share:>10.4f}{peak:>10.0f}")


if __name__ == "__main__":
    main()
