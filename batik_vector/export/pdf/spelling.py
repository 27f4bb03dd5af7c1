"""How PDF spells numbers, texts and names (ISO 32000-1, 7.3)."""

from __future__ import annotations


def number(value: float, decimals: int) -> str:
    """Return a number as PDF has it: no exponent, no needless zeros."""
    words = f"{value:.{decimals}f}"
    return words.rstrip("0").rstrip(".") if "." in words else words


def numbers(values: tuple[float, ...]) -> str:
    """Return numbers of a colour, to 5 decimals."""
    return " ".join(number(each, 5) for each in values)


def text(words: str) -> str:
    """Return a text string in UTF-16, hexadecimal, which needs no escapes."""
    return f"<{(chr(0xFEFF) + words).encode('utf-16-be', 'replace').hex()}>"


def name(words: str) -> str:
    """Return a name object's characters, all but letters and digits escaped, 127 bytes at most."""
    raw = words.encode("utf-8", "replace")[:127]
    return "".join(chr(byte) if chr(byte).isalnum() and byte < 128 else f"#{byte:02x}" for byte in raw)
