"""Geometry: curves, maps, sampling and regions, knowing neither ink nor page. Fills will have a room here."""
