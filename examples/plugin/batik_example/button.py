"""The button: a scalloped disc with its holes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field
from typing import Annotated

from batik_example.scallop import Scallop

from batik_vector.fields import Between, Says, Useful
from batik_vector.geometry.curves import Circle
from batik_vector.recipe.look import Dress
from batik_vector.recipe.motifs.composing import Composed, Isen, Keyed, part
from batik_vector.values import frozen


@frozen(kw_only=True)
class Button(Composed):
    """A sewn-on button: a scalloped disc, and holes that are cut out or drawn."""

    lobes: Annotated[int, Between(3, 200), Useful(6, 24), Says("bows of its edge")] = 14
    holes: Annotated[int, Between(1, 12), Says("holes round its middle")] = 4
    disc: Annotated[Dress, Says("look of the disc")] = field(default_factory=Dress)
    hole: Annotated[Isen, Says("look of the holes: bare unless it names an ink")] = field(
        default_factory=Isen
    )

    def compose(self) -> Iterator[Keyed]:
        """Yield the disc, then the holes."""
        yield part("disc", self.disc, Scallop(self.lobes, 0.12, 1.0))
        yield part("hole", self.hole, Circle(0.14), count=self.holes, radius=0.36, turn=45.0)
