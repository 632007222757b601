"""Beams on rigid ground: are the conditions of the least energy fulfilled, by statics and integration without gapbeam.

The energy is convex, and so is the set of deflections that the ground allows. So a state is that of least energy if it is in
equilibrium, bends as its moments say, goes nowhere through the ground, and if the ground pushes only where it is touched.
"""

from __future__ import annotations

from functools import partial

import numpy as np
from scenes.tapered import stiffness_along

SAMPLES = 400
"""Places in every stretch at which beam and ground are compared."""
TERMS = 60
"""Of Taylor series: enough where a stretch is up to ten times as long as sqrt(EI/N)."""


def excess(scene: dict, result) -> dict[str, float]:
    """Tell by how much a solved beam fails each condition, relative to the largest of its kind.

    Parameters
    ----------
    scene : dict
        Spans, EI and N (lists), sections that taper (without N), hinges, one-sided rigid foundations with gap or profile,
        supports without laws, loads, all with x.
    result : gapbeam.Result
        What gapbeam says of it.
    """
    step, beam, inf = result.steps[-1], scene["beam"], float("inf")
    ends = np.append(0.0, np.cumsum(beam["spans"]))
    length = float(ends[-1])
    forces, couples, lines, bends = [], [], [], []
    for load in scene["loads"]:
        if load["type"] == "force":
            forces.append((load["x"], load["F"]))
        elif load["type"] == "moment":
            couples.append((load["x"], load["M"]))
        elif load["type"] == "curvature":
            bends.append((load.get("from", 0.0), load.get("to", length), load["kappa"]))
        else:
            q = load["q"] if isinstance(load["q"], list) else [load["q"]] * 2
            lines.append((load.get("from", 0.0), load.get("to", length), *q))
    forces += [(s["x"], -float(up)) for s, up in zip(scene["supports"], step.reaction, strict=True)]
    forces += [(c.from_, -c.resultant) for c in step.contact if c.from_ == c.to]
    places = [
        *ends,
        *(x for x, _ in forces + couples),
        *beam.get("hinges", ()),
        *(x for line in lines + bends for x in line[:2]),
    ]
    places += [x for c in step.contact for x in (c.from_, c.to)]
    for f in scene["foundation"]:
        places += [
            f.get("from", 0.0),
            f.get("to", length),
            *(x for x, _ in f.get("profile", ()) if 0.0 < x < length),
        ]
    places += [one[end] for one in scene.get("sections", ()) for end in ("from", "to")]
    places = np.unique(places)
    zones = [c for c in step.contact if c.to > c.from_]
    size = {
        "force": sum(abs(f) for _, f in forces)
        + sum((b - a) * max(abs(p), abs(q)) for a, b, p, q in lines)
        + 1e-300
    }
    size["moment"] = size["force"] * length + sum(abs(m) for _, m in couples)
    at = result.at(np.array([0.0]))
    w, psi, moment, force = float(at.deflection[0]), float(at.rotation[0]), 0.0, 0.0
    found = dict.fromkeys(("equilibrium", "bending", "through", "touch", "pull", "supports"), 0.0)
    levels = [float(np.abs(level(f, places, length)).max()) for f in scene["foundation"]]
    size["moment"] += max((abs(value) for *_, value in bends), default=0.0) * max(beam["EI"])
    size["deflection"] = max(
        *levels,
        size["moment"] * length**2 / min(beam["EI"]),
        float(np.abs(result.at(places).deflection).max()),
    )
    for k, x in enumerate(places):
        force -= sum(f for at_x, f in forces if at_x == x)
        moment += sum(m for at_x, m in couples if at_x == x)
        if x in beam.get("hinges", ()):
            found["equilibrium"] = max(found["equilibrium"], abs(moment) / size["moment"])
            psi = float(result.at(float(x)).rotation)
        if k == len(places) - 1:
            break
        h = places[k + 1] - x
        middle = x + h / 2
        span = min(int(np.searchsorted(ends, middle)) - 1, len(beam["EI"]) - 1)
        ei, pull = beam["EI"][span], beam["N"][span] if "N" in beam else 0.0
        p = np.zeros(2)
        for a, b, left, right in lines:
            if a < middle < b:
                p += [left + (right - left) * (y - a) / (b - a) for y in (x, x + h)]
        if any(c.from_ < middle < c.to for c in zones):
            pressure = [float(result.at(x + share * h).pressure) for share in (0.25, 0.75)]
            slope = (pressure[1] - pressure[0]) * 2
            pressure = np.array([pressure[0] - slope / 4, pressure[1] + slope / 4])
            found["pull"] = max(found["pull"], -pressure.min() / (abs(p).max() + 1e-300))
            p -= pressure
        t = np.linspace(0.0, 1.0, SAMPLES) * h
        kappa = sum(value for a, b, value in bends if a < middle < b)
        state, fall = (w, psi, moment, force), (p[1] - p[0]) / h
        section = next((one for one in scene.get("sections", ()) if one["from"] < middle < one["to"]), None)
        if section:
            ei = partial(stiffness_along, section["EI"], section)
            along, w, psi, moment = tapered(state, kappa, p[0], fall, lambda at, x=x, EI=ei: EI(x + at), t)
        else:
            rates = rates_of(*state, kappa, p[0], fall, ei, pull)
            along = taylor(rates, t)
            w, psi, bend = (float(taylor(rates[k:], h)) for k in range(3))
            moment = ei * (kappa - bend)
        told = result.at(x + t).deflection
        found["bending"] = max(found["bending"], float(np.abs(along - told)[1:-1].max()) / size["deflection"])
        for f in scene["foundation"]:
            if not f.get("from", 0.0) < middle < f.get("to", length):
                continue
            side = 1.0 if f["side"] == "below" else -1.0
            depth = side * (along - level(f, x + t, length))
            found["through"] = max(found["through"], float(depth.max()) / size["deflection"])
            if any(c.from_ < middle < c.to for c in zones):
                found["touch"] = max(found["touch"], float(np.abs(depth).max()) / size["deflection"])
        force -= p.sum() / 2 * h
    found["equilibrium"] = max(found["equilibrium"], abs(force) / size["force"], abs(moment) / size["moment"])
    for c in step.contact:
        if c.from_ != c.to:
            continue
        f = scene["foundation"][c.foundation]
        side = 1.0 if f["side"] == "below" else -1.0
        found["pull"] = max(found["pull"], -side * c.resultant / size["force"])
        away = abs(float(result.at(c.from_).deflection) - float(level(f, c.from_, length)))
        found["touch"] = max(found["touch"], away / size["deflection"])
    for s, up, down in zip(
        scene["supports"], map(float, step.reaction), map(float, step.deflection), strict=True
    ):
        side = {"below": 1.0, "above": -1.0, "both": 0.0}[s.get("side", "both")]
        contact = s.get("settlement", 0.0) + side * s.get("gap", 0.0)
        past, k = down - contact, s.get("stiffness", inf)
        if side:
            past = max(side * past, 0.0) * side if k < inf else past
        if k < inf:
            found["supports"] = max(found["supports"], abs(up - k * past) / size["force"])
        elif abs(up) > 1e-12 * size["force"]:
            found["supports"] = max(
                found["supports"], abs(past) / size["deflection"], -side * up / size["force"]
            )
        elif side:
            found["supports"] = max(found["supports"], side * past / size["deflection"])
    return found


