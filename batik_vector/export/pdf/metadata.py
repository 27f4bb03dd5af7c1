"""What a PDF says of itself: its XMP packet (ISO 16684-1), and its information dictionary."""

from __future__ import annotations

from batik_vector.artwork import Page
from batik_vector.export.palette import xml_label
from batik_vector.export.pdf.spelling import text
from batik_vector.export.provenance import NAMESPACE, xml_fields


def producer(page: Page) -> str:
    """Return what wrote the file."""
    return f"batik_vector {page.provenance.version}".rstrip()


def info(page: Page, more: str = "") -> bytes:
    """Return the information dictionary, with what more there is to say."""
    return f"<< /Title {text(page.title)} /Producer {text(producer(page))}{more} >>".encode("ascii")


def packet(page: Page, namespaces: str = "", more: str = "") -> bytes:
    """Return the metadata packet with recipe, seed and version in our namespace.

    Args:
        page: that is written.
        namespaces: declarations that ``more`` needs.
        more: elements to be added.
    """
    fields = [f"<batik:{name}>{escaped(value)}</batik:{name}>" for name, value in xml_fields(page.provenance)]
    whole = (
        '<?xpacket begin="\ufeff" id="W5M0MpCehiHzreSzNTczkc9d"?>\n'
        '<x:xmpmeta xmlns:x="adobe:ns:meta/">\n'
        '<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#">\n'
        '<rdf:Description rdf:about="" xmlns:dc="http://purl.org/dc/elements/1.1/" '
        f'xmlns:pdf="http://ns.adobe.com/pdf/1.3/" xmlns:batik="{NAMESPACE}"{namespaces}>\n'
        "<dc:format>application/pdf</dc:format>\n"
        '<dc:title><rdf:Alt><rdf:li xml:lang="x-default">'
        f"{escaped(xml_label(page.title))}</rdf:li></rdf:Alt></dc:title>\n"
        f"<pdf:Producer>{escaped(xml_label(producer(page)))}</pdf:Producer>\n{more}"
        + "\n".join(fields)
        + '\n</rdf:Description>\n</rdf:RDF>\n</x:xmpmeta>\n<?xpacket end="r"?>'
    )
    return whole.encode("utf-8")


def escaped(words: str) -> str:
    """Return text for an XML element; a carriage return would be read as a line feed."""
    return words.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;").replace("\r", "&#13;")
