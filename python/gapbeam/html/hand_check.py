"""The sums of forces and of moments of one state, written out so that they can be added by hand."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..base.characters import with_minus_signs
from ..results import formatting as fmt
from ..results.equilibrium import moments_on_deflected_axis, resultants_of_loads
from ..scene.names import label
from ..scene.rotations import turns

if TYPE_CHECKING:
    from ..results.result import Result
    from ..results.state.step import Step

DIGITS = 6
"""Of a number that is added by hand."""
MOST_ROWS = 150
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
    for k, one in enumerate(resultants_of_loads(scene, step.factor)):
        if one.force or one.moment:
            name = f"{scene.loads[k].__struct_config__.tag} {label(scene.loads, k)}"
            found.append(Term(name, one.force, one.moment / one.force if one.force else None, one.moment))
    for k, x in enumerate(scene.positions(scene.supports).tolist()):
        name, reaction, couple = f"reaction {label(scene.supports, k)}", float(step.reaction[k]), float(step.couple[k])
        if scene.supports[k].direction == "axial":
            continue
        if reaction and not turns(scene.supports[k]):
            found.append(Term(name, -reaction, x, -reaction * x))
        if couple:
            found.append(Term(f"couple of support {label(scene.supports, k)}", 0.0, None, couple))
    for one in moments_on_deflected_axis(result, step):
        found.append(Term(f"{one.of} along the deflected axis at {fmt.number(one.x, fmt.DIGITS)}", 0.0, None, one.moment))
    return found + _ground(result, step)


def _ground(result: Result, step: Step) -> list[Term]:
    """Pressure of the ground, integrated along the beam by Gauss's rule."""
    if not result._beam.ground_layers:
        return []
    ends = np.unique(np.concatenate((result._beam.places.point_x, [x for run in step.runs for x in (run.from_, run.to)])))
    ends = np.unique(np.concatenate([np.linspace(a, b, PARTS + 1) for a, b in pairwise(ends)]))
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
        "totals": ["0" if value == 0.0 else with_minus_signs(f"{value:.1e}") for value in (force, moment)],
        "left": [leaves(value, sizes[name]) for name, value in (("force", force), ("moment", moment))],
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

    Examples
    --------
    >>> written([160.0, -71.5, 0.0])
    '160 \N{MINUS SIGN} 71.5'
    """
    texts = [fmt.number(value, DIGITS) for value in values if value]
    if not texts or len(texts) > most:
        return ""
    return with_minus_signs(" ".join([texts[0], *(f"- {one[1:]}" if one.startswith("-") else f"+ {one}" for one in texts[1:])]))


def leaves(value: float, size: float) -> str:
    """Say what a sum leaves, beside the sum of the sizes of its terms.

    Parameters
    ----------
    value, size : float
        Both sums.
    """
    if value == 0.0:
        return "exactly 0"
    return f"{with_minus_signs(f'{value:.1e}')}, which is {abs(value) / size:.0e} of the sum of all sizes"
