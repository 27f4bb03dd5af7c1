"""Drafting: from a tile that another program drew to a recipe that draws the same cloth."""
