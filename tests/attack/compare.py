"""A state of the program against the exact solution: signs, values, bounds; and a motion against the supports."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
from oracle_forms import dot

from .exact import NoSolution, Redundant, body_work

DIGITS = Fraction(1, 10**12)  # of the largest value of a kind
HALF_UNIT = Fraction(1, 2**53)  # what the last digit of the largest value is worth anyway
SLACK = 1e-9  # of a motion, relative to its largest displacement


def compare_state(beam, step, verdict, where=""):
    """Compare one state.

    Parameters
    ----------
    beam : Exact
    step : gapbeam.states.Step
    verdict : Verdict
        Receives what is wrong, and how far bounds are above the errors.
    where : str
        Said before what is wrong.

    Returns
    -------
    bool
        Whether it was compared; False where forces are not unique.
    """
    factor = Fraction(step.factor)
    closed = [step.state[i] == "closed" for i in beam.one_sided]
    complaints = []
    try:
        found = beam.scheme(closed, factor)
        values, loose = found.at(factor), found.loose
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
            verdict.wrong.append(f"{where}its scheme {step.state} carries nothing")
            return True
        loose = False
        complaints.append("a mechanism as scheme")
    except Redundant:
        return False
    complaints += compare_values(beam, step, values, loose, verdict)
    verdict.wrong += [where + text for text in complaints]
    return True


def exact_values(beam, values, loose):
    """Exact values by kind, in the order of the scene's supports; deflections only where they are unique."""
    found = {"reaction": [values[beam.force_column + i] for i in range(len(beam.supports))]}
    if not loose:
        found["deflection"] = [dot(beam.form(s["x"], 0), values) for s in beam.supports]
    return found


def compare_values(beam, step, values, loose, verdict):
    """What is wrong with the values of a state; bounds count where there are any."""
    complaints = []
    certificate = step.certificate
    for kind, exact in exact_values(beam, values, loose).items():
        computed = [float(v) for v in getattr(step, kind)]
        if not np.all(np.isfinite(computed)):
            complaints.append(f"{kind}: {computed}")
            continue
        error = max((abs(Fraction(a) - b) for a, b in zip(computed, exact, strict=True)), default=Fraction(0))
        bound = stated_bound(step, certificate, kind)
        size = max((abs(b) for b in exact), default=Fraction(0))
        if bound is None:
            if error > DIGITS * max(size, smallest(beam, kind)):
                complaints.append(f"{kind} off by {float(error):.3g} of {float(size):.3g}")
            continue
        if not error <= bound:
            complaints.append(f"{kind} bound {float(bound):.3g} below the error {float(error):.3g} of {float(size):.3g}")
        elif size:
            verdict.ratios.setdefault(kind, []).append(float(bound / max(error, HALF_UNIT * size)))
    return complaints


def smallest(beam, kind):
    """What counts as rounding of nothing: values without bound on scenes where all of a kind are zero."""
    loads = beam.load_size()
    return loads if kind == "reaction" else loads * beam.length


def stated_bound(step, certificate, kind):
    """The bound that a certificate states for a kind of value, absolute; None if it states none."""
    relative = certificate.get(f"error_bound_{kind}")
    if kind in ("deflection", "reaction"):
        bound = step.bounds[0 if kind == "deflection" else 1]
        return None if bound is None else Fraction(bound)
    if relative is None:
        return None
    return Fraction(relative) * Fraction(float(np.abs(getattr(step, kind)).max(initial=0.0)))


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
    for k, (a, b) in enumerate(pairwise([Fraction(0), *sorted(beam.hinges), beam.length])):
        left, right = body_work(beam, factor, a, b)
        work += left * Fraction(ends[k]) + right * Fraction(ends[k + 1])
    if work <= 0:
        faults.append(f"the loads do no work along the motion ({float(work):.3g})")
    return faults
