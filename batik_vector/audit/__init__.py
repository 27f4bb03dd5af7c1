"""The audit: what a drawing asks of a machine that it cannot do, measured in mm, with places.

    found = audit(artwork, machine)
    for each in found.findings:
        print(each.where, each.words)

It measures geometry alone, as the seam certificate does, on the torus: what lies across a seam is one mark.
"""

from __future__ import annotations

from batik_vector.audit.auditor import audit
from batik_vector.audit.report import Audit, Finding, Group, Kind

__all__ = ["Audit", "Finding", "Group", "Kind", "audit"]
