"""What patterns are called, and how one of their versions is asked for."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Sequence

from batik_vector import LibraryError

LONGEST_NAME, LONGEST_TAG = 80, 40
"""Characters of a name and of a tag."""
_NAME = re.compile(r"\w[\w .,()+-]*")
_TAG = re.compile(r"\w[\w .+-]*")
_RESERVED = re.compile(r"(con|prn|aux|nul|com\d|lpt\d)(\..*)?", re.IGNORECASE)
"""What Windows takes for a device. A name becomes a file's when the pattern is exported."""
_WITHOUT_MARKS = str.maketrans(
    {"đ": "d", "ð": "d", "ħ": "h", "ı": "i", "ł": "l", "ø": "o", "ŧ": "t", "þ": "th", "æ": "ae", "œ": "oe"}
)
"""Letters that Unicode does not take apart into a letter and a mark."""


def folded(text: str) -> str:
    """Return text as it is compared and searched: without case, accents and control characters."""
    plain = unicodedata.normalize("NFKD", text).casefold()
    kept = (each for each in plain if not unicodedata.combining(each))
    return unicodedata.normalize(
        "NFC", "".join(each if each.isprintable() else " " for each in kept)
    ).translate(_WITHOUT_MARKS)


def checked_name(name: str) -> str:
    """Return a name that a pattern may have: in NFC, and without blanks round it.

    Raises:
        LibraryError: where it could not be a file's.
    """
    name = unicodedata.normalize("NFC", name).strip()
    if not (_NAME.fullmatch(name) and len(name) <= LONGEST_NAME and name[-1] != "."):
        raise LibraryError(
            f"{_shown(name)} is no name of a pattern: expected 1 to {LONGEST_NAME} letters, digits, blanks "
            "and . , ( ) + -, beginning with a letter or a digit"
        )
    if _RESERVED.fullmatch(name):
        raise LibraryError(f"{_shown(name)} is no name of a pattern: no file can be called so on Windows")
    return name


def name_from(text: str) -> str:
    """Return a name that a pattern may have, as near to a text as can be; at worst ``pattern``."""
    kept = re.sub(r"[^\w .,()+-]+", "-", unicodedata.normalize("NFC", text)).strip(" .-,+()")[:LONGEST_NAME]
    kept = kept.rstrip(" .") or "pattern"
    return f"{kept}-1" if _RESERVED.fullmatch(kept) else kept


def checked_tags(tags: Iterable[str]) -> tuple[str, ...]:
    """Return tags in lower case, each once, in the order of the alphabet.

    Raises:
        LibraryError: where one could not be typed as a word.
    """
    found = set()
    for tag in tags:
        plain = re.sub(" +", " ", unicodedata.normalize("NFC", tag).casefold()).strip()
        if not (_TAG.fullmatch(plain) and len(plain) <= LONGEST_TAG):
            raise LibraryError(
                f"{_shown(tag)} is no tag: expected 1 to {LONGEST_TAG} letters, digits, blanks and . + -"
            )
        found.add(plain)
    return tuple(sorted(found))


def parsed(reference: str) -> tuple[str, int | None]:
    """``kawung@3`` → kawung, 3; without a number the newest version is meant, None.

    Raises:
        LibraryError: where what stands behind the @ is no number.
    """
    name, at, number = reference.strip().rpartition("@")
    if not at:
        return reference.strip(), None
    if not (number.isascii() and number.isdigit() and len(number) < 10 and int(number) > 0):
        raise LibraryError(
            f"{_shown(reference)}: expected the number of a version behind the @, such as {name}@1"
        )
    return name, int(number)


def keys(name: str) -> list[str]:
    """Return by what a pattern is looked for: one's own first, then the samples and the starters."""
    key = folded(name.strip())
    return [key] if "/" in key else [key, f"sample/{key}", f"starter/{key}"]


def near(name: str, known: Sequence[str]) -> str:
    """Return the question whether another name was meant, or nothing where none is near."""
    from difflib import get_close_matches

    by_key = {folded(each): each for each in known}
    found = get_close_matches(folded(name), list(by_key), n=1, cutoff=0.6)
    tails: dict[str, str] = {}
    for each in by_key:
        tails.setdefault(each.rpartition("/")[2], each)
    found = found or [tails[each] for each in get_close_matches(folded(name), list(tails), n=1, cutoff=0.6)]
    return f': did you mean "{by_key[found[0]]}"?' if found else ""


def _shown(name: str) -> str:
    short = name if len(name) <= LONGEST_NAME else f"{name[:60]}…"
    return '"' + "".join(each if each.isprintable() else "�" for each in short) + '"'


shown = _shown
