"""How long a million vertices take, from recipe to files, and what they weigh.

    python benchmarks/million.py [RECIPE.toml]

One process does all, start-up included, and files go to a folder that is removed. CPU seconds count what
every thread used, so that they compare across machines that are busy; memory is the peak up to the end
of a stage.
"""

from __future__ import annotations

import resource
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

RECIPE = Path(__file__).with_suffix(".toml")
FORMATS = ("svg", "pdf", "dxf")
KIB_PER_RSS = 1 if sys.platform != "darwin" else 1 / 1024


@dataclass
class Stage:
    """One line of the report."""

    name: str
    seconds: float
    cpu: float
    peak_mb: float
    size: int | None = None


@dataclass
class Report:
    """What was measured."""

    stages: list[Stage] = field(default_factory=list)

    @contextmanager
    def stage(self, name: str) -> Iterator[Stage]:
        """Measure what is done inside."""
        stage = Stage(name, -time.perf_counter(), -time.process_time(), 0.0)
        yield stage
        stage.seconds += time.perf_counter()
        stage.cpu += time.process_time()
        stage.peak_mb = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * KIB_PER_RSS / 1024
        self.stages.append(stage)

    def table(self) -> str:
        """Return the lines that people read."""
        total = Stage("total", sum(s.seconds for s in self.stages), sum(s.cpu for s in self.stages), 0.0)
        total.peak_mb = max(s.peak_mb for s in self.stages)
        total.size = sum(s.size or 0 for s in self.stages)
        rows = [f"{'stage':<13}{'seconds':>9}{'CPU s':>9}{'share':>8}{'peak MB':>9}{'bytes':>14}"]
        for stage in (*self.stages, total):
            size = "" if stage.size is None else f"{stage.size:,}"
            share = f"{stage.seconds / total.seconds:.0%}"
            rows.append(
                f"{stage.name:<13}{stage.seconds:>9.3f}{stage.cpu:>9.3f}{share:>8}{stage.peak_mb:>9.0f}{size:>14}"
            )
        return "\n".join(rows)


def measured(recipe: Path, folder: Path, report: Report) -> int:
    """Compile a recipe to files in a folder, measuring; return how many vertices it has."""
    with report.stage("start-up"):
        from batik_vector.compiler import compile_recipe
        from batik_vector.export import render, write_whole
        from batik_vector.recipe import load_recipe
    with report.stage("recipe"):
        read = load_recipe(recipe)
    with report.stage("compile"):
        artwork = compile_recipe(read)
    for name in FORMATS:
        with report.stage(name) as stage:
            data = render(artwork, name)
            stage.size = len(data)
        with report.stage(f"{name} to disk"):
            write_whole(folder / f"{recipe.stem}.{name}", data)
    return artwork.vertex_count


def main() -> None:
    """Measure and print."""
    recipe = Path(sys.argv[1]) if len(sys.argv) > 1 else RECIPE
    report = Report()
    with tempfile.TemporaryDirectory() as folder:
        vertices = measured(recipe, Path(folder), report)
    print(f"{recipe.name}: {vertices:,} vertices")
    print(report.table())
    per_vertex = {s.name: s.cpu / vertices * 1e9 for s in report.stages if s.name in ("compile", *FORMATS)}
    print("CPU ns per vertex: " + ", ".join(f"{name} {ns:,.0f}" for name, ns in per_vertex.items()))


if __name__ == "__main__":
    main()
