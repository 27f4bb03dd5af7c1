"""Reading drawings that other programs made, as geometry."""
