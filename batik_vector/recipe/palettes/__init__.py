"""The palettes that batik has, by name: colours for the screen with their words, their baths and a source."""

from __future__ import annotations

from batik_vector.recipe.palettes.catalogue import PALETTES, Palette, lightness, spread

__all__ = ["PALETTES", "Palette", "lightness", "spread"]
