"""Checks of one state that can be done by hand: sums of forces and of moments, and the three-moment equation at a support."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..results import formatting as fmt
from ..scene.names import DEAD, label
from .states import ROW

if TYPE_CHECKING:
    from ..results.result import Result
    from ..results.state.step import Step

DIGITS = 6
"""Of a number that is added by hand."""
MOST_ROWS = 60
"""Rows that are written out; what is more is drawn together."""
POINTS = 5
"""Gauss points of a part of the ground."""
PARTS = 4
"""Parts of the ground between two places where something changes."""


class Term(NamedTuple):
    """A row of the sums: what acts, its force (downward), its arm about the left end, its moment (clockwise)."""

    what: str
    force: float
    arm: float | None
    moment: float


def terms_of(result: Result, step: Step) -> list[Term]:
    """Give all that acts on the beam across it.

    Parameters
    ----------
    result : Result
        Of one load.
    step : Step
        One of its states.

    Returns
    -------
    list of Term
        Loads, reactions, ground.
    """
    scene, found = result.scene, []
    nodes = scene.span_ends()
    for k, load in enumerate(scene.loads):
        kind = load.__struct_config__.tag
        factor = 1.0 if load.case == DEAD else step.factor
        name = f"{kind} {label(scene.loads, k)}"
        if kind in ("force", "moment"):
            x = float(nodes[load.node]) if load.node is not None else load.x
            found.append(Term(name, factor * load.F, x, factor * load.F * x) if kind == "force"
                         else Term(name, 0.0, None, factor * load.M))  # fmt: skip
        elif kind in ("uniform", "linear"):
            (a, b), (qa, qb) = fmt.stretch(scene, load), load.q if kind == "linear" else (load.q, load.q)
            force, first = factor * (qa + qb) / 2 * (b - a), factor * ((qa + qb) / 2 * a + (qa + 2 * qb) / 6 * (b - a)) * (b - a)
            found.append(Term(name, force, first / force if force else (a + b) / 2, first))
    for k, x in enumerate(scene.positions(scene.supports).tolist()):
        name, reaction, couple = f"reaction {label(scene.supports, k)}", float(step.reaction[k]), float(step.couple[k])
        if scene.supports[k].direction == "axial":
            continue
        if reaction:
            found.append(Term(name, -reaction, x, -reaction * x))
        if couple:
            found.append(Term(f"couple of support {label(scene.supports, k)}", 0.0, None, couple))
    return found + _ground(result, step)


def _ground(result: Result, step: Step) -> list[Term]:
    """Pressure of the ground, integrated along the beam by Gauss's rule."""
    if not result._beam.ground_layers:
        return []
    ends = np.unique(np.concatenate((result._beam.places.point_x, [x for run in step.runs for x in (run.from_, run.to)])))
    ends = np.unique(np.concatenate([np.linspace(a, b, PARTS + 1) for a, b in zip(ends[:-1], ends[1:], strict=True)]))
    nodes, weights = np.polynomial.legendre.leggauss(POINTS)
    half = np.diff(ends)[:, None] / 2
    x = ends[:-1, None] + half * (1.0 + nodes)
    pressure = result.at_state(step, x).pressure * half * weights
    force, moment = float(pressure.sum()), float((pressure * x).sum())
    return [Term("pressure of the ground, integrated", -force, moment / force if force else None, -moment)]


