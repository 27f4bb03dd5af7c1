"""Plain drawings to be made batik, as people have them, and some that are unfit for it."""

from __future__ import annotations

_HEAD = (
    '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
    'xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" viewBox="0 0 120 120" '
    'width="120" height="120">'
)


def svg(body: str) -> bytes:
    """Return a drawing of 120 px."""
    return f"{_HEAD}{body}</svg>".encode()


BIRD = svg(
    '<path id="tail" d="M12 80C3 66 0 50 8 40C12 56 24 64 44 68Z" fill="#d9a441"/>'
    '<path d="M36 70C44 44 72 34 96 44C114 52 114 74 100 84C82 96 50 94 36 70Z" fill="#8a3b22" '
    'stroke="#000" stroke-width="1"/>'
    '<path inkscape:label="wing" id="path7" d="M50 64C58 52 80 50 94 56C88 72 70 82 54 76Z" fill="#f4e6c0"/>'
    '<circle cx="104" cy="40" r="15" fill="#d9a441"/><path d="M117 36L120 41L116 46Z" fill="#222"/>'
    '<path id="leg" d="M70 90L66 110M82 90L84 110" fill="none" stroke="#222" stroke-width="2"/>'
)
FISH = svg(
    '<g inkscape:groupmode="layer" transform="translate(2 10) scale(.9)">'
    '<path style="fill:#3b7ea1;stroke:#112233" d="M10 50C25 20 70 15 95 50C70 85 25 80 10 50Z"/>'
    '<path style="fill:#e07b39" d="M90 50L118 25C112 45 112 55 118 75Z"/>'
    '<circle cx="27" cy="46" r="5" style="fill:#fff;stroke:#000"/>'
    '<path style="fill:none;stroke:#112233" d="M36 38C42 46 42 56 36 64"/></g>'
)
NESTED = svg(
    '<defs><path id="petal" d="M0 0C8 -8 8 -26 0 -34C-8 -26 -8 -8 0 0Z"/></defs>'
    '<g transform="translate(60 60) scale(1.3)">'
    + "".join(
        f'<g transform="rotate({45 * turn})">'
        f'<use xlink:href="#petal" fill="{("#e7b84f", "#c0392f")[turn % 2]}"/>'
        '<circle cy="-34" r="3" fill="#27467e" transform="skewX(10)"/></g>'
        for turn in range(8)
    )
    + '<circle r="9" fill="#f3e7cf"/></g>'
)
HOUSE = svg(
    '<g fill="none" stroke="#000" stroke-width=".8"><path d="M20 60V110H100V60"/>'
    '<path d="M12 62L60 18L108 62Z"/>'
    '<rect x="32" y="72" width="18" height="18"/><path d="M32 81H50M41 72V90"/>'
    '<path d="M66 110V80C66 72 82 72 82 80V110"/><path d="M80 36V20H92V47"/></g>'
)
"""Lines alone; the chimney stands a third of a unit off the roof."""
LETTER = svg(
    '<g fill="none" stroke="#000" stroke-width="9" stroke-linecap="round"><path d="M25 105L60 15L95 105"/>'
    '<path d="M40 72H80"/></g>'
)
"""Broad strokes."""
SILHOUETTE = svg(
    '<path d="M20 110C10 70 30 60 40 50C30 30 45 10 60 25C75 10 90 30 80 50C95 60 110 70 100 110'
    'C90 100 30 100 20 110ZM50 45A5 5 0 1 0 60 45A5 5 0 1 0 50 45Z"/>'
)
CRUMBS = svg(
    "".join(
        f'<circle cx="{8 + 37 * k % 104}" cy="{8 + 61 * k % 103}" r="{(0.2, 0.5, 1.2, 3, 8)[k % 5]}" '
        f'fill="{("#c33", "#36c", "#3a6")[k % 3]}"/>'
        for k in range(60)
    )
)
GOOD = {
    "bird": BIRD,
    "fish": FISH,
    "nested": NESTED,
    "house": HOUSE,
    "letter": LETTER,
    "silhouette": SILHOUETTE,
    "crumbs": CRUMBS,
}

UNFIT = {
    "open lines": (
        svg('<path fill="none" stroke="#000" d="M10 10C40 60 80 0 110 50M10 90L110 95"/>'),
        "no closed region",
    ),
    "a picture": (
        svg('<image width="9" height="9" xlink:href="data:image/png;base64,iVBORw0="/>'),
        "trace it",
    ),
    "text": (svg("<text>Batik</text>"), "convert it to outlines"),
    "entities": (
        b'<!DOCTYPE svg [<!ENTITY a "aa"><!ENTITY b "&a;&a;">]><svg xmlns="http://www.w3.org/2000/svg">&b;</svg>',
        'declares or uses the entity "a"',
    ),
    "nothing": (svg(""), "nothing is drawn"),
    "a point": (svg('<path d="M5 5L5 5Z"/>'), "lies in one point"),
    "too many nodes": (
        svg('<path d="M0 0' + "".join(f"L{k % 997} {k % 787}" for k in range(200_000)) + 'Z"/>'),
        "200,001 nodes, expected at most 200,000",
    ),
    "a scribble": (
        svg(
            '<path d="M0 0'
            + "".join(f"L{k * 37.7 % 120:.1f} {k * 91.3 % 120:.1f}" for k in range(9000))
            + 'Z"/>'
        ),
        "cross about",
    ),
    "a mosaic": (
        svg('<path d="' + "".join(f"M{k % 90} {k // 90}h.8v.8h-.8z" for k in range(4500)) + '"/>'),
        "4,500 regions: a picture and no drawing",
    ),
}
"""Each with what is said of it."""
