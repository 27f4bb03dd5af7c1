"""Own drawings: what an SVG paints, picked by name, as the marks of a motif."""
