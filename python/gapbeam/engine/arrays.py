"""A scene in the engine's units, and its results taken back; what does not fit into double precision is refused by name."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NoReturn

import numpy as np

from ..base.errors import EngineError, Status
from ..base.records import Record
from ..scene.wording import number
from .units import LARGEST, ORDINARY_EXPONENT, SMALLEST, Units, scaled

if TYPE_CHECKING:
    from .lowering import Arrays

LONGER, STRONGER = "choose a greater unit of length", "choose a greater unit of force"
"""What to do about deflections, and about forces and moments, that are too great."""
STIFFER = "give a stiffer beam or smaller loads"
"""What to do about rotations that are too great."""
TOO_GREAT_LOADS = "are too great together, or beside the levels at which supports act"


@dataclass(frozen=True, slots=True, eq=False)
class EngineArrays(Record):
    """The arrays of a scene in the engine's units, as in fortran/face/python.f90.

    Attributes
    ----------
    pieces : numpy.ndarray
        Length, 1/EI, 1/GA of every piece, n by 3.
    dead, live : numpy.ndarray
        Loads of every piece, n by 5.
    compliance : numpy.ndarray
        Compliance of the rotational restraint of every node.
    force, couple : numpy.ndarray
        Dead and live force and couple at every node, nodes by 2.
    support_stiffness, support_contact : numpy.ndarray
        Stiffness of every support that can carry, and deflection at which it begins to act.
    """

    pieces: np.ndarray
    dead: np.ndarray
    live: np.ndarray
    compliance: np.ndarray
    force: np.ndarray
    couple: np.ndarray
    support_stiffness: np.ndarray
    support_contact: np.ndarray


def to_engine(arrays: Arrays, units: Units) -> EngineArrays:
    """Take a scene's arrays to the engine's units.

    Parameters
    ----------
    arrays : Arrays
        The lowered scene.
    units : Units
        The engine's units.

    Returns
    -------
    EngineArrays
        All numbers finite; stiffnesses and lengths with all their digits.

    Raises
    ------
    EngineError
        A number left the range of double precision: which one.
    """
    pieces = scaled(arrays.pieces, -units.piece).copy()
    with np.errstate(divide="ignore", over="ignore"):
        pieces[:, 1:] = 1.0 / pieces[:, 1:]
    for column, name in enumerate(("", "EI", "GA")):
        lost = is_lost(pieces[:, column], np.isfinite(arrays.pieces[:, column]))
        for k in np.flatnonzero(lost)[:1]:
            value, where = number(arrays.pieces[k, column]), _stretch(arrays, k, k + 1)
            what, others = f"the stretch {where}, {value} long,", "lengths"
            if name:
                what, others = f"{name} = {value} {where}", "stiffnesses"
            refuse_range(f"{what} is too far from the other {others} of the beam", "bring them nearer together")
    turning, stiffness = scaled(arrays.turning, -units.turning), scaled(arrays.support_stiffness, -units.stiffness)
    with np.errstate(over="ignore"):
        compliance = np.divide(1.0, turning, out=np.zeros(len(turning)), where=turning > 0.0)
    for k in np.flatnonzero(is_lost(compliance, (arrays.turning > 0.0) & np.isfinite(arrays.turning)))[:1]:
        what = f"rotation = {number(arrays.turning[k])} of the supports at x = {number(arrays.node_x[k])}"
        refuse_range(f"{what} is too far from the stiffness of the beam", 'give "fixed" or "free" instead')
    for k in np.flatnonzero(is_lost(stiffness, np.isfinite(arrays.support_stiffness) & (arrays.support_stiffness > 0.0)))[:1]:
        what = f"supports[{arrays.supports[k]}].stiffness = {number(arrays.support_stiffness[k])}"
        refuse_range(f"{what} is too far from the stiffness of the beam", "give inf (rigid) or 0 instead")
    found = EngineArrays(
        pieces=pieces,
        dead=scaled(arrays.dead, -units.load),
        live=scaled(arrays.live, -units.load),
        compliance=compliance,
        force=scaled(arrays.force, -units.force),
        couple=scaled(arrays.couple, -units.moment),
        support_stiffness=stiffness,
        support_contact=scaled(arrays.support_contact, -units.deflection),
    )
    for k in np.flatnonzero(~np.isfinite(found.support_contact))[:1]:
        what = f"supports[{arrays.supports[k]}] acts at a deflection of {number(arrays.support_contact[k])}"
        refuse_range(f"{what}, too far from the deflections that the loads make", "give a smaller one")
    for k in np.flatnonzero(~(np.isfinite(found.dead) & np.isfinite(found.live)).all(axis=1))[:1]:
        refuse_range(f"the loads {_stretch(arrays, k, k + 1)} {TOO_GREAT_LOADS}", "give smaller ones")
    for k in np.flatnonzero(~(np.isfinite(found.force) & np.isfinite(found.couple)).all(axis=1))[:1]:
        refuse_range(f"the loads at x = {number(arrays.node_x[k])} {TOO_GREAT_LOADS}", "give smaller ones")
    return found


def check_links(arrays: Arrays, lost: int) -> None:
    """Refuse links that lost digits, or whose loads are no numbers.

    Parameters
    ----------
    arrays : Arrays
        The lowered scene.
    lost : int
        Number of the first such link, from 1, with a minus where it is its loads; 0 if there is none.

    Raises
    ------
    EngineError
        Names what is farthest from the rest, or the stretch between two nodes.
    """
    if lost > 0:
        refuse_farthest(arrays)
    if lost < 0:
        where = _stretch(arrays, *arrays.node_points[[-lost - 1, -lost]])
        refuse_range(f"the loads {where} {TOO_GREAT_LOADS}", "give smaller ones")


def refuse_farthest(arrays: Arrays) -> NoReturn:
    """Say which of the lengths, stiffnesses and levels is farthest from the others.

    Parameters
    ----------
    arrays : Arrays
        The lowered scene, which left the range of double precision when it was solved.

    Raises
    ------
    EngineError
        Always.
    """
    inner, name = arrays.engine, arrays.supports
    stiff = [
        (column, lambda k, key=key, at=at: f"{key} = {number(arrays.pieces[k, at])} {_stretch(arrays, k, k + 1)}")
        for column, key, at in ((inner.pieces[:, 1], "EI", 1), (inner.pieces[:, 2], "GA", 2))
    ]
    candidates = (
        (inner.pieces[:, 0], lambda k: f"the length of the stretch {_stretch(arrays, k, k + 1)}"),
        *stiff,
        (inner.compliance, lambda k: f"rotation = {number(arrays.turning[k])} of the supports at x = {number(arrays.node_x[k])}"),
        (inner.support_stiffness, lambda k: f"supports[{name[k]}].stiffness = {number(arrays.support_stiffness[k])}"),
        (
            np.abs(inner.support_contact),
            lambda k: f"the deflection of {number(arrays.support_contact[k])} at which supports[{name[k]}] acts",
        ),
    )
    farthest, what = ORDINARY_EXPONENT, ""
    for values, words in candidates:
        found = np.where((values > 0.0) & (values <= LARGEST), np.abs(np.frexp(values)[1]), -1)
        if len(found) and found.max() > farthest:
            farthest, what = int(found.max()), words(int(found.argmax()))
    if what:
        refuse_range(f"{what} is too far from the rest", "bring them nearer together")
    refuse_range("though no length, stiffness or level is far from the rest", "this is an error of gapbeam, please report it")


def to_scene(values: np.ndarray, exponent: int | np.ndarray, x: np.ndarray | float, what: str, remedy: str) -> np.ndarray:
    """Take results from the engine's units to the scene's.

    Parameters
    ----------
    values : numpy.ndarray
        Results in the engine's units.
    exponent : int or numpy.ndarray
        Exponent of their unit.
    x : numpy.ndarray
        Their places.
    what, remedy : str
        What they are, and what to do if they are too great.

    Returns
    -------
    numpy.ndarray
        In the scene's units.

    Raises
    ------
    EngineError
        Numbers that are greater than the largest one in double precision, or no numbers at all.
    """
    found = scaled(values, exponent)
    if not np.isfinite(np.abs(found).max(initial=0.0)):
        place = np.ravel(np.broadcast_to(x, found.shape))[np.argmin(np.isfinite(found))]
        refuse_range(f"the {what} at x = {number(place)} is too great", remedy)
    return found


def is_lost(values: np.ndarray, given: np.ndarray) -> np.ndarray:
    """Tell which numbers left the range in which they have all their digits.

    Parameters
    ----------
    values : numpy.ndarray
        Numbers above 0, if they have not.
    given : numpy.ndarray of bool
        Which of them are to be looked at.

    Returns
    -------
    numpy.ndarray of bool
        One for each.
    """
    return given & ~((values >= SMALLEST) & (values <= LARGEST))


def refuse_range(what: str, remedy: str) -> NoReturn:
    """Say what left the range of double precision.

    Parameters
    ----------
    what : str
        What it is, and why.
    remedy : str
        What to do about it.

    Raises
    ------
    EngineError
        Always.
    """
    raise EngineError(f"numbers left the range of double precision: {what}; {remedy}", Status.NOT_FINITE)


def _stretch(arrays: Arrays, first: int, last: int) -> str:
    return f"from x = {number(arrays.point_x[first])} to x = {number(arrays.point_x[last])}"
