"""What goes out with a release agrees with the package, and with itself."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

from batik_vector import __version__
from tools import sbom

ROOT = Path(__file__).resolve().parent.parent
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
CITATION = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
CONTAINER = (ROOT / "Containerfile").read_text(encoding="utf-8")


def test_the_bill_of_materials_names_all_that_the_package_needs_and_nothing_of_its_tools() -> None:
    bill = sbom.bill()
    named = {component["name"].lower() for component in bill["components"]}
    needed = {re.split(r"[>=]", each)[0] for each in PROJECT["dependencies"]}
    assert needed <= named
    assert "cffi" in named, "what is needed by what is needed"
    assert not {"pytest", "mypy", "nicegui", "distributed"} & named
    assert all(re.fullmatch(r"pkg:pypi/[a-z0-9-]+@[\w.+]+", each["purl"]) for each in bill["components"])
    assert all(each.get("licenses") for each in bill["components"]), "each says under what licence it is"
    references = {each["bom-ref"] for each in bill["components"]} | {bill["metadata"]["component"]["bom-ref"]}
    for each in bill["dependencies"]:
        assert {each["ref"], *each["dependsOn"]} <= references
    assert sbom.bill() == bill
    assert "pytest" in {component["name"] for component in sbom.bill(extras=["dev"])["components"]}


def test_the_citation_is_of_this_version() -> None:
    assert re.search(r"^version: (.+)$", CITATION, re.MULTILINE)[1] == __version__  # type: ignore[index]
    assert f"license: {PROJECT['license']['text']}\n" in CITATION


def lines_of(text: str) -> list[str]:
    """Return the instructions of a container file, each on a line."""
    joined = text.replace("\\\n", " ")
    return [line for line in joined.splitlines() if line and not line.startswith("#")]


def test_the_container_file_is_slim_and_runs_as_nobody_special() -> None:
    lines = lines_of(CONTAINER)
    words = [line.split()[0] for line in lines]
    assert set(words) <= {"FROM", "RUN", "COPY", "ENV", "USER", "WORKDIR", "ENTRYPOINT", "CMD"}
    assert all(
        re.match(r"FROM debian:[a-z]+-slim( AS \w+)?$", line) for line in lines if line.startswith("FROM")
    )
    for line in lines:
        if "apt-get install" in line:
            assert "--no-install-recommends" in line
            assert "rm -rf /var/lib/apt/lists/*" in line
        if line.startswith("COPY") and "--from" not in line:
            for name in line.split()[1:-1]:
                assert (ROOT / name).exists(), name
                kept = (ROOT / ".containerignore").read_text(encoding="utf-8").split()
                assert f"!{name}" in kept, name
    assert words.index("USER") < words.index("ENTRYPOINT")
    assert lines[-2:] == ['ENTRYPOINT ["batik-vector"]', 'CMD ["--help"]']
    assert "batik-vector" in PROJECT["scripts"]


def test_the_extras_that_the_checklist_names_are_there() -> None:
    page = (ROOT / "docs" / "releasing.md").read_text(encoding="utf-8")
    for extra in re.search(r"extras: ([\w, ]+);", page)[1].split(", "):  # type: ignore[index]
        assert extra in PROJECT["optional-dependencies"]
