"""One plug-in of each sort for batik-vector: a curve, a motif, a layout, a fill, a process and a format."""
