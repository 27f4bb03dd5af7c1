"""Views of a draft: the tile, a field of it, the cloth, or the cloth on a cushion or a shirt, as SVG.

What is shown is what the SVG writer writes of what the compiler makes, coarser than files are by as much as a
screen cannot show. It happens here, in the process that calls; :mod:`~batik_vector.studio.pictures` has
another process do it.
"""

from __future__ import annotations

import functools
import re
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import field, replace
from pathlib import Path
from typing import Any

from batik_vector.artwork import Artwork, Page
from batik_vector.compiling.compiler import compile_cloth, compile_recipe
from batik_vector.compiling.foretelling import foretold
from batik_vector.errors import BatikError, Fault, RecipeError, TooLargeError
from batik_vector.export.svg import svg_text
from batik_vector.making.facts import facts_of, warnings
from batik_vector.making.promised import asked_group
from batik_vector.recipe.loading import located, read_recipe
from batik_vector.recipe.model import Recipe, YardageSpec
from batik_vector.studio.asking import SCREEN
from batik_vector.studio.asking import View as View
from batik_vector.studio.drafts import Draft
from batik_vector.studio.draping import FORMS, SHOWN, draped, flat, too_fine
from batik_vector.studio.motif_alone import alone, cropped
from batik_vector.tiling.cloth.field import field_page
from batik_vector.tiling.tossing.falls import Falls
from batik_vector.units import format_mm
from batik_vector.values import frozen

METRE = 1000.0
SHARP = 2000.0
"""Parts of a form's side to which edges on it are true."""
FINE, ROUGH = 2000.0, 300.0
"""Parts of what is shown to which its edges are true: half a pixel of a large window, and some pixels."""
FINER = 4.0
"""How many times finer than need be a tile may be that is at hand, and still serve another view."""
WARM = Path(__file__).parents[1] / "starters" / "four-square.toml"
"""Compiled at first, so that all is imported when somebody waits."""
LARGE_SHARE = 0.6
"""What effort takes in large recipes, of what it takes in the small one: measured on the samples."""
MOST_SHOWN = 1_500_000
"""Vertices of a picture that a browser still moves."""

_GROUND = re.compile(r"<polygon [^>]*/>")
_FILLED = re.compile(r'fill="(#[0-9a-f]{6})" fill-rule="[a-z]+"')
_STROKED = re.compile(r'fill="none" stroke="(#[0-9a-f]{6})" stroke-width="[0-9.]+"')


@frozen(eq=False)
class Shown:
    """What came of looking: a picture or faults, and what is known of it.

    Args:
        svg: the picture; empty where there are faults.
        facts: as ``compile --json`` reports them, and ``size_mm``, what the picture shows; ``warnings``;
            and the colour of the ``cloth``.
        verdict: as ``check --json`` reports it; empty where it was not asked for. With ``View.floor`` also
            ``lack``, what the tile lacks as a variation, or nothing.
        faults: why there is no picture.
        seconds: that it took.
    """

    svg: str = ""
    facts: Mapping[str, Any] = field(default_factory=dict)
    verdict: Mapping[str, Any] = field(default_factory=dict)
    faults: tuple[Fault, ...] = ()
    seconds: float = 0.0


class Looker:
    """Makes views; the tile that was compiled last is kept, for another view of the same draft."""

    def __init__(self) -> None:
        self._known: tuple[Any, Recipe, Artwork | None, bool] | None = None
        self._falls = Falls()

    def look(self, draft: Draft, view: View, tell: Callable[[str], None] = lambda _: None) -> Shown:
        """Return what a view shows of a draft, or the faults that it has."""
        begun = time.perf_counter()
        try:
            shown = self._look(draft, view, tell)
        except RecipeError as error:
            shown = Shown(faults=located(error, draft.stem, draft.text).faults)
        except BatikError as error:
            shown = Shown(faults=(Fault(str(error), source=draft.stem),))
        except MemoryError:
            shown = Shown(faults=(Fault("this needs more memory than there is", source=draft.stem),))
        return replace(shown, seconds=time.perf_counter() - begun)

    def _look(self, draft: Draft, view: View, tell: Callable[[str], None]) -> Shown:
        if view.motif:
            whole = _read(draft, view)
            one = compile_recipe(alone(whole, view.motif))
            return Shown(cropped(svg_text(one, SHOWN), one))
        recipe, tile = self._compiled(draft, view, tell)
        if view.colourway:
            # No colour moves an edge: what is compiled is there in all of them.
            other = _read(draft, view)
            tile = None if tile is None else _in_colours_of(other, tile)
            recipe = replace(other, tolerance=recipe.tolerance)
        tell("drawing")
        verdict: Mapping[str, Any] = {}
        drawn = tile
        if tile is not None and (view.certify or view.pointers):
            from batik_vector.certificate import certify, pointers

            certificate = certify(tile, asked=asked_group(recipe))
            verdict = certificate.as_dict()
            if view.pointers and not certificate.passed:
                drawn = pointers(tile, certificate)
        if tile is not None and view.floor:
            from batik_vector.making.exploring import Floor

            verdict = {**verdict, "lack": Floor().fault(tile)}
        facts: dict[str, Any] = facts_of(tile, None)
        facts["warnings"] = warnings(recipe, tile) if tile is not None else []
        svg, size = self._drawn(recipe, drawn, view, tell)
        if view.look == "lines":
            svg = as_lines(svg, max(size) / 900)
        return Shown(svg, facts | {"size_mm": list(size), "cloth": recipe.cloth.colour}, verdict)

    def _compiled(
        self, draft: Draft, view: View, tell: Callable[[str], None]
    ) -> tuple[Recipe, Artwork | None]:
        key = draft.text, draft.folder, draft.drawings
        if self._known is None or self._known[0] != key:
            recipe = _read(draft, replace(view, colourway=""))
            self._known = key, recipe, None, False
        _, recipe, tile, rough = self._known
        # A sketch serves no other view, and need not be made twice.
        sketched = rough and not view.rough
        looked_at = replace(recipe, tolerance=max(recipe.tolerance, _tolerance(recipe, view)))
        # Somewhat finer than need be is sooner there than what is compiled anew.
        if sketched or tile is None or not tile.tolerance <= looked_at.tolerance <= FINER * tile.tolerance:
            with self._falls.sketched() if view.rough else self._falls.kept():
                tile = compile_recipe(looked_at, progress=tell) if recipe.tile is not None else None
        # What it names may change on the disk.
        self._known = None if recipe.drawing else (key, recipe, tile, view.rough)
        return looked_at, tile

    def _drawn(
        self, recipe: Recipe, tile: Artwork | None, view: View, tell: Callable[[str], None]
    ) -> tuple[str, tuple[float, float]]:
        """Return a picture and how much cloth it shows, in mm."""
        if view.kind == "yardage" or tile is None:
            page: Page = _cloth(recipe, tile, tell)
            if recipe.yardage is None and tile is not None and too_fine(page.vertex_count):
                return flat(tile, (METRE, METRE)), (METRE, METRE)
        elif view.kind in FORMS:
            return draped(tile, view.kind)
        elif view.kind == "tile":
            page = tile
        else:
            across, up = (3, 3) if view.kind == "three" else (view.across, view.up)
            page = field_page(tile, across, up)
        if page.vertex_count > MOST_SHOWN:
            raise TooLargeError(
                f"about {page.vertex_count:,} vertices, more than a page can show: look at the tile, or at "
                "fewer repeats"
            )
        return svg_text(page, SHOWN), (page.cell.width, page.cell.height)


