"""A real Dask cluster of two worker processes: the same bytes, and a worker that dies costs time alone."""

from __future__ import annotations

import importlib
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from batik_vector.command.cli import cli
from batik_vector.errors import MissingLibraryError
from batik_vector.making import cluster
from tests.calling import runner
from tests.making.test_sweeping import RECIPE, held
from tests.thorough import examples, long

ASKED = ("sweep", "dots.toml", "--vary", "elements.count=3:14:12", "-f", "svg,dxf", "--sheet")


@pytest.fixture
def desk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    Path("dots.toml").write_text(RECIPE)
    return tmp_path


@pytest.fixture
def scheduler() -> Iterator[tuple[str, Any]]:
    """The address of a scheduler with two worker processes, and the cluster itself."""
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address="127.0.0.1:0", silence_logs=50
    ) as begun:
        yield begun.scheduler_address, begun


def called(*words: str) -> str:
    result = runner().invoke(cli, [*ASKED, *words])
    assert result.exit_code == 0, result.stderr
    return result.stderr


@long
def test_a_cluster_makes_the_same_bytes_though_a_worker_is_killed(
    desk: Path, scheduler: tuple[str, Any]
) -> None:
    address, begun = scheduler
    called("-o", "here")
    assert "12 variants made" in called("-o", "there", "--scheduler", address)
    assert held("here") == held("there")
    for turn in range(examples(1, 5)):
        victim = next(iter(begun.workers.values())).pid

        def kill(process: int = victim, wait: float = 0.1 + 0.1 * turn) -> None:
            time.sleep(wait)
            os.kill(process, signal.SIGKILL)

        killer = threading.Thread(target=kill)
        killer.start()
        called("-o", f"again-{turn}", "--scheduler", address)
        killer.join()
        assert held("here") == held(f"again-{turn}")
        time.sleep(1)


@long
def test_another_version_on_a_worker_is_told(
    desk: Path, scheduler: tuple[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(cluster, "__version__", "99")
    result = runner().invoke(cli, [*ASKED, "--scheduler", scheduler[0]])
    assert result.exit_code == 2
    assert "expected 99" in result.stderr
    assert not list(Path("dots-sweep").glob("*.svg"))


def test_where_nobody_answers_that_is_told(desk: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("distributed")
    monkeypatch.setattr(cluster, "ANSWER", 0.2)
    result = runner().invoke(cli, [*ASKED, "--scheduler", "tcp://127.0.0.1:9"])
    assert result.exit_code == 2
    assert "--scheduler tcp://127.0.0.1:9: nobody answers there" in result.stderr
    assert not Path("dots-sweep").exists()


def test_an_extra_that_is_missing_is_told(desk: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def absent(name: str) -> Any:
        raise ImportError(name)

    monkeypatch.setattr(importlib, "import_module", absent)
    with pytest.raises(MissingLibraryError, match=r"pip install 'batik-vector\[cluster\]'"):
        next(cluster.outcomes_on("tcp://127.0.0.1:9", len, ["a"]))


def test_nothing_of_it_is_imported_without_need() -> None:
    rooms = "batik_vector.command.sweeps, batik_vector.making.sweeping"
    asked = f"import sys, {rooms}; print('distributed' in sys.modules)"
    assert subprocess.check_output([sys.executable, "-c", asked], text=True) == "False\n"
