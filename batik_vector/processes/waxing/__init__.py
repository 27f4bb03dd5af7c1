"""Wax resist: the plates of a dyeing, bath by bath."""
