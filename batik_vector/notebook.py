"""Patterns in a notebook: an artwork shows itself, and :func:`interact` gives a recipe sliders.

from batik_vector.notebook import interact

pattern = interact("kawung.toml", "tolerance", "place[0].width")
pattern.recipe          # as the sliders stand
pattern.artwork         # what is shown, as a value: write_artwork takes it
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from typing import Any

from batik_vector import Artwork, Recipe, compile_recipe
from batik_vector.errors import BatikError, MissingLibraryError, RecipeError, UnknownNameError
from batik_vector.studio.drafts import Draft
from batik_vector.studio.parameters import Control, panels

MOST_NUMBERS, MOST_COLOURS = 5, 4
"""Controls that are offered where none is named."""
KINDS = ("number", "whole", "switch", "choice", "colour")
"""Kinds of controls that there are widgets for."""


class Interactive:
    """A recipe with its controls, as a notebook shows it.

    ``recipe`` and ``artwork`` are the last that compiled; what is wrong is told below the controls.
    """

    def __init__(self, draft: Draft, keys: tuple[str, ...], widgets: Any) -> None:
        self._draft = draft
        self._widgets = widgets
        self._picture, self._told = widgets.HTML(), widgets.HTML()
        controls = [self._control(each) for each in _chosen(draft, keys)]
        self.box = widgets.HBox([widgets.VBox([*controls, self._told]), self._picture])
        self._compile(draft)

    @property
    def text(self) -> str:
        """The recipe as TOML, as the controls stand."""
        return self._draft.text

    def _compile(self, draft: Draft) -> None:
        self.recipe: Recipe = draft.recipe
        self.artwork: Artwork = compile_recipe(self.recipe)
        self._picture.value = f'<div style="width:30em">{_fitted(self.artwork._repr_svg_())}</div>'

    def _control(self, control: Control) -> Any:
        widget = _widget(control, self._widgets)
        widget.observe(self._setter(control.path), names="value")
        return widget

    def _setter(self, path: str) -> Callable[[Any], None]:
        def changed(change: Any) -> None:
            try:
                self._draft = self._draft.with_value(path, change["new"])
                self._compile(self._draft)
                self._told.value = ""
            except BatikError as error:
                self._told.value = f"<pre>{_escaped(str(error))}</pre>"

        return changed

    def _repr_mimebundle_(self, **wishes: Any) -> Any:
        """Show the controls and the tile in a notebook."""
        return self.box._repr_mimebundle_(**wishes)


def interact(recipe: str | os.PathLike[str] | Recipe, *keys: str) -> Interactive:
    """Return a recipe with a control for each of some keys, and its tile, drawn anew as they are moved.

    Args:
        recipe: a recipe, or where one is read: a file, one compiled from it, ``library:NAME``.
        keys: such as ``"motif.flower.petal.count"``; the first that the recipe sets when left out.

    Raises:
        MissingLibraryError: without ipywidgets.
        RecipeError: where the recipe is wrong.
        UnknownNameError: where a key has no control.
    """
    try:
        import ipywidgets
    except ImportError as error:
        raise MissingLibraryError(
            "sliders need ipywidgets, which is not installed: pip install 'batik-vector[notebook]'"
        ) from error
    draft = Draft.of_text(recipe.source) if isinstance(recipe, Recipe) else Draft.read(recipe)
    if draft.faults:
        raise RecipeError(draft.faults)
    return Interactive(draft, keys, ipywidgets)


def _chosen(draft: Draft, keys: tuple[str, ...]) -> Iterator[Control]:
    """Yield the controls of keys, or the first that the recipe sets."""
    controls = [
        each for panel in panels(draft, ()) for group in panel.groups for each in group.all_controls()
    ]
    known = {each.path: each for each in controls if each.kind in KINDS}
    for key in keys:
        if key not in known:
            raise UnknownNameError(key, list(known), "key with a control")
        yield known[key]
    if not keys:
        said = [each for each in known.values() if each.is_set and each.value is not None]
        numbers = [each for each in said if each.kind in ("number", "whole")]
        yield from sorted(numbers, key=lambda each: each.useful is None)[:MOST_NUMBERS]
        yield from [each for each in said if each.kind == "colour"][:MOST_COLOURS]


def _widget(control: Control, widgets: Any) -> Any:
    """Return the widget of a control."""
    value = control.default if control.value is None else control.value
    words = {
        "description": control.path.rpartition("motif.")[2],
        "tooltip": control.help,
        "style": {"description_width": "14em"},
        "layout": {"width": "28em"},
    }
    if control.kind == "switch":
        return widgets.Checkbox(value=bool(value), **words)
    if control.kind == "colour":
        return widgets.ColorPicker(value=value, **words)
    if control.kind == "choice":
        return widgets.Dropdown(options=control.choices, value=value, **words)
    assert control.span is not None
    low, high = control.span
    if value is None:
        value = low
    # What is dragged would be compiled at every step.
    slider = {"min": low, "max": high, "step": control.step, "continuous_update": False}
    if control.kind == "whole":
        return widgets.IntSlider(value=int(value), **{**slider, "min": int(low), "max": int(high)}, **words)
    return widgets.FloatSlider(value=value, readout_format=".4g", **slider, **words)


def _fitted(svg: str) -> str:
    """Return an SVG as broad as what is around it, without what stands before its root."""
    root = svg[svg.index("<svg") :]
    return root.replace("<svg", '<svg style="width:100%;height:auto"', 1)


def _escaped(text: str) -> str:
    return text.replace("&", "&amp;").replace("<", "&lt;")
