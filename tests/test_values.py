"""Values are frozen dataclasses to whoever uses them, and cost nothing to make."""

from __future__ import annotations

import builtins
import copy
import inspect
import pickle
import sys
from collections.abc import Callable
from dataclasses import FrozenInstanceError, asdict, dataclass, field, fields, is_dataclass, replace
from typing import Any

import pytest

from batik_vector.values import frozen


@frozen
class Place:
    """Fields by place or by name."""

    x: float
    y: float = 2.0
    marks: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class Standard:
    """What :class:`Place` is measured by."""

    x: float
    y: float = 2.0
    marks: list[str] = field(default_factory=list)


@frozen(kw_only=True)
class Base:
    """Fields by name alone."""

    name: str = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "name", self.name.upper())


@frozen(kw_only=True)
class Heir(Base):
    """A field without a default behind one that has it."""

    size: int


@frozen(eq=False)
class Alone:
    """Equal to itself."""

    x: int = 0


@frozen
class Empty:
    """No fields at all."""


BOTH: list[Any] = [Place, Standard]


@pytest.mark.parametrize("cls", BOTH)
def test_it_is_filled_as_dataclasses_are(cls: Callable[..., Any]) -> None:
    assert asdict(cls(1)) == {"x": 1, "y": 2.0, "marks": []}
    assert asdict(cls(1, 3, ["a"])) == asdict(cls(y=3, marks=["a"], x=1)) == {"x": 1, "y": 3, "marks": ["a"]}
    assert list(vars(cls(marks=[], y=0, x=0))) == ["x", "y", "marks"]
    assert cls(1).marks is not cls(1).marks
    assert replace(cls(1), y=5) == cls(1, 5)
    assert is_dataclass(cls)


@pytest.mark.parametrize("cls", BOTH)
@pytest.mark.parametrize(
    ("args", "given", "words"),
    [
        ((), {}, "missing .*'x'"),
        ((), {"y": 1.0}, "missing .*'x'"),
        ((1,), {"z": 1}, "unexpected keyword argument 'z'"),
        ((1,), {"x": 1}, "multiple values for argument 'x'"),
        ((1, 2, [], 4), {}, "positional arguments"),
    ],
)
def test_it_refuses_what_dataclasses_refuse(
    cls: Callable[..., Any], args: tuple[Any, ...], given: dict[str, Any], words: str
) -> None:
    with pytest.raises(TypeError, match=words):
        cls(*args, **given)


@pytest.mark.parametrize("cls", BOTH)
def test_it_is_frozen(cls: Callable[..., Any]) -> None:
    it = cls(1)
    with pytest.raises(FrozenInstanceError, match="cannot assign to field 'x'"):
        it.x = 3
    with pytest.raises(FrozenInstanceError, match="cannot delete field 'x'"):
        del it.x
    assert it.x == 1


def test_it_is_compared_shown_and_copied_by_its_fields() -> None:
    assert Place(1) == Place(1.0) != Place(2)
    assert Place(1) != BOTH[1](1)
    assert len({Base(name="a"), Base(name="A"), Base(name="b")}) == 2
    assert repr(Place(1)) == "Place(x=1, y=2.0, marks=[])"
    assert copy.deepcopy(Place(1)) == pickle.loads(pickle.dumps(Place(1))) == Place(1)
    assert Empty() == Empty()
    assert repr(Empty()) == "Empty()"
    assert Alone() != Alone()
    assert len({Alone(), Alone()}) == 2


def test_heirs_have_the_fields_of_their_bases_first() -> None:
    assert [each.name for each in fields(Heir)] == ["name", "size"]
    assert repr(Heir(size=3, name="a")) == "Heir(name='A', size=3)"
    with pytest.raises(TypeError, match=r"Heir.__init__\(\) missing .*'size'"):
        Heir(name="a")  # type: ignore[call-arg]
    with pytest.raises(TypeError, match="positional"):
        Heir("a", 3)  # type: ignore[call-arg]


def test_help_shows_its_signature() -> None:
    assert str(inspect.signature(Heir)).startswith("(*, name: 'str' = '', size: 'int')")
    assert list(inspect.signature(Place).parameters) == ["x", "y", "marks"]


def test_making_one_compiles_no_methods(monkeypatch: pytest.MonkeyPatch) -> None:
    compiled = []
    execute = builtins.exec

    def counted(*args: Any) -> None:
        compiled.append(args[0])
        execute(*args)

    monkeypatch.setattr(builtins, "exec", counted)

    @frozen(kw_only=True)
    class Made:
        """Made while it counts."""

        x: int = 1
        y: tuple[float, ...] = ()

    assert Made(x=2) == Made(x=2)
    # Python 3.13 and later compile a function without a line in it.
    assert all("self" not in source for source in compiled)
    assert len(compiled) == (sys.version_info >= (3, 13))
    compiled.clear()
    dataclass(frozen=True)(type("Other", (), {"__annotations__": {"x": int}, "__doc__": "Counted."}))
    assert "self" in "".join(compiled)
