"""PDF/X-4 (ISO 15930-7): what a file holds that says which press it was made for.

The standard asks for the dates of making and changing. No clock is read, or a recipe would not make the same
file twice: the date is one that the output gives, and unless it does the first of 1970, from which computers
count. Pages in larger units are refused, since readers disagree on them and exchange is what the standard is
for.
"""

from __future__ import annotations

import hashlib
import re
import zlib
from collections.abc import Iterator

from batik_vector.artwork import Page
from batik_vector.errors import UnsupportedByFormatError
from batik_vector.export.options import Alternate, PdfInks, PdfOptions
from batik_vector.export.palette import xml_label
from batik_vector.export.pdf.icc import IccProfile
from batik_vector.export.pdf.metadata import escaped, producer
from batik_vector.export.pdf.separations import TRAP
from batik_vector.export.pdf.spelling import text

VERSION = "PDF/X-4"
NAMESPACES = (
    ' xmlns:xmp="http://ns.adobe.com/xap/1.0/" xmlns:xmpMM="http://ns.adobe.com/xap/1.0/mm/"'
    ' xmlns:pdfxid="http://www.npes.org/pdfx/ns/id/"'
)


def check(page: Page, options: PdfOptions, profile: IccProfile, unit: int) -> None:
    """Raise where a page cannot be written for a press.

    Raises:
        UnsupportedByFormatError: with the key and what would do.
    """
    if options.inks is not PdfInks.SPOT and profile.space != "RGB":
        raise UnsupportedByFormatError(
            f'icc = "{options.icc}": of a press that prints {profile.space}, and inks = "rgb": expected '
            'inks = "spot", or the profile of a printer that takes RGB'
        )
    asked = {Alternate.RGB: "RGB", Alternate.CMYK: "CMYK"}.get(options.alternate or Alternate.LAB)
    if asked and asked != profile.space:
        raise UnsupportedByFormatError(
            f'alternate = "{options.alternate}": the press of "{options.icc}" prints {profile.space}: '
            'expected "lab", which suits any'
        )
    if unit > 1:
        raise UnsupportedByFormatError(
            f'icc = "{options.icc}": {VERSION} has no pages past 5.08 m, and this is longer: expected '
            'pages = "tile", which divides it over several'
        )


def catalogue(profile_number: int, options: PdfOptions, profile: IccProfile) -> str:
    """Return the entry of the catalogue that names the press."""
    told = f"/Info {text(profile.name or options.icc)} "
    return (
        f"/OutputIntents [<< /Type /OutputIntent /S /GTS_PDFX /OutputConditionIdentifier "
        f"{text(options.condition or 'Custom')} {told}/DestOutputProfile {profile_number} 0 R >>] "
    )


def profile_object(profile: IccProfile) -> bytes:
    """Return the stream that holds the profile."""
    packed = zlib.compress(profile.data, 9)
    head = f"<< /N {profile.components} /Filter /FlateDecode /Length {len(packed)} >>\nstream\n"
    return head.encode("ascii") + packed + b"\nendstream"


def info(page: Page, options: PdfOptions) -> str:
    """Return what the information dictionary says beside title and producer."""
    day = f"(D:{options.date.replace('-', '')}000000Z)"
    return (
        f" /Creator {text(producer(page))} /CreationDate {day} /ModDate {day} "
        f"/Trapped /{trapped(page)} /GTS_PDFXVersion ({VERSION})"
    )


def metadata(page: Page, options: PdfOptions) -> str:
    """Return what the metadata packet says beside."""
    day = f"{options.date}T00:00:00Z"
    return "".join(f"<{name}>{words}</{name}>\n" for name, words in _fields(page, day))


def _fields(page: Page, day: str) -> Iterator[tuple[str, str]]:
    yield "pdfxid:GTS_PDFXVersion", VERSION
    yield "pdf:Trapped", trapped(page)
    for name in ("CreateDate", "ModifyDate", "MetadataDate"):
        yield f"xmp:{name}", day
    yield "xmp:CreatorTool", escaped(xml_label(producer(page)))
    yield "xmpMM:DocumentID", f"uuid:{_uuid(page)}"
    yield "xmpMM:RenditionClass", "default"
    yield "xmpMM:VersionID", "1"


def _uuid(page: Page) -> str:
    """Return a name of version 8 (RFC 9562) that hangs on the recipe."""
    told = page.provenance
    words = "\0".join([page.title, told.recipe, str(told.seed), told.version, *told.processes])
    figures = hashlib.sha256(words.encode("utf-8", "replace")).hexdigest()[:32]
    figures = f"{figures[:12]}8{figures[13:16]}a{figures[17:]}"
    return re.sub(r"(.{8})(.{4})(.{4})(.{4})(.{12})", r"\1-\2-\3-\4-\5", figures)


def trapped(page: Page) -> str:
    """Return whether the page has traps, in the words of PDF."""
    return "True" if any(words.split()[:1] == [TRAP] for words in page.provenance.processes) else "False"
