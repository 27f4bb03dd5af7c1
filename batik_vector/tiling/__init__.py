"""Tiling: cells, layouts, and the torus on which a tile is cut."""
