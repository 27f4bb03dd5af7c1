"""Bounds, units and help of a parameter, written once beside the attribute.

``n: Annotated[int, Between(1, 48), Says("petals", "n")] = 4`` serves the check when a value is built in
Python (:func:`check`), the check of a recipe, the schema, and the help. Nothing here imports pydantic:
its hooks are methods that it looks for by name, so the geometry floor stays free of it.
"""

from __future__ import annotations

import dataclasses
import functools
import math
import typing
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Annotated, Any, TypeAlias

import annotated_types

from batik_vector.errors import GeometryError, unknown_name
from batik_vector.units import parse_length


@dataclass(frozen=True)
class Between(annotated_types.GroupedMetadata):
    """Inclusive bounds of a number."""

    low: float
    high: float

    def __iter__(self) -> Iterator[annotated_types.BaseMetadata]:
        """Yield the bounds as annotated_types knows them."""
        yield annotated_types.Ge(self.low)
        yield annotated_types.Le(self.high)


@dataclass(frozen=True)
class Says:
    """One line of help, and the paper's symbol where it has one."""

    text: str
    symbol: str = ""

    def __get_pydantic_json_schema__(self, core_schema: Any, handler: Callable[[Any], Any]) -> Any:
        """Put the help into the schema."""
        schema = handler(core_schema)
        schema["description"] = f"{self.text} (the paper's {self.symbol})" if self.symbol else self.text
        return schema


@dataclass(frozen=True)
class LengthUnit:
    """Marks a float as a length in mm that a recipe may write with its unit."""

    def __get_pydantic_core_schema__(self, source: Any, handler: Callable[[Any], Any]) -> Any:
        """Parse the text before the number is checked."""
        from pydantic_core import core_schema

        return core_schema.no_info_before_validator_function(parse_length, handler(source))

    def __get_pydantic_json_schema__(self, core_schema: Any, handler: Callable[[Any], Any]) -> Any:
        """A number of mm, or text with a unit."""
        return {"anyOf": [handler(core_schema), {"type": "string", "examples": ["280 mm", "25.25 in"]}]}


Length: TypeAlias = Annotated[float, LengthUnit()]
"""Millimetres on cloth; recipes write "280 mm" or a bare number."""


@dataclass(frozen=True)
class OneOf:
    """Marks a value that a recipe writes as a table with a ``kind`` from a catalogue of dataclasses.

    ``load`` returns the catalogue, name → class, when it is first needed.
    """

    load: Callable[[], Mapping[str, type]]
    what: str
    default: str = ""

    def __hash__(self) -> int:
        return hash((self.load, self.what))

    def __get_pydantic_core_schema__(self, source: Any, handler: Callable[[Any], Any]) -> Any:
        """Choose the class by ``kind`` and let it check the rest of the table."""
        from pydantic_core import PydanticCustomError, core_schema

        catalogue = self.load()
        choices = {name: handler.generate_schema(cls) for name, cls in catalogue.items()}  # type: ignore[attr-defined]

        def strip(value: Any) -> Any:
            if type(value) in catalogue.values():
                return value
            if not isinstance(value, dict):
                raise PydanticCustomError("table", "expected a table with a kind")
            kind = value.get("kind", self.default)
            if not isinstance(kind, str) or kind not in catalogue:
                words = unknown_name(str(kind), sorted(catalogue), f"kind of {self.what}")
                raise PydanticCustomError("unknown_name", "{words}", {"words": words})
            return {"kind": kind, "value": {k: v for k, v in value.items() if k != "kind"}}

        wrapped = {
            name: core_schema.no_info_before_validator_function(lambda v: v["value"], schema)
            for name, schema in choices.items()
        }

        def pick(value: Any, inner: Callable[[Any], Any]) -> Any:
            stripped = strip(value)
            return stripped if not isinstance(stripped, dict) else inner(stripped)

        union = core_schema.tagged_union_schema(wrapped, discriminator="kind")
        return core_schema.no_info_wrap_validator_function(pick, union)


@functools.cache
def _bounded(cls: type) -> tuple[tuple[str, Between], ...]:
    hints = typing.get_type_hints(cls, include_extras=True)
    found = []
    for field in dataclasses.fields(cls):
        for mark in getattr(hints[field.name], "__metadata__", ()):
            if isinstance(mark, Between):
                found.append((field.name, mark))
    return tuple(found)


def check(value: Any) -> None:
    """Raise where a dataclass instance holds a number outside its bounds.

    Raises:
        GeometryError: naming the field, its value and the bounds.
    """
    for name, bounds in _bounded(type(value)):
        number = getattr(value, name)
        if number is None:
            continue
        if not math.isfinite(number) or not bounds.low <= number <= bounds.high:
            raise GeometryError(f"{name} = {number}, expected {bounds.low:g} to {bounds.high:g}")
