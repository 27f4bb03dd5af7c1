"""Kernels of plotting: each stroke once, longest paths, what lies hidden, and how long a pen takes."""
