"""What a drawing's elements look like: the cascade of attributes, <style> rules and inheritance.

The CSS comes apart by tinycss2 and cssselect2, which cairosvg brings along. Of the properties those are
read that say what is drawn where; the rest is passed over.
"""

from __future__ import annotations

import functools
import re
import xml.etree.ElementTree as ET
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from batik_vector.importing.document import Document, local

INITIAL: Mapping[str, str] = {
    "fill": "black",
    "fill-opacity": "1",
    "fill-rule": "nonzero",
    "clip-rule": "nonzero",
    "stroke": "none",
    "stroke-opacity": "1",
    "stroke-width": "1",
    "stroke-dasharray": "none",
    "stroke-dashoffset": "0",
    "stroke-linecap": "butt",
    "stroke-linejoin": "miter",
    "stroke-miterlimit": "4",
    "paint-order": "normal",
    "visibility": "visible",
    "color": "black",
    "marker-start": "none",
    "marker-mid": "none",
    "marker-end": "none",
}
"""The properties that children inherit, and how they begin (SVG 2, appendix F)."""
ORIGIN = ("transform-origin", "transform-box")
_DRAWN = ("opacity", "clip-path", "mask", "filter", "mix-blend-mode", "vector-effect")
OWN = ("display", "overflow", "transform", *_DRAWN, *ORIGIN)
"""The properties that stay with their element."""
READ = frozenset(INITIAL) | frozenset(OWN) | {"marker"}
GEOMETRY: Mapping[str, tuple[str, ...]] = {
    "path": ("d",),
    "rect": ("x", "y", "width", "height", "rx", "ry"),
    "circle": ("cx", "cy", "r"),
    "ellipse": ("cx", "cy", "rx", "ry"),
    "svg": ("x", "y", "width", "height"),
    "use": ("x", "y", "width", "height"),
    "symbol": ("x", "y", "width", "height"),
}
"""The properties by which a style may say where an element lies, beside its attributes (SVG 2, 7.2)."""
MOVES = ("rotate", "scale", "translate", "offset", "offset-path", "zoom")
"""The properties by which a style moves any element, and which are no attributes (CSS Transforms 2, 5)."""
_DECLARED = READ.union(MOVES, *GEOMETRY.values())

MAX_COMBINATORS = 4
"""Steps such as ``g > .leaf`` in a selector; each may try all the elements round one."""
MAX_TRIALS = 100_000_000
"""Trials that the selectors of all rules may come to."""

_STEP = re.compile(r"\s*+[>+~]\s*+|\s++")
_HARMLESS = ("font-face", "charset", "namespace")

Style = Mapping[str, str]


@dataclass
class Styles:
    """The style sheets of a document; :meth:`of` answers for one element after another."""

    document: Document
    _matched: dict[ET.Element, dict[str, tuple[str, bool]]] = field(default_factory=dict)
    _parents: dict[ET.Element, ET.Element] = field(default_factory=dict)

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

    def standing(self, element: ET.Element) -> Style:
        """Return the style that an element has where it stands, whoever refers to it."""
        if not self._parents:
            self._parents = {child: parent for parent in self.document.root.iter() for child in parent}
        line = [element]
        while line[-1] in self._parents:
            line.append(self._parents[line[-1]])
        style = INITIAL
        for each in reversed(line):
            style = self.of(each, style)
        return style

    def _match(self, text: str) -> None:
        """Find out which elements the rules of a style sheet speak of."""
        import cssselect2  # type: ignore[import-untyped]

        matcher = cssselect2.Matcher()
        trials = _Trials(self.document.root)
        for selectors, declarations in self._rules(text):
            name = f'the <style> rule "{selectors[:60].strip()}"'
            steps = _steps(selectors)
            if steps > MAX_COMBINATORS:
                self.document.note(
                    f"{name} has {steps} steps, more than {MAX_COMBINATORS}; it is passed over"
                )
                continue
            try:
                found_all = cssselect2.compile_selector_list(selectors)
            except (cssselect2.SelectorError, RecursionError):
                self.document.note(f"{name} is not understood")
                continue
            if not trials.take(found_all, selectors, steps):
                self.document.note(f"{name} would take too long to match; it is passed over")
                continue
            for selector in found_all:
                if selector.pseudo_element is None:
                    matcher.add_selector(selector, declarations)
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


def _steps(selectors: str) -> int:
    """Return how many combinators the longest of several selectors may have, brackets counted in."""
    import tinycss2

    pieces = [""]
    for token in tinycss2.parse_component_value_list(selectors, skip_comments=True):
        if token == ",":
            pieces.append("")
        elif token.type != "[] block":
            pieces[-1] += token.serialize()
    return max(len(_STEP.findall(piece.strip())) for piece in pieces)


class _Trials:
    """How often the selectors of a style sheet try whether an element is meant."""

    def __init__(self, root: ET.Element) -> None:
        self._named: Counter[str] = Counter()
        self._left = MAX_TRIALS
        self._all = 0
        for element in root.iter():
            self._all += 1
            self._named.update("." + name for name in set(element.get("class", "").split()))
            self._named.update(("#" + element.get("id", ""), element.tag.rpartition("}")[2].lower()))
        self._depth = _depth(root)

    def take(self, selectors: Sequence[Any], text: str, steps: int) -> bool:
        """Return whether selectors may still be matched, and count them in."""
        # Brothers and what :has() looks through may be all the elements there are.
        reach = self._all if "~" in text or ":has(" in text.lower() else self._depth
        trials = sum(self._subjects(selector) for selector in selectors) * reach**steps
        if trials > self._left:
            return False
        self._left -= trials
        return True

    def _subjects(self, selector: Any) -> int:
        if selector.id is not None:
            return self._named["#" + selector.id]
        if selector.class_name is not None:
            return self._named["." + selector.class_name]
        if selector.lower_local_name is not None:
            return self._named[selector.lower_local_name]
        return self._all


def _depth(root: ET.Element) -> int:
    depth, level = 0, [root]
    while level:
        depth, level = depth + 1, [child for element in level for child in element]
    return depth


@functools.lru_cache(4096)
def declared(text: str) -> dict[str, tuple[str, bool]]:
    """Return the properties that declarations set, each with its value and whether it is important."""
    import tinycss2

    found: dict[str, tuple[str, bool]] = {}
    for each in tinycss2.parse_declaration_list(text, skip_comments=True, skip_whitespace=True):
        if each.type == "declaration" and each.lower_name in _DECLARED:
            value = tinycss2.serialize(each.value).strip()
            if each.important or not found.get(each.lower_name, ("", False))[1]:
                found[each.lower_name] = (value, each.important)
    return found


@functools.lru_cache(4096)
def share_of(text: str) -> float:
    """Return an opacity: ``"0.5"`` or ``"50%"``; what is none is 1."""
    try:
        value = float(text[:-1]) / 100 if text.endswith("%") else float(text)
    except ValueError:
        return 1.0
    return max(0.0, min(1.0, value))
