"""Search by text: parts of words are found, whatever is typed.

The index holds every three letters in a row (SQLite's FTS5 with its trigram tokenizer). What is shorter than
three letters is looked for in the texts themselves. Both compare what was folded, see
:func:`~batik_vector.library.names.folded`, and so agree.
"""

from __future__ import annotations

from batik_vector.library.names import folded

SHORTEST = 3
"""Letters below which the index finds nothing."""


def terms(query: str) -> list[str]:
    """Return what a query asks for: its words, and as one what stands in double quotes; folded, each once."""
    found: dict[str, None] = {}
    for number, part in enumerate(query.split('"')):
        # Every second part stands in quotes; where the last quote is never closed it ends with the query.
        quoted = number % 2 == 1
        words = [" ".join(folded(part).split())] if quoted else folded(part).split()
        found |= dict.fromkeys(word for word in words if word)
    return list(found)


def condition(query: str) -> tuple[str, list[str]]:
    """Return a query as a condition in SQL on ``p.id``, and its values; empty where nothing is asked.

    Every term must be found.
    """
    asked = terms(query)
    if not asked:
        return "", []
    long = [term for term in asked if len(term) >= SHORTEST]
    short = [term for term in asked if len(term) < SHORTEST]
    parts, values = [], []
    if long:
        parts.append("words MATCH ?")
        values.append(" ".join('"' + term.replace('"', '""') + '"' for term in long))
    parts += ["instr(text, ?)"] * len(short)
    return f"p.id IN (SELECT rowid FROM words WHERE {' AND '.join(parts)})", values + short


def searched(*parts: str) -> str:
    """Return what the index holds of a pattern: its parts, folded, each a line."""
    return "\n".join(" ".join(folded(part).split()) for part in parts if part)
