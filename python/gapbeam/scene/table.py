"""The base of the tables of a scene."""

from __future__ import annotations

from typing import Annotated, Literal

from msgspec import Meta, Struct

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
