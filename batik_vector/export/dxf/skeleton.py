"""Makes the two empty DXF files that the writer fills in: ``python -m batik_vector.export.dxf.skeleton``.

A complete DXF is some three thousand lines of tables and objects, each tied to others by handles, and
AutoCAD discards a file for one missing link. So ezdxf, which knows them, writes an empty drawing once;
we take out what varies from run to run, leave ``@MARKS@`` where the drawing goes, and keep the result as
data. Writing a drawing then needs no ezdxf. The skeletons hold no vertices, only the format's furniture.
"""

from __future__ import annotations

import io
import re
from collections.abc import Iterator
from pathlib import Path

from batik_vector.export.dxf import (
    DICTIONARY,
    DICTIONARY_HANDLE,
    R12_SKELETON,
    R2000_SKELETON,
    XRECORD_HANDLE,
)

Tag = tuple[str, str]

FIXED = {
    "$TDCREATE": "2451545.0",
    "$TDUPDATE": "2451545.0",
    "$TDUCREATE": "2451545.0",
    "$TDUUPDATE": "2451545.0",
    "$FINGERPRINTGUID": "{00000000-0000-0000-0000-000000000000}",
    "$VERSIONGUID": "{00000000-0000-0000-0000-000000000000}",
    "$HANDSEED": "@HANDSEED@",
    "$HANDLING": "0",
    "$PSVPSCALE": "1.0",
}
"""Header variables with one value of our own. The Julian date is noon of 1 January 2000. LibreCAD prints at
the scale of $PSVPSCALE, and ezdxf's 0 ("to fit") shrinks a drawing there to a dot."""

CORNERS = {
    "$EXTMIN": ("@LEFT@", "@BOTTOM@", "0.0"),
    "$EXTMAX": ("@RIGHT@", "@TOP@", "0.0"),
    "$LIMMIN": ("@LEFT@", "@BOTTOM@"),
    "$LIMMAX": ("@RIGHT@", "@TOP@"),
    "$PINSBASE": ("@BASE_X@", "@BASE_Y@", "0.0"),
    "$PLIMMIN": ("@LEFT@", "@BOTTOM@"),
    "$PLIMMAX": ("@RIGHT@", "@TOP@"),
}
"""Header variables that say where the drawing lies. LibreCAD takes its page from the $PLIM pair
and lays the drawing's origin on it at $PINSBASE."""

VIEW = {"12": "@MIDDLE_X@", "22": "@MIDDLE_Y@", "40": "@VIEW@"}
"""Group codes of the viewport: centre and height of what is seen on opening."""

LAYOUT = {
    "10": "@LEFT@", "20": "@BOTTOM@", "11": "@RIGHT@", "21": "@TOP@",
    "14": "@LEFT@", "24": "@BOTTOM@", "34": "0.0", "15": "@RIGHT@", "25": "@TOP@", "35": "0.0",
}  # fmt: skip
"""Group codes of the model layout: its limits and extents."""


def empty_drawing(version: str) -> list[list[Tag]]:
    """Return the records of an empty drawing in millimetres, each beginning with its code 0 tag."""
    from ezdxf.filemanagement import new

    document = new(version)
    document.header["$MEASUREMENT"] = 1
    if version != "R12":
        document.units = 4
    stream = io.StringIO()
    document.write(stream)
    lines = stream.getvalue().split("\n")
    tags = list(zip([code.strip() for code in lines[0::2]], lines[1::2], strict=False))
    records: list[list[Tag]] = []
    for tag in tags:
        if tag[0] == "0":
            records.append([])
        records[-1].append(tag)
    return records


def header(record: list[Tag]) -> Iterator[Tag]:
    """Set the variables of the header section."""
    name, axis = "", 0
    for code, value in record:
        if code == "9":
            name, axis = value, 0
        elif name in CORNERS:
            value, axis = CORNERS[name][axis], axis + 1
        elif name in FIXED:
            value = FIXED[name]
        yield code, value


