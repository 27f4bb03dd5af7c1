"""Bounds, units and help of a parameter, written once beside the attribute.

``n: Annotated[int, Between(1, 48), Says("petals", "n")] = 4`` serves the check when a value is built in
Python (:mod:`~batik_vector.fields.fitting`), the check of a recipe, the schema, and the help. Nothing here
imports pydantic: its hooks are methods that it looks for by name, so the geometry floor stays free of it.
"""

from __future__ import annotations

import functools
import re
import sys
import types
import typing
from collections.abc import Callable, Iterator, Mapping
from typing import Annotated, Any, ClassVar, TypeAlias

from batik_vector.units import parse_length
from batik_vector.values import frozen


@frozen
class Between:
    """Inclusive bounds of a number."""

    __is_annotated_types_grouped_metadata__: ClassVar[bool] = True
    """Tells pydantic, as annotated_types' protocol has it, to take the marks that it yields for it."""

    low: float
    high: float

    def __iter__(self) -> Iterator[Any]:
        """Yield the bounds as annotated_types knows them."""
        import annotated_types

        yield annotated_types.Ge(self.low)
        yield annotated_types.Le(self.high)


@frozen
class Useful:
    """Where the values lie that please most: sliders and random variations keep within, recipes need not."""

    low: float
    high: float


@frozen
class Says:
    """One line of help, the paper's symbol where it has one, and a word for people where the key is none.

    Of a pair they are as many as it has numbers, with commas between, both symbols and words.
    """

    text: str
    symbol: str = ""
    called: str = ""


HIDDEN = "hidden"
"""Metadata of a field that a recipe may not write."""


@frozen
class LengthUnit:
    """Marks a float as a length in mm that a recipe may write with its unit."""

    def __get_pydantic_core_schema__(self, source: Any, handler: Callable[[Any], Any]) -> Any:
        """Parse the text before the number is checked."""
        from pydantic_core import core_schema

        return core_schema.no_info_before_validator_function(parse_length, handler(source))


Length: TypeAlias = Annotated[float, LengthUnit()]
"""Millimetres on cloth; recipes write "280 mm" or a bare number."""


@frozen
class Text:
    """Marks text with rules: ``parse`` returns it in its one spelling, or raises what was expected.

    ``pattern`` is the regular expression that editors check, where there is one.
    """

    parse: Callable[[str], str]
    expected: str
    pattern: str = ""

    def __get_pydantic_core_schema__(self, source: Any, handler: Callable[[Any], Any]) -> Any:
        """Parse what has been found to be text."""
        from pydantic_core import core_schema

        return core_schema.no_info_after_validator_function(self.parse, handler(source))


@frozen
class Several:
    """Marks text for which a list of texts may stand: ``Annotated[str | tuple[str, ...], Several()]``."""

    expected = "text in quotes, or a list of texts"

    def parse(self, value: Any) -> str | tuple[str, ...]:
        """Return a text, or several as a tuple.

        Raises:
            ValueError: with what was expected.
        """
        if isinstance(value, str):
            return value
        if isinstance(value, list | tuple) and value and all(isinstance(each, str) for each in value):
            return tuple(value)
        raise ValueError(f"expected {self.expected}")

    def __get_pydantic_core_schema__(self, source: Any, handler: Callable[[Any], Any]) -> Any:
        """Let :meth:`parse` decide."""
        from pydantic_core import core_schema

        return core_schema.no_info_plain_validator_function(self.parse)


@frozen
class Alone:
    """Marks a list of tables of which a single one may stand bare: ``process = { kind = "cut" }``."""

    def __get_pydantic_core_schema__(self, source: Any, handler: Callable[[Any], Any]) -> Any:
        """Make a list of a bare table."""
        from pydantic_core import core_schema

        return core_schema.no_info_before_validator_function(self.listed, handler(source))

    @staticmethod
    def listed(value: Any) -> Any:
        """Return a bare table, or a value that is no list, as the only member of a tuple."""
        if isinstance(value, list | tuple):
            return tuple(value)
        return value if isinstance(value, str | int | float | bool) or value is None else (value,)


@frozen
class Instead:
    """Marks an argument with what is expected in better words than the name of its class."""

    expected: str


