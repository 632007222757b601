"""Solutions of load cases as arrays, of which more can be asked."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ...engine.beam import Beam
from ...engine.case_certificates import BOUNDED, relative_certificate
from ...engine.case_extremes import case_extremes, case_fields
from ...engine.cases import ALWAYS, WANTED, OneCase, split_loads
from ...engine.combinations import Combined, Varied
from ...engine.quantities import BENDING, FIELDS
from ..state.arguments import numbers, whole
from ..state.fields import Fields, find_places
from ..views.extreme import KINDS
from .asked import Asked
from .case_verbs import CaseVerbs

NAMES = ("status", "closed", "reaction", "deflection", "moment_left", "moment_right", "solves")
"""The arrays of cases."""


def _array(name: str) -> property:
    return property(lambda cases: cases._take(name))


class Cases(CaseVerbs):
    """Solutions of load cases; arrays have one row a case, or no such axis after `Prepared.solve` with one case.

    The arrays are read-only. Two are equal if they have the same arrays, but for `solves`. What was not wanted (`want` of
    `Prepared.solve`) is not there.

    Attributes
    ----------
    status : numpy.ndarray of int
        0 solved, 1 no equilibrium, above 10 another reason why there is no unique answer, or why it is refused (11: its axial
        compression is beyond the Euler load); `Prepared.result` of that case says it in words.
        Values of a case that is not solved are not-a-number.
    closed : numpy.ndarray of int
        1 where a support across the beam acts, 0 where it is open or the case is not solved; in the order of the scene.
    reaction : numpy.ndarray
        Reaction of every support across the beam, positive upward.
    deflection : numpy.ndarray
        At every node (`Prepared.node_x`), positive downward.
    moment_left, moment_right : numpy.ndarray
        Left and right of every node, sagging positive.
    solves : numpy.ndarray of int
        Linear solves.
    """

    # A block by OneCase, that, and the supports if they were others; or the arrays by name, what was asked, and the arrays that
    # the engine may fill again
    __slots__ = ("_again", "_arrays", "_block", "_one", "_question", "_single", "_supports")
    __hash__ = None

    status, closed, reaction, deflection, moment_left, moment_right, solves = map(_array, NAMES)

    def _take(self, name: str) -> Any:
        """Take one of the arrays."""
        if self._one is not None:
            values = self._one.take(self._block, name)
        elif self._arrays is None:
            raise AttributeError(f"{name}: these cases were to be filled again (out=), which was interrupted; solve them again")
        elif name not in self._arrays:
            wanted = ", ".join(one for one in NAMES if one in self._arrays and one not in ALWAYS)
            raise AttributeError(f"{name}: not among what was wanted ({wanted or 'nothing else'}); name it in want=")
        else:
            values = self._arrays[name][0] if self._single else self._arrays[name][...]
        if type(values) is np.ndarray:
            values.setflags(write=False)
        return values

    def _fill(
        self, arrays: dict[str, np.ndarray] | None, question: Asked | None, single: bool,
        again: dict[str, np.ndarray] | None = None,
    ) -> None:  # fmt: skip
        """Take arrays with an axis of cases; None while they are filled again."""
        self._one = self._block = None
        self._arrays, self._question, self._single, self._again = arrays, question, single, again

    def _take_arrays(self) -> dict[str, np.ndarray] | None:
        """Give the arrays away to be filled again; until then there are none, as a call that is interrupted may still fill them."""
        if self._one is not None:
            return None
        again = self._again
        self._fill(None, self._question, self._single)
        return again

    @property
    def _beam(self) -> Beam | None:
        """What they are cases of."""
        return self._one.beam if self._one is not None else self._question and self._question.beam

    @property
    def _names(self) -> tuple[str, ...]:
        """What was wanted."""
        return tuple(name for name in WANTED if self._one is not None or name in (self._arrays or WANTED))

    @property
    def _shape(self) -> tuple[int, ...]:
        """Of the status."""
        return () if self._one is not None or self._single else (len(self._question.factors),)

    @property
    def _wanted(self) -> list[str]:
        return [name for name in NAMES if self._one is not None or name in (self._arrays or ())]

    @property
    def _asked(self) -> Asked:
        one = self._one
        if one is None:
            if self._arrays is None:
                raise ValueError("these cases were to be filled again (out=), which was interrupted; solve them again")
            return self._question
        factors = one.take(self._block, "factors")[None].copy()
        varied = Varied(None if self._supports is None else self._supports[None].copy())
        return Asked(one.beam, one.rule, factors, one.take(self._block, "closed")[None], varied, scene=one.scene)

    def __eq__(self, other: object) -> bool:
        """Whether all arrays are equal."""
        if not isinstance(other, Cases):
            return NotImplemented
        names = [name for name in self._wanted if name != "solves"]
        return names == [name for name in other._wanted if name != "solves"] and all(
            np.array_equal(getattr(self, name), getattr(other, name), equal_nan=True) for name in names
        )

    def _made(self, arrays: dict[str, np.ndarray], question: Asked, single: bool) -> Cases:
        return cases_of(arrays, question, single)

    def __reduce__(self) -> tuple:
        """Pickle as arrays."""
        single = self._one is not None or self._single
        arrays = {name: np.array(getattr(self, name), ndmin=1)[None] if single else getattr(self, name) for name in self._wanted}
        for name in ("status", "solves"):
            if single:
                arrays[name] = arrays[name][0]
        return _unpickled, (arrays, self._asked, single)

    def at(self, x: ArrayLike, side: str = "right", *, case: int | None = None, **others: Any) -> Fields:
        """Exact values anywhere along the beam, of all cases in few calls of the engine.

        Parameters
        ----------
        x : float or array_like
            Places along the beam.
        side : {"right", "left"}
            Which value is taken where a field jumps.
        case : int, optional
            The number of one case; default all.
        **others
            ``factor``, ``combination`` and so on are refused: every case is one state.

        Returns
        -------
        Fields
            Of every case a row of the shape of `x` (of one case that shape alone); not-a-number where it is not solved.

        Raises
        ------
        ValueError
            A place outside the beam, or something else than numbers; another side.

        Examples
        --------
        >>> import gapbeam
        >>> beam = gapbeam.prepare({"beam": {"spans": [4.0], "EI": 1.0}, "supports": [{"node": 0}, {"node": 1}],
        ...                         "loads": [{"type": "uniform", "q": 1.0}]})
        >>> beam.solve([[1.0], [3.0]]).at([1.0, 2.0]).moment
        array([[1.5, 2. ],
               [4.5, 6. ]])
        """
        if others:
            raise ValueError(f"{next(iter(others))}: every case is one state at its own factors; leave it out, or give case = 0")
        if case is not None:
            return self[whole("case", case)].at(x, side)
        places = np.array(numbers("x", x))
        beam, shape = self._asked.beam, self._shape + places.shape
        solutions = self._solutions() if set(beam.fields) == set(BENDING) else None
        there = solutions and case_fields(*solutions, *find_places(beam, places.ravel(), side))
        if there is None:
            found = self._asked.solve(places.ravel(), side)
            there = {name: found.fields[:, :, column] for name, column in beam.fields.items()}
        return Fields(places, **{name: values.reshape(shape).copy() for name, values in there.items()})

    @property
    def _known(self) -> dict[str, np.ndarray]:
        """What of `WANTED` there is, with an axis of cases."""
        return {name: np.atleast_2d(getattr(self, name)) for name in self._names}

    def _solutions(self) -> tuple[Any, ...] | None:
        """What fields follow from, as `case_extremes` takes it; None where they do not."""
        return self._asked.solutions(np.atleast_1d(self.status), self._known)

    def _combined(self) -> Combined:
        """Values at all supports and extremes of all fields, of all cases in few calls of the engine.

        Returns
        -------
        Combined
            As arrays, cases along their first axis.
        """
        return self._asked.solve()

    def _pairs_of_extremes(self) -> dict[str, dict[str, tuple[np.ndarray, np.ndarray]]]:
        """Give values and places of the extremes of every field: ``{"moment": {"max": (values, x), ...}, ...}``."""
        return self._extremes_of(self._asked.beam.fields)

    renamed: ClassVar = {"extremes_of": "_extremes_of"}

    def _extremes_of(self, names: Collection[str]) -> dict[str, dict[str, tuple[np.ndarray, np.ndarray]]]:
        """Find those of some fields, each of which takes time of its own.

        Parameters
        ----------
        names : collection of str
            Of the fields.

        Returns
        -------
        dict
            As of `_pairs_of_extremes`.

        Raises
        ------
        ValueError
            There is no such field.
        """
        if wrong := [name for name in names if name not in FIELDS]:
            raise ValueError(f"names: expected some of {', '.join(FIELDS)}; got {wrong[0]!r}")
        shape = self._shape
        solutions = self._solutions()
        there = solutions and case_extremes(*solutions, names)
        if there is None:
            states = self._combined()
            there = {name: (states.extremes[:, FIELDS.index(name)], states.places[:, FIELDS.index(name)]) for name in names}
        return {
            name: {kind: (values[:, row].reshape(shape), x[:, row].reshape(shape)) for row, kind in enumerate(KINDS)}
            for name, (values, x) in there.items()
        }

    def error_bounds(self) -> dict[str, np.ndarray]:
        """Largest errors of deflections, rotations, moments and shears anywhere along the beam, and of the reactions.

        Computed when asked for, as `Step.error_bounds` of each case (see docs/cases.md for how near to those).

        Returns
        -------
        dict
            By kind an array with an entry for every case, in the scene's units; not-a-number where a case is not solved, and for
            deflections and rotations where the beam is free to move.

        Examples
        --------
        >>> import gapbeam
        >>> beam = gapbeam.prepare({"beam": {"spans": [4.0, 4.0], "EI": 1.0}, "supports": [{"node": i} for i in range(3)],
        ...                         "loads": [{"type": "uniform", "q": 1.0}]})
        >>> bool(beam.solve([[1.0], [3.0]]).error_bounds()["reaction"].max() < 1e-12)
        True
        """
        found, _ = self._asked.certified(np.atleast_1d(self.status), self._known)
        return {kind: found[kind].reshape(self._shape) for kind in BOUNDED}

    def certificate(self) -> dict[str, np.ndarray]:
        """How good every case is: what `Step.certificate` has, by name an array with an entry for every case.

        Returns
        -------
        dict
            Relative residuals, and bounds of the errors relative to the largest value of each kind; not-a-number where a case is
            not solved or has no such bound.

        Examples
        --------
        >>> import gapbeam
        >>> beam = gapbeam.prepare({"beam": {"spans": [4.0, 4.0], "EI": 1.0}, "supports": [{"node": i} for i in range(3)],
        ...                         "loads": [{"type": "uniform", "q": 1.0}]})
        >>> bool(beam.solve([[1.0], [3.0]]).certificate()["error_bound"].max() < 1e-12)
        True
        """
        found, reaction = self._asked.certified(np.atleast_1d(self.status), self._known)
        extremes = self._extremes_of(BOUNDED[:-1])
        largest = {kind: np.maximum(*(np.abs(values).ravel() for values, _ in pair.values())) for kind, pair in extremes.items()}
        largest["reaction"] = np.abs(reaction).max(axis=1, initial=0.0)
        return {name: values.reshape(self._shape) for name, values in relative_certificate(found, largest).items()}


def cases_of(arrays: dict[str, np.ndarray] | None, question: Asked | None, single: bool) -> Cases:
    """Make cases of their arrays.

    Parameters
    ----------
    arrays : dict
        By name, one row a case.
    question : Asked
        What was asked.
    single : bool
        Whether it was one case, without an axis of cases.
    """
    cases = object.__new__(Cases)
    cases._fill(arrays, question, single)
    return cases


def _unpickled(arrays: dict[str, np.ndarray], question: Asked, single: bool) -> Cases:
    """Make cases of what `Cases.__reduce__` gives, the beam ready for more of them."""
    split_loads(question.beam)
    return cases_of(arrays, question, single)


def wanted_names(want: str | Collection[str] | None) -> tuple[str, ...]:
    """Check what is wanted of cases.

    Parameters
    ----------
    want : str or collection of str or None
        What the caller gave: names of the arrays of `Cases`, moment for both moments; None: all.

    Returns
    -------
    tuple of str
        Those of `WANTED` that are made.

    Raises
    ------
    ValueError
        Something else.

    Examples
    --------
    >>> wanted_names(("reaction", "moment"))
    ('moment_left', 'moment_right', 'reaction')
    """
    if want is None:
        return WANTED
    known = (*NAMES, "moment")
    names = (want,) if isinstance(want, str) or not isinstance(want, Iterable) else tuple(want)
    wrong = [name for name in names if name not in known]
    if wrong:
        raise ValueError(f"want: expected some of {', '.join(known)}; got {wrong[0]!r}")
    return tuple(name for name in WANTED if name in names or ("moment" in names and name.startswith("moment")))


_NEW, _SET_ONE, _SET_BLOCK, _SET_SUPPORTS = object.__new__, Cases._one.__set__, Cases._block.__set__, Cases._supports.__set__


def case_in_block(one: OneCase, block: np.ndarray, supports: np.ndarray | None, out: Cases | None = None) -> Cases:
    """Make a case of its block.

    Parameters
    ----------
    one : OneCase
        By which it was solved.
    block : numpy.ndarray
        Its results.
    supports : numpy.ndarray or None
        As they were given to `OneCase.solve`.
    out : Cases, optional
        A case in this block, which it becomes.
    """
    cases = out
    if cases is None:
        cases = _NEW(Cases)
        _SET_ONE(cases, one)
        _SET_BLOCK(cases, block)
    _SET_SUPPORTS(cases, supports)
    return cases
