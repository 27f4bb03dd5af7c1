"""The symmetry group of a tile, found from its outline on the torus."""
