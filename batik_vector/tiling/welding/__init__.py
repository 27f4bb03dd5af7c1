"""Welding: sheets of marks laid one over another, cut and united into the layers of a tile."""
