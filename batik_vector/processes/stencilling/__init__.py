"""Stencilling: bridges by which a sheet with openings is one piece, on the torus and on the endless cloth."""
