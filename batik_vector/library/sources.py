"""``library:NAME`` as the source of a recipe: what :func:`batik_vector.load_recipe` asks for it."""

from __future__ import annotations

from batik_vector import LibraryError
from batik_vector.library.store import Library


def fetched(name: str, source: str) -> tuple[str, dict[str, str]]:
    """Return the text of a version, and its drawings by the names of their files.

    Args:
        name: kawung, or kawung@3.
        source: the whole, as errors name it.

    Raises:
        LibraryError: where there is none.
    """
    if not name.strip():
        raise LibraryError(f'"{source}": expected the name of a pattern, such as library:sample/kawung')
    with Library(write=False) as library:
        version = library.version(name)
    return version.text, dict(version.drawings)
