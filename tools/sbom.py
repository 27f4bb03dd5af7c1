"""What the installed package is made of: a bill of materials (CycloneDX 1.6), equal for equal environments.

``python -m tools.sbom`` lists batik-vector and all it needs, as this environment has them: names, versions,
licences and who needs whom. ``--extra studio`` adds what an extra needs. Neither a time nor a serial number
stands in it, so that equal environments give equal bytes.
https://cyclonedx.org/docs/1.6/json/
"""

from __future__ import annotations

import argparse
import json
import re
import sys
from collections.abc import Sequence
from email.message import Message
from importlib.metadata import Distribution, PackageNotFoundError, distribution
from typing import Any, cast

from packaging.requirements import Requirement

NAME = "batik-vector"
LONGEST = 60
"""A licence longer than this is its text, and no name."""


def closure(name: str, extras: Sequence[str] = ()) -> dict[str, tuple[Distribution, list[str]]]:
    """Return a package and all it needs that is installed: by their names, each with the names it needs.

    Raises:
        PackageNotFoundError: where something needed is not installed.
    """
    found: dict[str, tuple[Distribution, list[str]]] = {}
    left = [(name, frozenset(extras))]
    seen: set[tuple[str, frozenset[str]]] = set()
    while left:
        asked = left.pop()
        if asked in seen:
            continue
        seen.add(asked)
        package, needs = distribution(asked[0]), list[str]()
        for text in package.requires or ():
            each = Requirement(text)
            marker = each.marker
            if marker is None or any(marker.evaluate({"extra": extra}) for extra in (*asked[1], "")):
                needs.append(plain(each.name))
                left.append((plain(each.name), frozenset(each.extras)))
        known = found.get(plain(asked[0]), (package, []))[1]
        found[plain(asked[0])] = package, sorted({*known, *needs})
    return dict(sorted(found.items()))


def plain(name: str) -> str:
    """Return the name of a package in its one spelling (PEP 503)."""
    return re.sub(r"[-_.]+", "-", name).lower()


def bill(name: str = NAME, extras: Sequence[str] = ()) -> dict[str, Any]:
    """Return the bill of materials of a package."""
    packages = closure(name, extras)
    references = {each: f"pkg:pypi/{each}@{package.version}" for each, (package, _) in packages.items()}
    components = {each: _component(package, references[each]) for each, (package, _) in packages.items()}
    own = components.pop(plain(name))
    return {
        "$schema": "http://cyclonedx.org/schema/bom-1.6.schema.json",
        "bomFormat": "CycloneDX",
        "specVersion": "1.6",
        "version": 1,
        "metadata": {"component": own | {"type": "application"}},
        "components": list(components.values()),
        "dependencies": [
            {"ref": references[each], "dependsOn": [references[need] for need in needs]}
            for each, (_, needs) in packages.items()
        ],
    }


def _component(package: Distribution, reference: str) -> dict[str, Any]:
    told = cast(Message, package.metadata)
    licence = told.get("License-Expression")
    if licence:
        licences: list[dict[str, Any]] = [{"expression": licence}]
    else:
        classifiers = [each for each in told.get_all("Classifier") or () if each.startswith("License :: ")]
        classes = [each.rpartition(" :: ")[2] for each in classifiers]
        short = (told.get("License") or "").strip()
        names = [short] if short and len(short) <= LONGEST and "\n" not in short else classes
        licences = [{"license": {"name": each}} for each in names]
    return {
        "type": "library",
        "bom-ref": reference,
        "name": told["Name"],
        "version": package.version,
        **({"description": told["Summary"]} if told.get("Summary") else {}),
        **({"licenses": licences} if licences else {}),
        "purl": reference,
    }


def main() -> None:
    """Print the bill."""
    parser = argparse.ArgumentParser(description="Print a bill of materials (CycloneDX 1.6).")
    parser.add_argument(
        "--extra", action="append", default=[], help="an extra of batik-vector, such as studio"
    )
    try:
        text = json.dumps(bill(extras=parser.parse_args().extra), indent=2, ensure_ascii=False)
    except PackageNotFoundError as error:
        sys.exit(f"sbom: {error.name} is not installed: run make setup")
    print(text)


if __name__ == "__main__":
    main()
