"""Paths: outlines of lines and cubic Béziers, and the data that SVG writes them with."""
