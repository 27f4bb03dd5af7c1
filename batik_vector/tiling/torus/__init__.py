"""The torus on which a tile is cut: arithmetic round a cell, its seams, and lines that close on it."""
