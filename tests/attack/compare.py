"""A state of the program against the exact solution: signs, values, bounds; and a motion against the supports."""

from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from math import isfinite

import numpy as np

from .exact import NoSolution, Redundant, falls_surely, moves_freely

HALF_UNIT = Fraction(1, 2**53)  # what the last digit of the largest value is worth anyway
SLIGHT = Fraction(1, 10**11)  # of all loads: as good as none
SLACK = 1e-9  # of a motion, relative to its largest displacement


@dataclass
class Look:
    """Where to look for the fields of a state.

    Attributes
    ----------
    result : gapbeam.Result
    keys : dict
        The state: `step` or `factor`.
    """

    result: object
    keys: dict

    def at(self, x, side):
        """Fields at some places."""
        return self.result.at(x, side=side, **self.keys)

    @property
    def nodes(self):
        """Places of the nodes."""
        return self.result._beam.node_x.tolist()

    def in_scene(self, deflection):
        """Deflections of the nodes, which the engine has in units of its own."""
        return np.ldexp(deflection, self.result._beam.units.deflection).tolist()


def compare_state(beam, step, look, verdict, where=""):
    """Compare one state.

    Parameters
    ----------
    beam : Exact
    step : gapbeam.results.state.step.Step
    look : Look
        Fields of this state.
    verdict : Verdict
        Receives what is wrong, and how far bounds are above the errors.
    where : str
        Said before what is wrong.

    Returns
    -------
    bool
        Whether its values were compared; False where forces are not unique, or an equilibrium hangs on a rounding error.
    """
    factor = Fraction(step.factor)
    closed = [step.state[i] == "closed" for i in beam.one_sided]
    complaints = []
    try:
        found = beam.scheme(closed, factor)
        values, loose = found.at(factor), found.loose
        free = {moves_freely(beam, values, leeway) for leeway in (0, SLIGHT)}
        if free == {not step.indifferent} and not step.undecided:  # an undecided support may be what holds it
            complaints.append(f"said to be {'free to move' if step.indifferent else 'held'}, which it is not")
        wrong = beam.wrong(closed, values) if not loose else [
            i for i, c in zip(beam.one_sided, closed, strict=True) if c and beam.push(i, values) < 0
        ]
        if wrong:
            silent = sorted(set(wrong) - set(step.undecided))
            if silent:
                names = ", ".join(f"{i} ({float(beam.measure(closed, i, values)):.3g})" for i in silent)
                complaints.append(f"wrong signs that are not named undecided, at supports {names}")
            if not loose:
                _, values = beam.settle(closed, factor)
    except NoSolution:
        try:
            _, values = beam.settle(closed, factor)
        except (NoSolution, Redundant):
            falls, sharp = falls_surely(beam, factor)
            if sharp or not falls:
                verdict.wrong.append(f"{where}its scheme {step.state} carries nothing")
            return False
        loose = False
        complaints.append("a mechanism as scheme")
    except Redundant:
        return False
    complaints += compare_values(beam, step, look, values, loose or step.indifferent, verdict)
    verdict.wrong += [where + text for text in complaints]
    return True


def pairs(beam, step, look, values, loose):
    """Kind, bound, and computed and exact values: reactions, deflections of nodes, and all fields along the beam.

    Where some part may lie in more than one place, deflections and rotations are left out.
    """
    bounds = step.error_bounds
    yield "reaction", bounds["reaction"], step.reaction.tolist(), values[beam.force_column : beam.couple_column]
    inside = {Fraction(0): "right", beam.length: "left"}
    # Between the points at doubles: beside a great force half a digit of the place is more than a bound
    places = [*beam.points, *(Fraction(float((a + b) / 2)) for a, b in pairwise(beam.points))]
    fields, exact = [], []
    for side in ("left", "right"):
        fields.append(look.at(list(map(float, places)), side=side))
        exact += [beam.state_at(x, inside.get(x, side), values) for x in places]
    if not loose:
        nodes = {float(x): state[0] for x, state in zip(places, exact, strict=False)}
        yield "deflection", step.bounds[0], look.in_scene(step.solution.deflection), [nodes[x] for x in look.nodes]
    for k, kind in enumerate(("deflection", "rotation", "moment", "shear")):
        if not (loose and k < 2):
            computed = [value for field in fields for value in getattr(field, kind).tolist()]
            yield kind, bounds[kind], computed, [state[k] for state in exact]


def compare_values(beam, step, look, values, loose, verdict):
    """What is wrong with the values of a state: no bound may be below the error."""
    complaints = []
    for kind, bound, computed, exact in pairs(beam, step, look, values, loose or step.indifferent):
        if bound is None or not all(map(isfinite, [bound, *computed])):
            complaints.append(f"{kind}: {computed} with bound {bound}")
            continue
        error = max(abs(Fraction(a) - b) for a, b in zip(computed, exact, strict=True))
        size = max(map(abs, exact))
        if error > bound:
            complaints.append(f"{kind} bound {bound:.3g} below the error {float(error):.3g} of {float(size):.3g}")
        elif size:
            verdict.ratios.setdefault(kind, []).append(float(Fraction(bound) / max(error, HALF_UNIT * size)))
    return complaints


def motion_faults(beam, motion, factor):
    """What is wrong with a motion along which nothing is said to resist.

    Parameters
    ----------
    beam : Reading
    motion : list of (float, float)
    factor : Fraction

    Returns
    -------
    list of str
    """
    if not motion:
        return ["no motion is given"]
    x, w = (np.array(column, dtype=float) for column in zip(*motion, strict=True))
    if not np.all(np.isfinite(w)) or not np.abs(w).max() > 0.0:
        return ["the motion is nothing"]
    w = w / np.abs(w).max()
    faults = []
    cuts = np.array([0.0, *sorted(float(h) for h in beam.hinges), float(beam.length)])
    ends = np.interp(cuts, x, w)
    if np.abs(np.interp(x, cuts, ends) - w).max() > SLACK:
        faults.append("the motion bends where there is no hinge")
    for i, support in enumerate(beam.supports):
        here = float(np.interp(float(support["x"]), x, w))
        if i not in beam.one_sided and abs(here) > SLACK:
            faults.append(f"the motion moves support {i} by {here:.3g}, which holds both ways")
        elif i in beam.one_sided and (here if support["side"] == "below" else -here) > SLACK:
            faults.append(f"the motion goes into support {i} by {here:.3g}")
        if i in beam.turning:
            k = int(np.clip(np.searchsorted(cuts, float(support["x"])), 1, len(cuts) - 1))
            if abs(ends[k] - ends[k - 1]) > SLACK:
                faults.append(f"the motion turns support {i}, which holds the rotation")
    work = Fraction(0)
    for k, body in enumerate(beam.bodies):
        left, right = body.work(factor)
        work += left * Fraction(ends[k]) + right * Fraction(ends[k + 1])
    if work <= 0:
        faults.append(f"the loads do no work along the motion ({float(work):.3g})")
    return faults