def sums_data(result: Result, step: Step) -> dict[str, Any]:
    """Write the sums of forces and of moments about the left end.

    Parameters
    ----------
    result : Result
        Of one load.
    step : Step
        One of its states.

    Returns
    -------
    dict
        ``rows`` in words, ``total`` in words, and ``force``, ``moment``: what the sums leave, as numbers, beside ``largest``.
    """
    terms = terms_of(result, step)
    force, moment = (float(sum(getattr(one, name) for one in terms)) for name in ("force", "moment"))
    sizes = {name: float(sum(abs(getattr(one, name)) for one in terms)) for name in ("force", "moment")}
    shown = terms
    if len(terms) > MOST_ROWS:
        rest = terms[MOST_ROWS - 1 :]
        together = Term(f"{len(rest)} more together", sum(one.force for one in rest), None, sum(one.moment for one in rest))
        shown = [*terms[: MOST_ROWS - 1], together]
    columns = zip(
        (one.what for one in shown), fmt.column([one.force for one in shown], DIGITS),
        ("" if one.arm is None else fmt.number(one.arm, DIGITS) for one in shown),
        fmt.column([one.moment for one in shown], DIGITS), strict=True,
    )  # fmt: skip
    return {
        "rows": [list(row) for row in columns], "force": force, "moment": moment, "sizes": sizes,
        "left": [_leaves(value, sizes[name]) for name, value in (("force", force), ("moment", moment))],
        "written": [written(one.force for one in shown), written(one.moment for one in shown)],
        "ground": bool(result._beam.ground_layers),
    }  # fmt: skip


def written(values: Any, most: int = 16) -> str:
    """Write a sum out.

    Parameters
    ----------
    values : iterable of float
        Its terms.
    most : int
        Terms that are written out; longer sums stand in the table only.

    Returns
    -------
    str

    Examples
    --------
    >>> written([160.0, -71.5, 0.0])
    '160 \N{MINUS SIGN} 71.5'
    """
    texts = [fmt.number(value, DIGITS) for value in values if value]
    if not texts or len(texts) > most:
        return ""
    text = " ".join([texts[0], *(f"- {one[1:]}" if one.startswith("-") else f"+ {one}" for one in texts[1:])])
    return text.replace("-", "\N{MINUS SIGN}").replace("e\N{MINUS SIGN}", "e-")


def _leaves(value: float, size: float) -> str:
    """Say what a sum leaves, as a share of the sum of the sizes of its terms."""
    return "exactly 0" if value == 0.0 else f"{value:.1e}, which is {abs(value) / size:.0e} of the sum of all sizes"


class Joint(NamedTuple):
    """A support, and the pieces of the beam at its sides."""

    support: int
    point: int


def _choose(result: Result, step: Step) -> Joint | None:
    """Choose the inner support with the largest moment, about which both pieces can bend."""
    beam, scene = result._beam, result.scene
    x, pieces = beam.places.point_x, beam.places.pieces
    found = []
    for k, at in enumerate(scene.positions(scene.supports).tolist()):
        point = int(np.argmin(np.abs(x - at)))
        inner = 0 < point < len(x) - 1 and scene.supports[k].direction != "axial" and step.state[k] != "open"
        if inner and np.isfinite(pieces[point - 1 : point + 1, 1]).all() and not np.isclose(x[point], scene.beam.hinges).any():
            found.append((-abs(float(result.at_state(step, x[point]).moment)), k, point))
    return Joint(*min(found)[1:]) if found else None


