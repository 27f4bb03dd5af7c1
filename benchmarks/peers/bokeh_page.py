"""Bokeh: a page with a slider and the four-square flower, whose data alone are sent anew.

python -m bokeh serve benchmarks/peers/bokeh_page.py
"""

from __future__ import annotations

from typing import Any

from bokeh.io import curdoc
from bokeh.layouts import column
from bokeh.models import ColumnDataSource, Slider
from bokeh.plotting import figure

from benchmarks.peers.flower import four_square

SIDE = 280.0


def columns(petal: float) -> dict[str, Any]:
    """Return the curves as Bokeh's patches want them."""
    curves = four_square(0.7, SIDE, petal)
    return {"xs": [each[:, 0] for each in curves], "ys": [each[:, 1] for each in curves]}


source = ColumnDataSource(columns(0.9), name="flower")
slider = Slider(start=0.7, end=1.1, value=0.9, step=0.002, title="petal", name="petal")


def turned(_name: str, _old: float, new: float) -> None:
    """Draw the flower that the slider asks for."""
    source.data = columns(new)


slider.on_change("value", turned)
page = figure(width=800, height=800, x_range=(0, SIDE), y_range=(0, SIDE), background_fill_color="#1d2f5f")
page.patches("xs", "ys", source=source, fill_color="#f4efe2", line_color="#1d2f5f")
curdoc().add_root(column(slider, page))
