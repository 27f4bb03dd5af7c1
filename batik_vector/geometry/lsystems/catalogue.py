"""The named L-systems, each with the place that it was published in."""

from __future__ import annotations

from types import MappingProxyType

from batik_vector.values import frozen

ABOP = "Prusinkiewicz & Lindenmayer, The Algorithmic Beauty of Plants (1990)"
KOLAM = "Prusinkiewicz & Hanan, Lindenmayer Systems, Fractals, and Plants (1989)"


@frozen
class Named:
    """An L-system under its name: its words, how its turtle turns, and the level at which it shows well."""

    axiom: str
    rules: tuple[str, ...]
    angle: float
    source: str
    level: int
    heading: float = 0.0
    draws: str = "F"


NAMED = MappingProxyType(
    {
        "koch-curve": Named("F", ("F -> F+F--F+F",), 60, "von Koch (1904)", 4),
        "koch-snowflake": Named("F--F--F", ("F -> F+F--F+F",), 60, "von Koch (1904)", 3),
        "koch-island": Named("F-F-F-F", ("F -> F-F+F+FF-F-F+F",), 90, f"{ABOP}, Fig. 1.6", 2),
        "sierpinski-arrowhead": Named(
            "A", ("A -> B-A-B", "B -> A+B+A"), 60, f"Sierpiński (1915); {ABOP}, Fig. 1.10b", 6, draws="AB"
        ),
        "dragon": Named(
            "A", ("A -> A+B", "B -> A-B"), 90, f"Davis & Knuth (1970); {ABOP}, Fig. 1.10a", 10, draws="AB"
        ),
        "hilbert": Named(
            "X", ("X -> -YF+XFX+FY-", "Y -> +XF-YFY-FX+"), 90, f"Hilbert (1891); {ABOP}, §1.4.2", 4
        ),
        "gosper": Named(
            "A",
            ("A -> A-B--B+A++AA+B-", "B -> +A-BB--B-A++A+B"),
            60,
            f"Gosper, in Gardner (1976); {ABOP}, Fig. 1.11a",
            3,
            draws="AB",
        ),
        "levy": Named("F", ("F -> +F--F+",), 45, "Lévy (1938)", 10),
        "plant-weed": Named("F", ("F -> F[+F]F[-F]F",), 25.7, f"{ABOP}, Fig. 1.24a", 4, 90),
        "plant-bush": Named("F", ("F -> FF-[-F+F+F]+[+F-F-F]",), 22.5, f"{ABOP}, Fig. 1.24c", 3, 90),
        "plant-spray": Named("X", ("X -> F[+X]F[-X]+X", "F -> FF"), 20, f"{ABOP}, Fig. 1.24d", 5, 90),
        "plant-fern": Named("X", ("X -> F-[[X]+X]+F[+FX]-X", "F -> FF"), 22.5, f"{ABOP}, Fig. 1.24f", 5, 90),
        "kolam-snake": Named("F+XF+F+XF", ("X -> XF-F-F+XF+F+XF-F-F+X",), 90, f"the snake; {KOLAM}", 2),
        "kolam-anklets": Named("-X--X", ("X -> XFX--XFX",), 45, f"Krishna's anklets; {KOLAM}", 4),
    }
)
"""Koch's curves, space-filling ones, dragons, plants and kolam, by name."""
