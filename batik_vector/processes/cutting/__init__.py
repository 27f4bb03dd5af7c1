"""Cutting: what a knife or a beam needs of contours, from regions to the way of the tool."""