def _read(draft: Draft, view: View) -> Recipe:
    """Return the recipe of a draft, in the colours that a view asks for."""

    def read(changes: Sequence[str] = ()) -> Recipe:
        return read_recipe(draft.text, draft.stem, changes, draft.folder, drawings=dict(draft.drawings))

    if not view.colourway:
        return read()
    from batik_vector.making.palettes import colourways_of, in_colourway

    recipe = read()
    (name,) = colourways_of(recipe, [view.colourway])
    return read(in_colourway(recipe, name))


def _in_colours_of(recipe: Recipe, tile: Artwork) -> Artwork:
    """Return a tile in the colours of a recipe that says the same of all else."""
    inks = {name: spec.named(name) for name, spec in recipe.ink.items()}
    layers = tuple(replace(layer, ink=inks[layer.ink.name]) for layer in tile.layers)
    provenance = replace(tile.provenance, recipe=recipe.source)
    return replace(
        tile, layers=layers, cloth=recipe.cloth.colour, dyeing=recipe.dyeing, provenance=provenance
    )


def as_lines(svg: str, width: float) -> str:
    """Return a picture as its outlines alone, thin, on bare ground.

    Args:
        svg: as our SVG writer writes it.
        width: of the lines, in mm.
    """
    breadth = format_mm(max(width, 0.01))
    svg = _GROUND.sub("", svg, count=1)
    drawn = rf'fill="none" stroke="\1" stroke-width="{breadth}"'
    return _FILLED.sub(drawn, _STROKED.sub(drawn, svg))


def foreseen(draft: Draft, view: View) -> tuple[int, float]:
    """Return about how many vertices a view's tile will have, and how many seconds it will take here and now.

    Nothing is compiled but, once in a process, a small recipe by which the machine's pace is known.

    Raises:
        BatikError: where the draft cannot be read.
    """
    recipe = _read(draft, view)
    ahead = foretold(replace(recipe, tolerance=max(recipe.tolerance, _tolerance(recipe, view))))
    return ahead.vertices, ahead.effort * _pace()


@functools.cache
def _pace() -> float:
    """Return about how many seconds a unit of effort takes."""
    recipe = replace(read_recipe(WARM.read_text("utf-8")), tolerance=SCREEN)
    compile_recipe(recipe)
    # Slightly another one, for what is made of the same shapes is remembered.
    other = replace(recipe, tolerance=0.8 * SCREEN)
    begun = time.perf_counter()
    compile_recipe(other)
    return LARGE_SHARE * (time.perf_counter() - begun) / max(foretold(other).effort, 1.0)


def _tiles(view: View) -> int:
    """Return how many tiles lie side by side in a view; 0 where the tile is not what is looked at."""
    return {"tile": 1, "three": 3, "field": max(view.across, view.up)}.get(view.kind, 0)


def _tolerance(recipe: Recipe, view: View) -> float:
    """Return how far edges may be off: what a screen cannot show, or what a moment does not."""
    if view.kind in FORMS:
        # On a form half a millimetre is less than a pixel.
        return max(view.tolerance, max(FORMS[view.kind].size) / SHARP)
    if recipe.tile is None or not (count := _tiles(view)):
        return view.tolerance
    side = count * max(recipe.tiling.cell().width, recipe.tiling.cell().height)
    return max(view.tolerance, side / ROUGH) if view.rough else min(view.tolerance, side / FINE)


def _cloth(recipe: Recipe, tile: Artwork | None, tell: Callable[[str], None]) -> Page:
    """Return a recipe's cloth; where it says of none how large it is, a square metre."""
    if recipe.yardage is None:
        recipe = replace(recipe, yardage=YardageSpec(width=METRE, length=METRE))
    return compile_cloth(recipe, tile=tile, progress=tell)
