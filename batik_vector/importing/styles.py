"""What a drawing's elements look like: the cascade of attributes, <style> rules and inheritance.

The CSS comes apart by tinycss2 and cssselect2, which cairosvg brings along. Of the properties those are
read that say what is drawn where; the rest is passed over.
"""

from __future__ import annotations

import functools
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from batik_vector.importing.document import Document, local

INITIAL: Mapping[str, str] = {
    "fill": "black",
    "fill-opacity": "1",
    "fill-rule": "nonzero",
    "stroke": "none",
    "stroke-opacity": "1",
    "stroke-width": "1",
    "stroke-dasharray": "none",
    "visibility": "visible",
    "color": "black",
    "marker-start": "none",
    "marker-mid": "none",
    "marker-end": "none",
}
"""The properties that children inherit, and how they begin (SVG 2, appendix F)."""
OWN = ("display", "opacity", "clip-path", "mask", "filter", "overflow", "transform", "vector-effect")
"""The properties that stay with their element."""
READ = frozenset(INITIAL) | frozenset(OWN) | {"marker"}

_HARMLESS = ("font-face", "charset", "namespace")

Style = Mapping[str, str]


@dataclass
class Styles:
    """The style sheets of a document; :meth:`of` answers for one element after another."""

    document: Document
    _matched: dict[ET.Element, dict[str, tuple[str, bool]]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        sheets = [each for each in self.document.root.iter() if local(each) == "style" and each.text]
        if any(each.text and each.text.strip() for each in sheets):
            self._match("\n".join(each.text or "" for each in sheets))

    def of(self, element: ET.Element, parent: Style) -> Style:
        """Return the style of an element inside one whose style is known."""
        own = {name: value for name, value in element.attrib.items() if name in READ}
        important: dict[str, str] = {}
        for name, (value, weighty) in self._matched.get(element, {}).items():
            (important if weighty else own)[name] = value
        text = element.get("style")
        if text:
            for name, (value, weighty) in declared(text).items():
                (important if weighty else own)[name] = value
        own |= important
        style = {name: parent[name] for name in INITIAL}
        marker = own.pop("marker", None)
        if marker is not None:
            own = {"marker-start": marker, "marker-mid": marker, "marker-end": marker} | own
        for name, value in own.items():
            value = value.strip()
            if value == "inherit":
                style[name] = parent.get(name, "")
            elif value in ("initial", "unset") and name in INITIAL:
                style[name] = INITIAL[name] if value == "initial" else parent[name]
            elif value:
                style[name] = value
        if style["color"].lower() == "currentcolor":
            style["color"] = parent["color"]
        return style

    def _match(self, text: str) -> None:
        """Find out which elements the rules of a style sheet speak of."""
        import cssselect2  # type: ignore[import-untyped]

        matcher = cssselect2.Matcher()
        for selectors, declarations in self._rules(text):
            try:
                for selector in cssselect2.compile_selector_list(selectors):
                    if selector.pseudo_element is None:
                        matcher.add_selector(selector, declarations)
            except cssselect2.SelectorError:
                self.document.note(f'the <style> rule "{selectors[:60].strip()}" is not understood')
        for node in cssselect2.ElementWrapper.from_xml_root(self.document.root).iter_subtree():
            found = sorted(matcher.match(node), key=lambda match: match[:2])
            values: dict[str, tuple[str, bool]] = {}
            for _, _, _, declarations in found:
                for name, (value, weighty) in declarations.items():
                    if weighty or not values.get(name, ("", False))[1]:
                        values[name] = (value, weighty)
            if values:
                self._matched[node.etree_element] = values

    def _rules(self, text: str) -> list[tuple[str, dict[str, tuple[str, bool]]]]:
        import tinycss2  # type: ignore[import-untyped]

        rules = []
        for rule in tinycss2.parse_stylesheet(text, skip_comments=True, skip_whitespace=True):
            if rule.type == "qualified-rule":
                body = tinycss2.serialize(rule.content)
                rules.append((tinycss2.serialize(rule.prelude), declared(body)))
            elif rule.type == "at-rule" and rule.lower_at_keyword not in _HARMLESS:
                self.document.note(f"the <style> rule @{rule.at_keyword[:40]} is passed over")
            elif rule.type == "error":
                self.document.note(f"a part of <style> cannot be read: {rule.message}")
        return rules


@functools.lru_cache(4096)
def declared(text: str) -> dict[str, tuple[str, bool]]:
    """Return the properties that declarations set, each with its value and whether it is important."""
    import tinycss2

    found: dict[str, tuple[str, bool]] = {}
    for each in tinycss2.parse_declaration_list(text, skip_comments=True, skip_whitespace=True):
        if each.type == "declaration" and each.lower_name in READ:
            value = tinycss2.serialize(each.value).strip()
            if each.important or not found.get(each.lower_name, ("", False))[1]:
                found[each.lower_name] = (value, each.important)
    return found


@functools.lru_cache(4096)
def colour_of(text: str, current: str = "black") -> tuple[str, float] | None:
    """Return a CSS colour as (``#rrggbb``, opacity), or None where the text is none."""
    import tinycss2.color3  # type: ignore[import-untyped]

    colour: Any = tinycss2.color3.parse_color(text.partition("icc-color(")[0])
    if colour == "currentColor":
        return None if current.lower() == "currentcolor" else colour_of(current)
    if colour is None:
        return None
    levels = (max(0, min(255, int(255 * part + 0.5))) for part in colour[:3])
    return "#{:02x}{:02x}{:02x}".format(*levels), float(max(0.0, min(1.0, colour.alpha)))


def share_of(text: str) -> float:
    """Return an opacity: ``"0.5"`` or ``"50%"``; what is none is 1."""
    try:
        value = float(text[:-1]) / 100 if text.endswith("%") else float(text)
    except ValueError:
        return 1.0
    return max(0.0, min(1.0, value))
