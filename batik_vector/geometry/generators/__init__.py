"""Generators: merged cells, contours of fields, regions under iterated maps, and a grammar of shapes."""
