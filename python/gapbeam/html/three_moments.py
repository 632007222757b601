"""The three-moment equation of one state at an inner support, written out so that it can be checked by hand."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..base.characters import with_minus_signs
from ..results import formatting as fmt
from ..results.formatting import stretch
from ..scene.tapers import is_tapered
from .hand_check import DIGITS, leaves
from .states import ROW

if TYPE_CHECKING:
    from ..results.result import Result
    from ..results.state.step import Step

DOT, CUBE = " \N{MIDDLE DOT} ", "\N{SUPERSCRIPT THREE}"


class Side(NamedTuple):
    """A piece of the beam at one side of the support.

    Attributes
    ----------
    length, EI, GA : float
        Of the piece.
    far, near : float
        Moments at its end away from the support, and at the support.
    q_far, q_near : float
        Load per length there.
    kappa : float
        Imposed curvature.
    slope : float
        Deflection at its right end less that at its left end, over its length.
    """

    length: float
    EI: float
    GA: float
    far: float
    near: float
    q_far: float
    q_near: float
    kappa: float
    slope: float


def three_moments_data(result: Result, step: Step) -> dict[str, Any] | None:
    """Write the three-moment equation at the inner support with the largest moment.

    Parameters
    ----------
    result : Result
        Of one load.
    step : Step
        One of its states.

    Returns
    -------
    dict or None
        Lines of the equation, its two sides and what they differ by; None on the ground, and where no inner support is in contact
        about which both pieces can bend.
    """
    chosen = None if result._beam.in_stretches else _choose(result, step)
    if chosen is None:
        return None
    support, point = chosen
    beam, x = step._beam, step._beam.places.point_x[point - 1 : point + 2]
    right, left = (step.values(*beam.find(x, side)) for side in (False, True))
    w, m = right[ROW["deflection"]].tolist(), ROW["moment"]
    pieces = beam.places.pieces[point - 1 : point + 1].tolist()
    loads = (beam.places.dead + step.factor * beam.places.live)[point - 1 : point + 1, :3].tolist()
    slopes = [(w[k + 1] - w[k]) / pieces[k][0] for k in (0, 1)]
    one = Side(*pieces[0], float(right[m][0]), float(left[m][1]), *loads[0], slopes[0])
    other = Side(*pieces[1], float(left[m][2]), float(right[m][1]), loads[1][1], loads[1][0], loads[1][2], slopes[1])
    terms = _terms(one, other, w)
    lines = [f"{words}{': ' if words else ''}{text} = {_number(value)}" for words, text, value, _ in terms]
    sides = [sum(value for _, _, value, on_left in terms if on_left is side) for side in (True, False)]
    parts = [one.length * one.far, 2 * one.length * one.near, 2 * other.length * other.near, other.length * other.far]
    size = sum(map(abs, parts)) + sum(abs(value) for _, _, value, _ in terms[1:]) or 1.0
    there = {words for words, *_ in terms}
    return {
        "support": fmt.support(result.scene, support), "x": list(map(_number, x.tolist())),
        "lines": list(map(with_minus_signs, lines)),
        "sides": sides, "written": [with_minus_signs(_number(value)) for value in sides], "left": leaves(sides[0] - sides[1], size),
        "size": size, "EI": _number(one.EI), "ratio": _number(one.EI / other.EI), "load": LOAD in there,
        "curvature": CURVATURE in there, "shear": SHEAR in there,
    }  # fmt: skip


LOAD, CURVATURE, DEFLECTIONS, SHEAR = "distributed load", "imposed curvature", "deflections", "shear flexibility"


def _terms(one: Side, other: Side, w: list[float]) -> list[tuple[str, str, float, bool]]:
    """Give the terms: words, how they are worked out, value, and whether they stand on the left side."""
    ratio, f = one.EI / other.EI, _in_brackets
    times, l1, l2 = "" if ratio == 1.0 else f"{f(ratio)}{DOT}", f(one.length), f(other.length)
    bending = one.length * (one.far + 2 * one.near) + ratio * other.length * (2 * other.near + other.far)
    text = f"{l1}{DOT}({f(one.far)} + 2{DOT}{f(one.near)}) + {times}{l2}{DOT}(2{DOT}{f(other.near)} + {f(other.far)})"
    found = [("moments", text, bending, True)]
    loads = [(7 * side.q_far + 8 * side.q_near) * side.length**3 / 60 for side in (one, other)]
    if any(loads):
        texts = [f"(7{DOT}{f(side.q_far)} + 8{DOT}{f(side.q_near)}){DOT}{f(side.length)}{CUBE}/60" for side in (one, other)]
        found.append((LOAD, f"{texts[0]} + {times}{texts[1]}", loads[0] + ratio * loads[1], True))
    if one.kappa or other.kappa:
        text = f"-3{DOT}{f(one.EI)}{DOT}({f(one.kappa)}{DOT}{l1} + {f(other.kappa)}{DOT}{l2})"
        found.append((CURVATURE, text, -3 * one.EI * (one.kappa * one.length + other.kappa * other.length), True))
    text = f"6{DOT}{f(one.EI)}{DOT}(({f(w[1])} - {f(w[0])})/{l1} - ({f(w[2])} - {f(w[1])})/{l2})"
    found.append((DEFLECTIONS, text, 6 * one.EI * (one.slope - other.slope), False))
    if np.isfinite([one.GA, other.GA]).any():
        parts = [(side.far - side.near) / (side.length * side.GA) for side in (one, other)]
        texts = [f"({f(side.far)} - {f(side.near)})/({f(side.length)}{DOT}{f(side.GA)})" for side in (one, other)]
        found.append((SHEAR, f"6{DOT}{f(one.EI)}{DOT}({texts[0]} + {texts[1]})", 6 * one.EI * sum(parts), False))
    return found


def _number(value: float) -> str:
    return fmt.number(value, DIGITS)


def _in_brackets(value: float) -> str:
    text = _number(value)
    return f"({text})" if text.startswith("-") else text


def _choose(result: Result, step: Step) -> tuple[int, int] | None:
    """Choose the inner support with the largest moment, about which both pieces can bend: its number, and that of its point."""
    beam, scene = step._beam, result.scene
    x, pieces = beam.places.point_x, beam.places.pieces
    turned = any(getattr(load, "rotation", None) is not None or getattr(load, "at_hinge", None)
                 or isinstance(getattr(load, "kappa", None), tuple) for load in scene.loads)  # fmt: skip
    tapered = [stretch(scene, section) for section in scene.sections if is_tapered(section)]
    found = []
    for k, at in enumerate(scene.positions(scene.supports).tolist()):
        point = int(np.argmin(np.abs(x - at)))
        inner = 0 < point < len(x) - 1 and scene.supports[k].direction != "axial" and step.state[k] != "open"
        hinges = [*scene.beam.hinges, *scene.positions(scene.hinges)]
        tapers = inner and any(a <= x[point + 1] and b >= x[point - 1] for a, b in tapered)
        bends = inner and not (tapers or turned) and np.isfinite(pieces[point - 1 : point + 1, 1]).all()
        if bends and not np.isclose(x[point], hinges).any():
            found.append((-abs(float(result.at_state(step, x[point]).moment)), k, point))
    return min(found)[1:] if found else None
