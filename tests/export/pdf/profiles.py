"""ICC profiles, as small as they come."""

from __future__ import annotations


def profile(space: str = "CMYK", kind: str = "prtr", name: str = "Press", version: int = 2) -> bytes:
    """A profile with nothing in it but its name, spelled as version 2 or 4 spells it."""
    if version == 2:
        tag = b"desc\0\0\0\0" + (len(name) + 1).to_bytes(4, "big") + name.encode() + b"\0"
    else:
        words = name.encode("utf-16-be")
        head = b"".join(each.to_bytes(4, "big") for each in (1, 12))
        tag = (
            b"mluc\0\0\0\0" + head + b"enUS" + len(words).to_bytes(4, "big") + (28).to_bytes(4, "big") + words
        )
    table = (1).to_bytes(4, "big") + b"desc" + (144).to_bytes(4, "big") + len(tag).to_bytes(4, "big")
    size = (128 + len(table) + len(tag)).to_bytes(4, "big")
    begin = size + bytes(4) + bytes([version, 0, 0, 0]) + kind.encode() + space.ljust(4).encode()
    return begin.ljust(36, b"\0") + b"acsp" + bytes(88) + table + tag
