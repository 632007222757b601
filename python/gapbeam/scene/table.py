"""The base of the tables of a scene."""

from __future__ import annotations

from typing import Annotated, Literal

from msgspec import Meta, Struct, field

from .typed import plain

# The limits are for editors; the Fortran layer enforces them.
Positive = Annotated[float, Meta(extra_json_schema={"exclusiveMinimum": 0})]
NotNegative = Annotated[float, Meta(extra_json_schema={"minimum": 0})]
Node = Annotated[int, Meta(le=2**31 - 1, extra_json_schema={"minimum": 0})]
Count = Annotated[int, Meta(le=2**31 - 1, extra_json_schema={"minimum": 1})]
Spans = Annotated[list[Positive], Meta(extra_json_schema={"minItems": 1})]
Side = Literal["both", "below", "above"]


class Table(Struct):
    """A table of a scene."""

    def __eq__(self, other: object) -> bool:
        """Whether all keys have equal values, with numpy numbers and arrays for numbers and lists."""
        if type(other) is not type(self):
            return NotImplemented
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
