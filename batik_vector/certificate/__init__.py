"""The seam certificate: what a finished tile is, measured from its geometry alone.

    certificate = certify(artwork)
    certificate.passed
    for fault in certificate.faults:
        print(fault.where, fault.words)

It takes tiles of this package and tiles read from foreign files alike, and believes nothing: what each
check proves, and what it lets pass, is said at the head of its module. The checks are imported when they are
first asked for: who wants the symmetry finder alone need not wait for them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from batik_vector.certificate.expectations import Asked
from batik_vector.certificate.pointers import pointers
from batik_vector.certificate.report import Certificate, Kind, Limits, Measures, SeamFault

if TYPE_CHECKING:
    from batik_vector.certificate.verdict import certify as certify

__all__ = ["Asked", "Certificate", "Kind", "Limits", "Measures", "SeamFault", "certify", "pointers"]


def __getattr__(name: str) -> Any:
    if name != "certify":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from batik_vector.certificate.verdict import certify

    globals()[name] = certify
    return certify
