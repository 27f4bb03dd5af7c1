"""Work sheets: what a workshop does with a cloth, step by step, each with its picture, on pages to print."""

from __future__ import annotations

from collections.abc import Iterator

from batik_vector.artwork import Artwork, Page, dyeing_of
from batik_vector.making.sheets import Entry, Plan, pages, plan
from batik_vector.making.thumbnails import thumbnail
from batik_vector.processes.options import WaxProcess
from batik_vector.processes.wax import stages
from batik_vector.processes.waxing.cantings import drawn_by
from batik_vector.processes.waxing.planning import Doing, Step
from batik_vector.units import format_mm

MOST_BATHS = 6
"""Baths that the head of a sheet names."""


def worksheet(page: Page, spec: WaxProcess, paper: str) -> tuple[Iterator[str], Plan]:
    """Return the pages of a work sheet as SVG, and how they are laid out.

    Args:
        page: the design, which knows its baths.
        spec: how it is waxed.
        paper: a name of :data:`batik_vector.making.sheets.PAPERS`.

    Raises:
        RecipeError: where there is no such paper.
        GeometryError: where the page says of no baths, or cannot be dyed so.
    """
    steps = stages(page, spec)
    entries = [Entry(thumbnail(picture), tuple(_caption(step, picture, spec))) for step, picture in steps]
    lines = max(len(each.caption) for each in entries)
    layout = plan(len(entries), page.cell.height / page.cell.width, lines, paper)
    return pages(iter(entries), len(entries), layout, page.title, _about(page, spec)), layout


def _about(page: Page, spec: WaxProcess) -> list[str]:
    dyeing = dyeing_of(page)
    assert dyeing is not None
    baths = [f"{bath.name} {bath.colour}" for bath in dyeing.baths]
    more = f" and {len(baths) - MOST_BATHS} more" if len(baths) > MOST_BATHS else ""
    spouts = [f"{name} {format_mm(spout)} mm" for name, spout in spec.cantings.items()]
    size = f"{format_mm(page.cell.width)} × {format_mm(page.cell.height)} mm"
    return [
        f"baths: {', then '.join(baths[:MOST_BATHS])}{more}, on cloth {dyeing.undyed}",
        f"{size}; cantings: {', '.join(spouts) or 'none named'}",
    ]


def _caption(step: Step, picture: Artwork, spec: WaxProcess) -> Iterator[str]:
    if step.doing not in (Doing.WAX, Doing.SCRAPE):
        yield "lorod: boil all wax out" if step.doing is Doing.BOIL else f"bath: {step.bath}"
        return
    (layer,) = picture.layers
    what = "scrape off" if step.doing is Doing.SCRAPE else "strong wax" if step.stays else "soft wax"
    # The number is that of the plate's file.
    yield f"{layer.ink.name.replace('-', ' ')}: {what}"
    area = sum(each.area for each in layer.areas) / 100
    covers = 10_000 * area / (picture.cell.width * picture.cell.height)
    yield f"{area:,.1f} cm², {covers:.1f} % of the cloth"
    if step.doing is Doing.SCRAPE:
        return
    told = drawn_by(picture, layer.areas, spec.cantings, spec.multi_spouts)
    for each in told["cantings"]:
        if each["metres"] >= 0.001:
            yield f"{each['canting']} {format_mm(each['spout_mm'])} mm: {each['metres']:,.2f} m"
        saved = each.get("at_once", {})
        if saved.get("metres_saved") or saved.get("dots_saved"):
            less = f"{saved['metres_saved']:,.2f} m and {saved['dots_saved']:,} dots"
            yield f"{saved['spouts']} spouts at once save {less}"
    if told["dots"]:
        yield f"{told['dots']:,} dots among them"
