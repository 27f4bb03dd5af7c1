"""Cloth made of a tile: fields of repeats, and yardage with its selvedges and marks."""
