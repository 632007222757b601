"""Supports whose law is a curve, under axial forces and on two-sided ground, beside Newton's method in 50 digits."""

import random
from itertools import pairwise

import gapbeam
import numpy as np
from oracle.cells import Loose
from oracle.curved_beam import CurvedBeam
from scenes.law import in_stretches
from scenes.plain import nodes_of

from .family import Family, Verdict

PROMISE = (
    "Under axial forces and on ground that holds both ways by k, with supports whose law is a curve, states are those of Newton's "
    "method on compliances in 90 digits. So are load factors at which supports close and open"
)
FACTORS = 1e-12
STATES = 1e-11


def draw(seed):
    """A scene as of `in_stretches`, with a curve in place of every law."""
    rng = random.Random(f"curves {seed}")
    kind, made = in_stretches(seed)
    EI, length = made["beam"]["EI"], nodes_of(made)[-1]
    stiff = (min(EI) if isinstance(EI, list) else EI) / length**3
    for s in made["supports"]:
        if "law" in s:
            s.pop("unloading", None)
            s["law"] = draw_curve(rng, stiff)
        elif s.get("side", "both") != "both":
            s.setdefault("stiffness", round(stiff * 10.0 ** rng.uniform(0, 4), 3))
    made["analysis"] = {"follow": "events"}
    return kind, made


def draw_curve(rng, stiff):
    """A curve by name, beside the stiffness of the beam."""
    k, limit = round(stiff * 10.0 ** rng.uniform(0, 3), 3), round(10.0 ** rng.uniform(0, 2), 3)
    name = rng.choice(("tanh", "hyperbolic", "cubic", "power"))
    if name == "cubic":
        k3 = k * 10.0 ** rng.uniform(2, 6)
        return {"type": name, "k1": k, "k2": round(rng.choice((0.0, 1.0, -1.5)) * (k * k3) ** 0.5, 3), "k3": round(k3, 3)}
    if name == "power":
        d0 = round(10.0 ** rng.uniform(-4, -2), 6)
        return {"type": name, "d0": d0, "limit": limit, "n": rng.choice((0.5, 0.8, 1.5, 2.0, 3.0))}
    return {"type": name, "stiffness": k, "limit": limit}


def judge(made, seed=0):
    """Follow a scene, and compare states and events with those of Newton's method.

    Parameters
    ----------
    made : dict
    seed : int

    Returns
    -------
    Verdict
    """
    try:
        beam = CurvedBeam(made)
    except Loose:
        return Verdict("nothing but such supports holds it")
    if not beam.which:
        return Verdict("no such support")
    result = gapbeam.solve(made)
    verdict = Verdict(result.status)
    if result.status != "solved":
        verdict.wrong.append(f"{result.status}: {result.reason}")
        return verdict
    acts = None
    ends = sorted({0.0, 1.0, *(event.factor for event in result.events)})
    for factor in [2.0**-40, *((a + b) / 2 for a, b in pairwise(ends)), 1.0]:
        step = result.state(factor)
        w, reaction = beam.state(factor, step.deflection[beam.which])
        for name, exact, least in (("deflection", w, 1e-5), ("reaction", reaction, 1e-3)):
            right = np.array([float(value) for value in exact])
            off, size = np.abs(getattr(step, name)[beam.which] - right).max(), max(np.abs(right).max(), least)
            if not off <= STATES * size:
                verdict.wrong.append(f"{name} at load factor {factor}: off by {off:.3g} of {size:.3g}")
        if factor == 2.0**-40:
            acts = [r != 0 for r in reaction]
    for event in result.events:
        if event.support is None or event.support not in beam.which:
            continue
        k = beam.which.index(event.support)
        acts[k] = event.event == "closes"
        exact = float(beam.event(k, event.factor, result.state(event.factor).deflection[beam.which]))
        if not abs(event.factor - exact) <= FACTORS * exact:
            verdict.wrong.append(f"support {event.support} {event.event} at load factor {event.factor}, not {exact}")
    touching = max(abs(r) for r in reaction) * 1e-12
    if any(a != (r != 0) and abs(r) > touching for a, r in zip(acts, reaction, strict=True)):
        verdict.wrong.append(f"events lead to {acts}, and not to where {[float(r) for r in reaction]} act")
    return verdict


FAMILY = Family("curves", PROMISE, draw, judge, share=0.2)
