"""Geometry: curves, maps, sampling and regions. It knows neither ink nor page."""
