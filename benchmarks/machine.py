"""What all of it ran on."""

from __future__ import annotations

import datetime
import json
import os
import platform
from pathlib import Path
from typing import Any

from benchmarks.timing import OWN, PEERS, FailedError, process

PACKAGES = ("numpy", "shapely", "svgwrite", "cairosvg", "ezdxf")
PEER_PACKAGES = (*PACKAGES, "vpype", "vsketch", "deduplicate", "drawsvg", "matplotlib", "pycairo")
ASK = """
import json, sys
from importlib import metadata
sys.path.append(sys.prefix + "/plug-ins")
known = {}
for name in %r:
    try:
        known[name] = metadata.version(name)
    except metadata.PackageNotFoundError:
        pass
try:
    import shapely
    known["GEOS"] = shapely.geos_version_string
except ImportError:
    pass
print(json.dumps({"python": sys.version.split()[0], **known}))
"""


def processor() -> str:
    """Return the processor's name."""
    try:
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    except OSError:
        pass
    return platform.processor() or platform.machine()


def cores() -> int:
    """Return on how many cores we may run."""
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:
        return os.cpu_count() or 1


def versions(python: Path, packages: tuple[str, ...]) -> dict[str, str]:
    """Return the versions in an environment; none where there is no such environment."""
    try:
        _, said = process([str(python), "-c", ASK % (packages,)])
    except FailedError:
        return {}
    known: dict[str, str] = json.loads(said)
    return known


def about() -> dict[str, Any]:
    """Return the date, the machine and the versions, as plain values."""
    return {
        "date": datetime.date.today().isoformat(),
        "processor": processor(),
        "cores": cores(),
        "load": round(os.getloadavg()[0], 1),
        "system": f"{platform.system()} {platform.release().partition('-')[0]}",
        "own": versions(OWN / "python", PACKAGES),
        "peers": versions(PEERS / "python", PEER_PACKAGES),
    }
