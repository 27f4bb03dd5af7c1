"""Symmetry: the wallpaper and frieze groups, the repeat, and what a placement is multiplied by."""
