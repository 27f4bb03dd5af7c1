"""Borders round a cloth: one period solved on a cylinder, laid along the sides and round the corners."""
