"""The seam certificate: what a finished tile is, measured from its geometry alone.

    certificate = certify(artwork)
    certificate.passed
    for fault in certificate.faults:
        print(fault.where, fault.words)

It takes tiles of this package and tiles read from foreign files alike, and believes nothing: what each
check proves, and what it lets pass, is said at the head of its module.
"""

from __future__ import annotations

from batik_vector.certificate.expectations import Asked
from batik_vector.certificate.pointers import pointers
from batik_vector.certificate.report import Certificate, Kind, Limits, Measures, SeamFault
from batik_vector.certificate.verdict import certify

__all__ = ["Asked", "Certificate", "Kind", "Limits", "Measures", "SeamFault", "certify", "pointers"]
