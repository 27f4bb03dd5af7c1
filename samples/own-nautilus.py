"""Nautilus: a shell cut open, chamber after chamber, each the last one grown and turned.

One function of t draws a chamber: a rounded box in logarithmic polar coordinates, where to grow is to move.
Thirty-four of them, each turned by 17° and larger by a twentieth, are the shell, and a long one is where the
animal lives. Shells of both senses and two sizes turn over one another among stars in a lagoon; rows of
dots follow all of them.

To vary it: GROWTH (how much wider a turn is than the one before), STEP, and the power in ``rounded``.
"""

import numpy as np

from batik_vector import ClothSpec, Element, InkSpec, Placement, Recipe, Rosette, TileSpec
from batik_vector.geometry.curves import Blade, Circle, Curve
from batik_vector.recipe.fills import Cecek
from batik_vector.tiling.layouts import FreeGround, Toss

GROWTH = np.log(3) / (2 * np.pi)
STEP = np.radians(17)
CHAMBERS = 34
DOTS = Cecek(follow="contour", spacing=2.2, width=0.9, margin=0.8, rows=2)


def rounded(t, power=0.55):
    """A square with round corners, x and y in [-1, 1]; t runs over [0, 1]."""
    turn = np.exp(2j * np.pi * t)
    return [np.sign(part) * np.abs(part) ** power for part in (turn.real, turn.imag)]


def chamber(t, angle, span):
    """The chamber from one angle on, as complex numbers: its walls bulge back towards the shell's heart."""
    along, across = rounded(t)
    turn = angle + span * (0.5 + 0.44 * along) - 0.2 * (1 - across**2)
    reach = -0.56 + 0.44 * across
    return 46 * np.exp(GROWTH * turn + reach + 1j * turn)


def drawn(angle, span, **look):
    """A chamber with its look."""
    return Element(curve=Curve.from_function(lambda t: chamber(t, angle, span)), **look)


first = -STEP * CHAMBERS
shell = [drawn(first + k * STEP, STEP, name="chamber", ink="cotton") for k in range(CHAMBERS)]
shell.append(drawn(0.05, 1.8, name="home", ink="ochre", fill_with=DOTS))
shell += [drawn(angle, 0.07, name="growth", treatment="cut") for angle in (0.62, 0.98, 1.30, 1.56)]


def ring(size, ink):
    """A bubble."""
    return Rosette(
        elements=[
            Element(curve=Circle(size), name="bubble", ink=ink),
            Element(curve=Circle(0.55 * size), name="bubble", treatment="cut"),
        ]
    )


star = Rosette(
    elements=[
        Element(
            curve=Blade(length=8.5, width=3.2, base=0.7, tip=0.9),
            count=5,
            turn=90,
            name="arm",
            ink="ochre",
            fill_with=Cecek(follow="axis", spacing=1.6, width=0.7, margin=0.5),
        ),
        Element(curve=Circle(1.5), name="heart", ink="cotton", gap=0.7),
    ]
)

recipe = Recipe(
    title="Nautilus",
    cloth=ClothSpec(colour="#143642"),
    ink={
        "cotton": InkSpec(colour="#f2ead8"),
        "ochre": InkSpec(colour="#d99a4e"),
        "ripple": InkSpec(colour="#5b9a94"),
    },
    motif={
        "shell": Rosette(elements=shell),
        "star": star,
        "bubble": ring(1.6, "cotton"),
        "pearl": ring(1.2, "ochre"),
    },
    place=[
        Placement(motif="shell", scale=0.68, at=(28.0, 26.0), turn=20),
        Placement(
            motif="shell", scale=0.24, layout=Toss(distance=1.5, clear="all", count=1, tries=30, settle=0)
        ),
        Placement(
            motif="star", scale=0.85, layout=Toss(distance=1.6, clear="all", count=2, tries=30, settle=0)
        ),
        Placement(
            motif=["bubble", "pearl"],
            scale=1,
            layout=Toss(distance=2, clear="all", count=4, tries=20, settle=0),
        ),
        Placement(
            ink="ripple",
            layout=FreeGround(),
            fill_with=Cecek(follow="contour", spacing=1.9, width=0.8, margin=0.9),
        ),
    ],
    tile=TileSpec(size=(114.0, 116.0), repeat="pgg"),
)
