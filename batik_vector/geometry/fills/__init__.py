"""Fills: marks that fill regions and never leave them, all regions at once."""
