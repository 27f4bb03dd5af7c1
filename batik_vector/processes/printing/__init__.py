"""Printing: plates of inks one by one, and what comes of them out of register."""
