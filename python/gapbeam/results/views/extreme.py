"""Largest and smallest values: the value, its place, where it comes from, and what goes with it."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from ...base.hints import Named, no_such
from .. import formatting as fmt

if TYPE_CHECKING:
    from ..state.ground import FreeSpan
    from ..state.step import Step

KINDS = ("max", "min")
IN_WORDS = dict(zip(KINDS, ("largest", "smallest"), strict=True))
SYMBOLS = {"m": "moment", "v": "shear", "q": "shear", "w": "deflection", "n": "axial_force", "displacement": "deflection",
           "bending": "moment", "force": "shear", "phi": "rotation", "u": "axial_displacement", "p": "pressure",
           "kappa": "curvature"}  # fmt: skip
"""Fields by the symbols of others."""


def given_of(row: NamedTuple) -> dict[str, Any]:
    """As plain data.

    Returns
    -------
    dict
        What is None is left out.
    """
    return {key: value for key, value in row._asdict().items() if value is not None}


class Source(NamedTuple):
    """Where a value comes from.

    Attributes
    ----------
    combination : str or None
        Name of the combination; None in a scene without any.
    factor : float or None
        Load factor, where the load is followed; None at full load.
    leg : int or None
        Which factor of the history was gone to there, from 0; -1 at a limit while the dead loads were put on, whose factor
        it is then.
    train : str or None
        Name of the train; None where no train acts.
    position : float or None
        Its position.
    direction : {"right", "left"} or None
        Which way it goes.
    side : {"left", "right"} or None
        On which side of the place it is the value, where an axle or a support is there.
    """

    combination: str | None = None
    factor: float | None = None
    leg: int | None = None
    train: str | None = None
    position: float | None = None
    direction: str | None = None
    side: str | None = None

    to_dict = given_of

    def __call__(self) -> dict[str, Any]:
        """Give the same as `to_dict`: of a train it was a method."""
        warnings.warn("source of an extreme is an attribute; call source.to_dict()", DeprecationWarning, stacklevel=2)
        return self.to_dict()

    def __repr__(self) -> str:
        """Show what is known."""
        return f"Source({', '.join(f'{key}={value!r}' for key, value in self.to_dict().items())})"


class Extreme:
    """A largest or smallest value; of many cases arrays of them.

    Attributes
    ----------
    quantity : str
        For example ``moment`` or ``reaction``.
    value : float
        The value.
    x : float or None
        Its place; None for a foundation.
    source : Source
        Where it comes from: the first one of those that tie.
    concurrent : dict of float
        What the other quantities are there, in the same state.
    support, foundation : int or None
        Number of the support, or of the foundation, that it belongs to.
    span : FreeSpan or None
        The free span, if it is one's length or sag.
    """

    concurrent: dict[str, float]

    def __init__(
        self, quantity: str, value: float, x: float | None, source: Source, support: int | None = None,
        foundation: int | None = None, span: FreeSpan | None = None,
    ):  # fmt: skip
        self.quantity, self.value, self.x, self.source = quantity, value, x, source
        self.support, self.foundation, self.span = support, foundation, span

    combination = property(lambda one: one.source.combination, doc="Name of the combination it comes from.")
    factor = property(lambda one: one.source.factor, doc="Load factor it comes from, where the load is followed; else None.")
    leg = property(lambda one: one.source.leg, doc="Which factor of the history was gone to there, from 0; else None.")
    train = property(lambda one: one.source.train, doc="Name of the train.")
    position = property(lambda one: one.source.position, doc="Position of the train.")
    direction = property(lambda one: one.source.direction, doc="Which way the train goes.")
    side = property(lambda one: one.source.side, doc="On which side of the place it is the value; None where both have it.")

    @property
    def state(self) -> Step:
        """The state in which it is the value."""
        raise NotImplementedError

    def __repr__(self) -> str:
        """Show value, place and source."""
        where = "" if self.x is None else f" at x = {_word(self.x)}"
        where = f" of foundation {self.foundation}" if self.foundation is not None else where
        span = "" if self.span is None else f" from x = {self.span.from_:.6g} to {self.span.to:.6g}"
        source = f", {self.source}" if any(one is not None for one in self.source) else ""
        return f"Extreme({self.quantity} {_word(self.value)}{where}{span}{source})"


def _word(value: Any) -> str:
    return fmt.number(value) if isinstance(value, float) else str(value)


class Extremes(Mapping[str, dict[str, Extreme]]):
    """Largest and smallest values by quantity, each with its place and source; found when first looked at.

    Parameters
    ----------
    find : callable
        Gives them, by quantity, then by ``max`` and ``min``, or what has them as ``extremes``.
    call : callable, optional
        What calling gave when this was a method.
    instead : str
        What to write instead of the call.

    Examples
    --------
    >>> import gapbeam
    >>> result = gapbeam.solve({"beam": {"spans": [4.0], "EI": 1e4}, "supports": [{"node": 0}, {"node": 1}],
    ...                         "loads": [{"type": "force", "x": 1.0, "F": 8.0}]})
    >>> largest = result.extremes["moment"]["max"]
    >>> largest.value, largest.x, round(largest.concurrent["deflection"], 6)
    (6.0, 1.0, 0.0006)
    >>> result.extremes["M"]
    Traceback (most recent call last):
    ...
    KeyError: "there is no field 'M'; did you mean 'moment'?"
    """

    __hash__ = None

    def __init__(
        self, find: Callable[[], Any], call: Callable[..., Any] | None = None, instead: str = ""
    ) -> None:
        self._find, self._call, self._instead = find, call, instead
        self._known: Mapping[str, dict[str, Any]] | None = None

    @property
    def _all(self) -> Mapping[str, dict[str, Any]]:
        if self._known is None:
            found = self._find()
            self._known = getattr(found, "extremes", found)
        return self._known

    def __getitem__(self, key: str) -> dict[str, Extreme]:
        """Give ``{"max": Extreme, "min": Extreme}`` of a quantity.

        Raises
        ------
        KeyError
            There is no such quantity.
        """
        found = self._all
        if key not in found:
            raise KeyError(no_such("field", key, found, SYMBOLS))
        return found[key]

    def __iter__(self) -> Iterator[str]:
        """Go through the quantities."""
        return iter(self._all)

    def __len__(self) -> int:
        """Count the quantities."""
        return len(self._all)

    def __call__(self, *args: Any, **keys: Any) -> Any:
        """Give what the method gave that this was: values and places without anything else."""
        if self._call is None:
            raise TypeError("extremes are an attribute: leave the brackets out")
        warnings.warn(f"extremes are an attribute: write {self._instead}", DeprecationWarning, stacklevel=2)
        found = self._call(*args, **keys)
        return Named("field", found, SYMBOLS) if isinstance(found, dict) else found

    def __repr__(self) -> str:
        """Show a line for each value."""
        return "\n".join(f"{kind} {one!r}" for row in self.values() for kind, one in row.items())
