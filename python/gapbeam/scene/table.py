"""The base of the tables of a scene."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from msgspec import Meta, Struct, StructMeta, field

from ..base.hints import nearest
from .synonyms import meant_by_key
from .typed import plain

# The limits are for editors; the Fortran layer enforces them.
Positive = Annotated[float, Meta(extra_json_schema={"exclusiveMinimum": 0})]
NotNegative = Annotated[float, Meta(extra_json_schema={"minimum": 0})]
Node = Annotated[int, Meta(le=2**31 - 1, extra_json_schema={"minimum": 0})]
Count = Annotated[int, Meta(le=2**31 - 1, extra_json_schema={"minimum": 1})]
Modes = Annotated[int, Meta(ge=0, le=1000)]
Spans = Annotated[list[Positive], Meta(extra_json_schema={"minItems": 1})]
Side = Literal["both", "below", "above"]
SupportSide = Literal["both", "below", "above", "left", "right", "counterclockwise", "clockwise", "sagging", "hogging"]
TurnSide = Literal["both", "counterclockwise", "clockwise"]
HingeSide = Literal["both", "sagging", "hogging", "counterclockwise", "clockwise"]


class _Hinting(StructMeta):
    """Tables that say what was probably meant, when they are made with a key that they have not."""

    def __call__(cls, *args: Any, **keys: Any) -> Any:
        """Make a table."""
        try:
            return StructMeta.__call__(cls, *args, **keys)
        except TypeError as error:
            raise TypeError(_problem(cls, args, keys) or str(error)) from None


def _problem(cls: type[Struct], args: tuple, keys: dict[str, Any]) -> str | None:
    """Say what is wrong with the keys of a table."""
    known = list(cls.__struct_fields__)
    wrong = next((key for key in keys if key not in known), None)
    if wrong is not None:
        near = nearest(wrong, known, 0.55)
        place = "supports" if "settlement" in known else ""
        hint = meant_by_key(wrong, known, place) or (f'did you mean "{near}"?' if near else f"there are {', '.join(known)}")
        return f"{cls.__name__} has no {wrong!r}; {hint}"
    most = len(cls.__match_args__)
    if len(args) > most:
        first = ", ".join(f"{key} = ..." for key in known[most : most + 2])
        return f"{cls.__name__} takes {most or 'no'} values without a key; write {cls.__name__}({first})"
    return None


def kind_of(table: Struct) -> type[Struct]:
    """Give the type of a table, the same for one that cannot be changed (`held`)."""
    return getattr(type(table), "changeable", type(table))


class Table(Struct, metaclass=_Hinting):
    """A table of a scene."""

    def __eq__(self, other: object) -> bool:
        """Whether all keys have equal values, with numpy numbers and arrays for numbers and lists."""
        if type(other) is not type(self):
            if not isinstance(other, Table) or kind_of(other) is not kind_of(self):
                return NotImplemented
            return all(getattr(self, name) == getattr(other, name) for name in self.__struct_fields__)
        try:
            return bool(super().__eq__(other))
        except ValueError:  # numpy compares arrays element by element
            return plain(self) == plain(other)


class Stretch(Table, forbid_unknown_fields=True, kw_only=True, gc=False):
    """What acts from one place to another.

    Parameters
    ----------
    from_ : float
        Left end of the stretch (length, from the left end of the beam); default: the beam's left end.
        In Python the name is ``from_``.
    to : float, optional
        Right end of the stretch (length, from the left end of the beam); default: the beam's right end.
    """

    from_: float = field(default=0.0, name="from")
    to: float | None = None


class Point(Table, forbid_unknown_fields=True, kw_only=True, gc=False):
    """What acts at one place.

    Parameters
    ----------
    node : int, optional
        Place by node: 0 = left end, i = right end of the i-th span. Give either node or x.
    x : float, optional
        Place by distance from the left end (length). Give either node or x.
    name : str, optional
        Its name, unique among supports or among loads; shown instead of its number.
    """

    node: Node | None = None
    x: float | None = None
    name: str | None = None
