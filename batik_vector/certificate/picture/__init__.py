"""The seam of a drawing as it shows: what is painted along the edges of the page, and where that differs."""
