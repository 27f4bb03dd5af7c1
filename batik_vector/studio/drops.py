"""Files from outside become drafts: recipes, files compiled from one, and drawings that become motifs.

They are read as what strangers sent: in a process of their own, by the readers that the command has, which
bound what they read and refuse entities.
"""

from __future__ import annotations

import re
import tempfile
from dataclasses import replace
from pathlib import Path

from batik_vector.drafting.ink_names import ink_names
from batik_vector.errors import BatikError, Fault, RecipeError
from batik_vector.recipe.drawing import Svg
from batik_vector.studio.changes import pasted
from batik_vector.studio.drafts import Draft
from batik_vector.studio.offers import free_name
from batik_vector.studio.parameters import panels

READ = (".toml", ".svg", ".pdf", ".dxf", ".hpgl", ".gcode", ".png")
PATIENCE = 30.0
"""Seconds that a file may take to be read."""
MOTIF_NOW = "is a motif now"
"""How is told that a drawing has become one."""
_ODD = re.compile(r"[^A-Za-z0-9]+")


def taken_in(draft: Draft, name: str, data: bytes) -> tuple[Draft, str]:
    """Return what a file that was dropped makes of a draft, and in words what that was.

    Args:
        draft: that is open.
        name: of the file, as its sender says.
        data: what is in it.

    Raises:
        BatikError: saying what about the file is wrong.
    """
    base = name.replace("\\", "/").rpartition("/")[2]
    stem, suffix = (_plain(base.rpartition(".")[0] or base), Path(base).suffix.lower())
    if suffix not in READ:
        raise RecipeError(f'"{base[:60]}": expected a recipe, a file compiled from one, or an SVG drawing')
    with tempfile.TemporaryDirectory(prefix="batik-") as folder:
        # The sender's name goes no further than its ending.
        path = Path(folder) / f"{stem}{suffix}"
        path.write_bytes(data)
        try:
            found = replace(Draft.read(path), folder=None)
        except BatikError:
            if suffix != ".svg":
                raise
            found = None
    if found is None:
        return with_motif(draft, stem, data), f"{base} {MOTIF_NOW}"
    if not found.tables:
        raise RecipeError(f"{base}: there is nothing in it")
    made, fresh = pasted(draft, found.whole)
    if fresh:
        return made, f"{base} was put in"
    return replace(made, stem=stem, folder=None), f"{base} opened"


def with_motif(draft: Draft, stem: str, data: bytes) -> Draft:
    """Return a draft with a drawing as a motif, placed in the middle of the tile.

    Of a drawing of several colours each is an ink, which is added where the recipe has none of that colour.

    Raises:
        RecipeError: where the drawing cannot be a motif, saying why.
    """
    try:
        svg = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise RecipeError(f"{stem}.svg is no text in UTF-8") from error
    file = f"{free_name(stem, {Path(each).stem for each, _ in draft.drawings})}.svg"
    motif = free_name(stem, draft.tables.get("motif", {}))
    made = draft.with_drawing(file, svg).inserted(("motif", motif), {"kind": "svg", "file": file})
    groups = [group for panel in panels(made) for group in panel.groups if group.path == "place"]
    offer = next((each for group in groups for each in group.offers if each.label == motif), None)
    coloured = _coloured(made, motif)
    if offer is not None:
        value = dict(offer.value)
        if coloured is not made:
            value.pop("ink", None)
        made = coloured.inserted(offer.path, value)
    if faults := made.faults:
        # What was wrong before is not the drawing's fault; and who dropped it knows of no line of the recipe.
        fresh = [Fault(each.message) for each in faults if each not in draft.faults]
        if fresh:
            raise RecipeError(fresh)
    return made


def _coloured(draft: Draft, motif: str) -> Draft:
    """Return a draft with the colours of a drawing as inks, where it has several."""
    if draft.faults:
        return draft
    drawn = draft.recipe.motif[motif]
    colours = replace(drawn, colours=True).colours_kept() if isinstance(drawn, Svg) else ()
    if len(colours) < 2:
        return draft
    inks = draft.recipe.ink
    known = {(each.drawn or each.colour).lower() for each in inks.values()}
    fresh = [each for each in colours if each.lower() not in known]
    made = draft.with_value(("motif", motif, "colours"), True)
    for name, colour in zip(ink_names(fresh), fresh, strict=True):
        # What it is called in the drawing stays, so that the ink may take another colour.
        ink = {"colour": colour, "drawn": colour}
        made = made.inserted(("ink", free_name(name, made.tables.get("ink", {}))), ink)
    return made


def _plain(name: str) -> str:
    return _ODD.sub("-", name).strip("-").lower()[:40] or "drawing"
