"""Profiles of presses that a recipe's outputs name: ICC files beside the recipe.

They are large, and no compiled file carries them: it compiles without, but for the outputs that name one.
"""

from __future__ import annotations

from dataclasses import replace

from batik_vector.errors import ExportError, Fault, RecipeError
from batik_vector.recipe.model import Recipe
from batik_vector.recipe.outputs import PdfOutput
from batik_vector.recipe.reading.beside import Kind, read_beside

ICC_FILE = Kind("an ICC profile", ".icc", "press.icc")
MOST = 16_000_000
"""Bytes; those of presses have up to three million."""


def with_presses(recipe: Recipe, folder: str | None) -> Recipe:
    """Return a recipe with the profiles of its outputs' presses read.

    Args:
        recipe: read, the profiles not yet.
        folder: where it stands; None where it stands nowhere, and they are left unread.

    Raises:
        RecipeError: with the keys of all that is wrong.
    """
    if folder is None:
        return recipe
    from batik_vector.export.pdf.icc import icc_profile

    faults: list[Fault] = []
    outputs = []
    for number, output in enumerate(recipe.output):
        if isinstance(output, PdfOutput) and output.icc and output.icc_profile is None:
            try:
                data, _ = read_beside(output.icc, folder, ICC_FILE, MOST)
                icc_profile(data)
                output = replace(output, icc_profile=data)
            except RecipeError as error:
                faults += [Fault(each.message, f"output[{number}].icc") for each in error.faults]
            except ExportError as error:
                faults.append(Fault(f'"{output.icc}" {error}', f"output[{number}].icc"))
        outputs.append(output)
    if faults:
        raise RecipeError(faults)
    return replace(recipe, output=tuple(outputs))
