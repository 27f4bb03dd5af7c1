"""Batify: a plain drawing becomes batik, as a recipe and a drawing beside it, both to be edited."""
