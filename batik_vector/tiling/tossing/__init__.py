"""Tosses: marks scattered over the repeat by chance, evenly, and clear of one another."""