@frozen
class Converted:
    """Marks what ``parse`` makes of whatever it takes; it raises TypeError or ValueError for all else.

    Such fields are none of a recipe's.
    """

    parse: Callable[[Any], Any]
    expected: str


Names: TypeAlias = Annotated[str | tuple[str, ...], Several()]
"""A name, or a list of names."""

_COLOUR = "^#([0-9a-fA-F]{3}){1,2}$"


def parse_colour(text: str) -> str:
    """Return a colour as ``#rrggbb`` in small letters: ``"#FED"`` → ``"#ffeedd"``.

    Raises:
        ValueError: with what was expected.
    """
    if not re.fullmatch(_COLOUR, text) or text.endswith("\n"):
        raise ValueError("expected #rrggbb or #rgb")
    figures = text[1:].lower()
    return "#" + (figures if len(figures) == 6 else "".join(figure * 2 for figure in figures))


Colour: TypeAlias = Annotated[str, Text(parse_colour, "#rrggbb or #rgb", _COLOUR)]
"""A colour on screen."""


class Unset(str):
    """A text that stands in for one that was not given, equal to it: as a default it tells the two apart."""

    __slots__ = ()


@frozen
class OneOf:
    """Marks a value that a recipe writes as a table whose ``tag`` names a class of a catalogue.

    ``load`` returns the catalogue, name → class, when it is first needed.
    """

    load: Callable[[], Mapping[str, type]]
    what: str
    tag: str = "kind"

    def __hash__(self) -> int:
        return hash((self.load, self.what))

    def __get_pydantic_core_schema__(self, source: Any, handler: Callable[[Any], Any]) -> Any:
        """Choose the class by the tag and let it check the rest of the table."""
        from pydantic_core import core_schema

        catalogue = self.load()
        classes = tuple(catalogue.values())
        choices: dict[Any, Any] = {}
        for name, cls in catalogue.items():
            inner = handler.generate_schema(cls)  # type: ignore[attr-defined]
            choices[TAG + name] = core_schema.no_info_before_validator_function(_without_tag, inner)

        def pick(value: Any, inner: Callable[[Any], Any]) -> Any:
            return value if type(value) in classes else inner(self._tagged(value, catalogue))

        union = core_schema.tagged_union_schema(choices, discriminator="tag")
        return core_schema.no_info_wrap_validator_function(pick, union)

    def _tagged(self, value: Any, catalogue: Mapping[str, type]) -> Any:
        from pydantic_core import PydanticCustomError

        if not isinstance(value, dict):
            raise PydanticCustomError("no_table", "expected a table")
        if self.tag not in value:
            raise PydanticCustomError("no_tag", "expected a table with a tag")
        tag = value[self.tag]
        if not isinstance(tag, str) or tag not in catalogue:
            raise PydanticCustomError("bad_tag", "expected a name of the catalogue")
        return {"tag": TAG + tag, "rest": {k: _with_tuples(v) for k, v in value.items() if k != self.tag}}


TAG = "\0"
"""Begins the parts of pydantic's paths that name a class of a catalogue and no key."""


def _without_tag(value: Any) -> Any:
    return value["rest"]


def _with_tuples(value: Any) -> Any:
    """Return a value with tuples for lists: what is strict takes no list for a tuple."""
    if isinstance(value, dict):
        return {k: _with_tuples(v) for k, v in value.items()}
    return tuple(_with_tuples(v) for v in value) if isinstance(value, list | tuple) else value


@functools.cache
def hint_of(cls: type, name: str) -> Any:
    """Return the type of a dataclass's field with the marks it carries.

    One field at a time, as a recipe uses few of a class's, and to make a type of its text is what costs.
    """
    field = cls.__dataclass_fields__[name]  # type: ignore[attr-defined]
    home = _home(cls, name, field)
    if home is not cls:
        return hint_of(home, name)  # once for all heirs
    # As the dataclass has read it: text, or from Python 3.14 on a type whose names may be still to come.
    alone = types.SimpleNamespace(__annotations__={name: field.type})
    return typing.get_type_hints(alone, vars(sys.modules[cls.__module__]), include_extras=True)[name]


def _home(cls: type, name: str, field: Any) -> type:
    """Return the class that declares a field: the last one up the line to hold this very object."""
    return next(
        base
        for base in reversed(cls.__mro__)
        if vars(base).get("__dataclass_fields__", {}).get(name) is field
    )
