"""Analysis: what a pattern is made of, measured from geometry alone, in the terms of the paper's Table 1."""

from __future__ import annotations

from batik_vector.analysis.analyser import analyse
from batik_vector.analysis.report import COLUMNS, Analysis

__all__ = ["COLUMNS", "Analysis", "analyse"]