def r2000() -> str:
    """Return the AC1015 skeleton."""
    out: list[Tag] = []
    records = empty_drawing("R2000")
    for record in records:
        kind, values = record[0][1], dict(reversed(record))
        if record[1:2] == [("2", "HEADER")]:
            record = list(header(record))
        elif kind == "DICTIONARYVAR" or ("2", "EZDXF") in record:
            continue
        elif kind == "DICTIONARY" and ("3", "CREATED_BY_EZDXF") in record:
            record = provenance_objects(values["330"])
        elif kind == "DICTIONARY" and ("3", "EZDXF_META") in record:
            at = record.index(("3", "EZDXF_META"))
            record[at : at + 2] = [("3", DICTIONARY), ("350", DICTIONARY_HANDLE)]
        elif kind == "TABLE" and values["2"] == "APPID":
            record = [("70", "2") if code == "70" else (code, value) for code, value in record]
        elif kind == "TABLE" and values["2"] == "LAYER":
            record = [("70", "@LAYER_COUNT@") if code == "70" else (code, value) for code, value in record]
        elif kind == "VPORT":
            record = [(code, VIEW.get(code, value)) for code, value in record]
        elif kind == "LAYOUT" and ("1", "Model") in record:
            at = record.index(("100", "AcDbLayout"))
            record = record[:at] + [(code, LAYOUT.get(code, value)) for code, value in record[at:]]
        out += record
        insert_marks(out, kind, values)
    return spelled(out)


def provenance_objects(root: str) -> list[Tag]:
    """Return the dictionary and the record that hold recipe, seed and version."""
    return [
        ("0", "DICTIONARY"), ("5", DICTIONARY_HANDLE), ("330", root), ("100", "AcDbDictionary"), ("281", "1"),
        ("3", "PROVENANCE"), ("350", XRECORD_HANDLE),
        ("0", "XRECORD"), ("5", XRECORD_HANDLE), ("330", DICTIONARY_HANDLE), ("100", "AcDbXrecord"),
        ("280", "1"), ("@", "PROVENANCE@"),
    ]  # fmt: skip


def r12() -> str:
    """Return the AC1009 skeleton. It has no handles, which R12 allows and which halves a vertex."""
    out: list[Tag] = []
    for record in empty_drawing("R12"):
        kind, values = record[0][1], dict(reversed(record))
        if record[1:2] == [("2", "HEADER")]:
            record = [tag for tag in header(record) if tag not in (("9", "$HANDSEED"), ("5", "@HANDSEED@"))]
        elif kind == "BLOCK" and values["2"] == "$Model_Space":
            at = record.index(("1001", "EZDXF"))
            record = [*record[:at], ("1001", DICTIONARY), ("@", "PROVENANCE@")]
        elif kind == "APPID":
            record = [(code, value.replace("EZDXF", DICTIONARY)) for code, value in record]
        elif kind == "TABLE" and values["2"] == "LAYER":
            record = [("70", "@LAYER_COUNT@") if code == "70" else (code, value) for code, value in record]
        elif kind == "VPORT":
            record = [(code, VIEW.get(code, value)) for code, value in record]
        # In a dimension style code 5 is an arrow block, and the handle is code 105.
        handle = "105" if kind == "DIMSTYLE" else "5"
        out += [tag for tag in record if tag[0] != handle]
        insert_marks(out, kind, values)
    return spelled(out)


def insert_marks(out: list[Tag], kind: str, values: dict[str, str]) -> None:
    """Leave a mark behind the last standard layer, and in the section of entities."""
    if kind == "LAYER" and values["2"] == "Defpoints":
        out.append(("@", "LAYERS@"))
    elif kind == "SECTION" and values["2"] == "ENTITIES":
        out.append(("@", "ENTITIES@"))


def spelled(tags: list[Tag]) -> str:
    """Return tags as lines; a mark takes a line of its own."""
    text = "".join(f"@{value}\n" if code == "@" else f"{code:>3}\n{value}\n" for code, value in tags)
    left = re.findall(r"EZDXF|20\d\d-\d\d-\d\d", text)
    if left:
        raise RuntimeError(f"the skeleton still holds {left}")
    return text


def main() -> None:
    """Write both skeletons beside this module."""
    folder = Path(__file__).parent
    (folder / R2000_SKELETON).write_text(r2000(), encoding="ascii", newline="\n")
    (folder / R12_SKELETON).write_text(r12(), encoding="ascii", newline="\n")


if __name__ == "__main__":
    main()
