"""Maps of the plane: the catalogue. A new variation is a file beside this one, and a line below."""

from __future__ import annotations

from batik_vector.geometry.maps.affine import Affine, Complexes
from batik_vector.geometry.maps.base import Variation
from batik_vector.geometry.maps.bent import Bent
from batik_vector.geometry.maps.flame import FlameMap
from batik_vector.geometry.maps.julian import JuliaN
from batik_vector.geometry.maps.linear import Linear
from batik_vector.geometry.maps.sinusoidal import Sinusoidal
from batik_vector.geometry.maps.spherical import Spherical
from batik_vector.geometry.maps.swirl import Swirl
from batik_vector.geometry.sampling import Geometries

VARIATIONS: dict[str, type[Variation]] = {
    "linear": Linear,
    "julian": JuliaN,
    "spherical": Spherical,
    "swirl": Swirl,
    "sinusoidal": Sinusoidal,
    "bent": Bent,
}

__all__ = [
    "VARIATIONS",
    "Affine",
    "Bent",
    "Complexes",
    "FlameMap",
    "Geometries",
    "JuliaN",
    "Linear",
    "Sinusoidal",
    "Spherical",
    "Swirl",
    "Variation",
]
