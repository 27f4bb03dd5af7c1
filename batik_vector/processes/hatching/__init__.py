"""Hatching: areas filled by the strokes of a pen, in parallel, crossed, in rings or in spirals."""