def three_moments_data(result: Result, step: Step) -> dict[str, Any] | None:
    """Write the three-moment equation at an inner support.

    Parameters
    ----------
    result : Result
        Of one load.
    step : Step
        One of its states.

    Returns
    -------
    dict or None
        Lines of the equation, its two sides and what they differ by; None on the ground, and where no inner support is in contact.
    """
    joint = None if result._beam.ground_layers else _choose(result, step)
    if joint is None:
        return None
    beam, point = step._beam, joint.point
    places, x = beam.places, beam.places.point_x
    left, right = (step.values(*beam.find(x[point - 1 : point + 2], side)) for side in (True, False))
    w = right[ROW["deflection"]].tolist()
    m = [right[ROW["moment"]][0], left[ROW["moment"]][1], right[ROW["moment"]][1], left[ROW["moment"]][2]]
    moments = [float(one) for one in m]
    (l1, ei1, ga1), (l2, ei2, ga2) = places.pieces[point - 1 : point + 1].tolist()
    loads = places.dead + step.factor * places.live
    (qa, qb, k1), (qc, qd, k2) = loads[point - 1 : point + 1, :3].tolist()
    r = ei1 / ei2
    n = {key: fmt.number(value, DIGITS) for key, value in {
        "l1": l1, "l2": l2, "r": r, "ei": ei1, "ei2": ei2, "ga1": ga1, "ga2": ga2, "qa": qa, "qb": qb, "qc": qc, "qd": qd, "k1": k1,
        "k2": k2, "w0": w[0], "w1": w[1], "w2": w[2], "m0": moments[0], "m1": moments[1], "m2": moments[2], "m3": moments[3],
    }.items()}  # fmt: skip
    times = "" if r == 1.0 else f"{n['r']} \u00b7 "
    bending = moments[0] * l1 + 2 * moments[1] * l1 + r * (2 * moments[2] * l2 + moments[3] * l2)
    lines = [f"{n['m0']} \u00b7 {n['l1']} + 2 \u00b7 ({n['m1']}) \u00b7 {n['l1']} + {times}(2 \u00b7 ({n['m2']}) \u00b7 {n['l2']} + "
             f"({n['m3']}) \u00b7 {n['l2']}) = {fmt.number(bending, DIGITS)}"]  # fmt: skip
    load = (7 * qa + 8 * qb) * l1**3 / 60 + r * (8 * qc + 7 * qd) * l2**3 / 60
    if load:
        lines.append(f"distributed load: (7 \u00b7 {n['qa']} + 8 \u00b7 {n['qb']}) \u00b7 {n['l1']}\u00b3/60 + {times}(8 \u00b7 {n['qc']} "
                     f"+ 7 \u00b7 {n['qd']}) \u00b7 {n['l2']}\u00b3/60 = {fmt.number(load, DIGITS)}")  # fmt: skip
    curvature = 3 * ei1 * (k1 * l1 + k2 * l2)
    if curvature:
        lines.append(f"imposed curvature: 3 \u00b7 {n['ei']} \u00b7 ({n['k1']} \u00b7 {n['l1']} + {n['k2']} \u00b7 {n['l2']}) = "
                     f"{fmt.number(curvature, DIGITS)}")  # fmt: skip
    chords = 6 * ei1 * ((w[1] - w[0]) / l1 - (w[2] - w[1]) / l2)
    lines.append(f"deflections: 6 \u00b7 {n['ei']} \u00b7 (({n['w1']} - {n['w0']})/{n['l1']} - ({n['w2']} - {n['w1']})/{n['l2']}) = "
                 f"{fmt.number(chords, DIGITS)}")  # fmt: skip
    shear = 0.0
    if np.isfinite([ga1, ga2]).any():
        shear = 6 * ei1 * ((moments[3] - moments[2]) / (l2 * ga2) - (moments[1] - moments[0]) / (l1 * ga1))
        lines.append(f"shear flexibility: 6 \u00b7 {n['ei']} \u00b7 (({n['m3']} - {n['m2']})/({n['l2']} \u00b7 {n['ga2']}) - "
                     f"({n['m1']} - {n['m0']})/({n['l1']} \u00b7 {n['ga1']})) = {fmt.number(shear, DIGITS)}")  # fmt: skip
    sides = bending + load + curvature, chords + shear
    size = sum(abs(one) for one in (*(moments[k] * l for k, l in ((0, l1), (1, 2 * l1), (2, 2 * r * l2), (3, r * l2))), load, curvature,
                                    chords, shear)) or 1.0  # fmt: skip
    return {
        "support": fmt.support(result.scene, joint.support), "x": [fmt.number(one, DIGITS) for one in x[point - 1 : point + 2].tolist()],
        "lines": [line.replace("-", "\N{MINUS SIGN}").replace("e\N{MINUS SIGN}", "e-") for line in lines], "sides": sides, "ratio": n["r"],
        "written": [fmt.number(one, DIGITS) for one in sides], "left": _leaves(sides[0] - sides[1], size), "size": size,
        "ei": n["ei"], "load": bool(load), "curvature": bool(curvature), "shear": bool(shear),
    }  # fmt: skip