def rates_of(w, psi, moment, force, kappa, p, fall, EI, pull):
    """Give the derivatives of the deflection of a bar by x at one place, from the 0th: EI w(4) - N w(2) = p.

    Parameters
    ----------
    w, psi, moment, force : float
        The state; the force across the beam is M' + N w'.
    kappa, p, fall : float
        What is imposed: curvature, load, and its derivative.
    EI, pull : float
        Of the bar; N.
    """
    rates = [w, psi, kappa - moment / EI, (pull * psi - force) / EI]
    rates += [(p + pull * rates[2]) / EI, (fall + pull * rates[3]) / EI]
    while len(rates) < TERMS:
        rates.append(pull / EI * rates[-2])
    return rates


def tapered(state, kappa, p, fall, EI, t):
    """Integrate the moment over EI twice, by Gauss: deflections at distances t, and the state at the last of them."""
    w, psi, moment, force = state
    nodes, weights = np.polynomial.legendre.leggauss(40)
    at = t[:, None] * (nodes + 1) / 2
    there = moment + force * at - p * at**2 / 2 - fall * at**3 / 6
    bent = kappa - there / EI(at)
    along = w + psi * t + ((t[:, None] - at) * bent) @ weights * t / 2
    h = t[-1]
    return along, along[-1], psi + bent[-1] @ weights * h / 2, moment + force * h - p * h**2 / 2 - fall * h**3 / 6


def taylor(rates, t):
    """Sum a Taylor series from its highest term."""
    total = 0.0
    for k in range(len(rates) - 1, 0, -1):
        total = (total + rates[k]) * t / k
    return total + rates[0]


def level(foundation: dict, x, length: float):
    """Give the deflection at which a foundation is touched.

    Parameters
    ----------
    foundation : dict
        With gap, a number or a pair, or profile.
    x : float or numpy.ndarray
        Places.
    length : float
        Of the beam.
    """
    side = 1.0 if foundation["side"] == "below" else -1.0
    gap = foundation.get("gap", 0.0)
    if "profile" in foundation:
        return side * np.interp(x, *np.transpose(foundation["profile"]))
    if isinstance(gap, list):
        ends = [foundation.get("from", 0.0), foundation.get("to", length)]
        return side * np.interp(x, ends, gap)
    return side * gap + 0.0 * np.asarray(x)
