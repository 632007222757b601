"""Beams on ground, judged by what their fields leave over: differential equations, jumps, contact and laws, read from the scene."""

import math
import random

import gapbeam
import numpy as np
from gapbeam.base.errors import Status
from oracle.ground_laws import between, pressure
from scenes import nodes_of, place
from scenes.curved import random_curved_scene
from scenes.foundation import random_scene
from scenes.tabled import tables_of, with_tables
from scenes.tapered import stiffness_along, with_joints, with_tapers
from scenes.touching import touching_scene

from .family import Family, Verdict
from .proofs import proof_faults

PROMISE = (
    "The fields satisfy the differential equations with the line reaction that the curve gives for the deflection, and jump "
    "by what acts at a point. The ground is one-sided, with gaps, profiles, tables and curves of all kinds. Every support "
    "is on its curve, also where the beam touches it to a few roundings. Refused are beams whose loads all stand over a "
    "spring at an end of the ground"
)
NEAR = 1e-8  # of the largest of a kind
SAME = 1e-9  # of the largest deflection
PANELS = (10, 100, 400)  # the more where the fewer find fault: where a modulus begins at 0 pressures are steep
NODES, WEIGHTS = np.polynomial.legendre.leggauss(10)


def draw_scene(seed, *, tapers=True, joints=True):
    """Kind and scene of a seed; without tapers and joints as it was before there were any."""
    if seed % 8 == 3:
        return "touching", touching_scene(seed)
    rng = random.Random(seed)
    while True:
        kind = rng.choice(("straight", "straight", "curved"))
        made = (random_scene if kind == "straight" else random_curved_scene)(rng.randrange(10**9))
        if seed % 8 == 5:
            kind, made = "tables", with_tables(rng, made)
        if tapers and seed % 8 in (1, 6):
            kind, made = "tapers", with_tapers(rng, made)
        if joints and seed % 8 in (2, 6) and made["beam"].get("hinges"):
            kind, made = "joints", with_joints(rng, made)
        try:
            gapbeam.read_scene(made)
        except gapbeam.SceneError:
            continue
        return kind, made


def judge(made, seed=0):
    """Solve a scene and look at what is left over."""
    try:
        result = gapbeam.solve(made)
    except gapbeam.EngineError as error:
        if error.status == Status.INDETERMINATE:
            return Verdict("forces not unique")
        if stands_at_an_edge(made):
            return Verdict("on an edge")
        return Verdict("refused", [str(error)])
    verdict = Verdict(result.status)
    if result.status == "solved":
        verdict.wrong = left_over(made, result, seed)
    elif result.status == "no-equilibrium" and not result.motion:
        verdict.wrong.append("no motion is given")
    return verdict


def left_over(made, result, seed):
    """What is wrong with a solved scene: its fields, its supports, its proof."""
    for panels in PANELS:
        if not (wrong := along(made, result, panels)):
            break
    return [*wrong, *at_places(made, result), *supports(made, result), *proof_faults(made, seed)]


def followed(made):
    """A scene from event to event."""
    return gapbeam.solve({**made, "analysis": {"follow": "events"}})


def another_state(made, result, path):
    """What is wrong if all loads at once lead elsewhere than from event to event."""
    x = np.linspace(0.0, made["beam"]["spans"][0], 9)
    one, other = result.at(x).deflection, path.at(x).deflection
    return ["another state from event to event"] if np.abs(one - other).max() > SAME * np.abs(one).max() else []


def stands_at_an_edge(made):
    """Whether all loads stand over a spring at an end of beam and ground: any pressure beside it turns the beam, ever farther."""
    ends = (0.0, sum(made["beam"]["spans"]))
    over = {support.get("x") for support in made.get("supports", [])} & {item.get("from", 0.0) for item in made["foundation"]}
    over |= {support.get("x") for support in made.get("supports", [])} & {item.get("to", ends[1]) for item in made["foundation"]}
    return all(load["type"] == "force" and load["x"] in over and load["x"] in ends for load in made["loads"])


def cuts(made, result):
    """Places between which everything is smooth."""
    length = nodes_of(made)[-1]
    found = {0.0, length, *nodes_of(made), *made["beam"].get("hinges", ()), *(hinge["x"] for hinge in made.get("hinges", ()))}
    for item in (*made.get("sections", ()), *made["loads"], *made["foundation"]):
        found |= {item[key] for key in ("from", "to", "x") if key in item}
        found |= {x for points in (item.get("profile", ()), *tables_of(item)) for x, _ in points}
        found |= {at["x"] for at in item.get("law", ()) if isinstance(at, dict)}
    found |= {place(made, item) for item in made.get("supports", ())}
    found |= {x for zone in result.steps[-1].contact for x in (zone.from_, zone.to)}
    return np.array(sorted(x for x in found if 0.0 <= x <= length))


def beam_of(made, x):
    """Flexibilities 1/EI and 1/GA, and curvature and load per length."""
    nodes, length = np.array(nodes_of(made)), nodes_of(made)[-1]
    span = np.clip(np.searchsorted(nodes, x, side="right") - 1, 0, len(nodes) - 2)
    EI, GA = (np.broadcast_to(np.array(made["beam"].get(key, math.inf), dtype=float), len(nodes) - 1)[span] for key in ("EI", "GA"))
    for item in made.get("sections", ()):
        inside = (x > item["from"]) & (x < item["to"])
        EI = np.where(inside, stiffness_along(item.get("EI", EI), item, x), EI)
        GA = np.where(inside, stiffness_along(item.get("GA", GA), item, x), GA)
    kappa, q = np.zeros_like(x), np.zeros_like(x)
    for item in made["loads"]:
        inside = (x > item.get("from", 0.0)) & (x < item.get("to", length))
        if "q" in item:
            q += np.where(inside, between(item["q"], x, item, length), 0.0)
        elif "kappa" in item:
            kappa += np.where(inside, item["kappa"], 0.0)
    return 1.0 / EI, 1.0 / GA, kappa, q


def fields(result, x, side="right"):
    """Deflection, rotation, moment and shear."""
    found = result.at(x, side=side)
    return np.array([found.deflection, found.rotation, found.moment, found.shear])


def least(made):
    """Deflection, rotation, moment and shear that are nothing: loads that cancel leave roundings of theirs."""
    length = nodes_of(made)[-1]
    f, g, kappa, q = beam_of(made, np.linspace(0.0, length, 200)[1:-1])
    points = sum(abs(load.get("F", load.get("M", 0.0) / length)) for load in made["loads"])
    loads = np.abs(q).max() * length + points + np.abs(kappa).max() / f.max() / length
    return 1e-5 * loads * np.array([length**3 * f.max() + length * g.max(), length**2 * f.max(), length, 1.0])


def along(made, result, panels):
    """What is wrong with the fields between the cuts, integrated over so many panels each."""
    ends = cuts(made, result)
    a, b = ends[:-1], ends[1:]
    h = (b - a) / (2 * panels)
    middle = a[:, None] + h[:, None] * (2 * np.arange(panels) + 1)
    x = (middle[:, :, None] + h[:, None, None] * NODES).reshape(len(a), -1)
    flat = x.ravel()
    w, psi, M, V = fields(result, flat)
    f, g, kappa, q = beam_of(made, flat)
    p = pressure(made, flat, w)
    rates = np.array([psi + V * g, kappa - M * f, V, p - q]).reshape(4, len(a), -1)
    weight = np.tile(WEIGHTS, panels) * h[:, None]
    change, size = (rates * weight).sum(axis=2), (np.abs(rates) * weight).sum(axis=2)
    start, stop = fields(result, a), fields(result, b, "left")
    off = np.abs(stop - start - change)
    scale = np.maximum(np.maximum(size.sum(axis=1), np.abs(start).max(axis=1)), least(made))
    names = ("deflection", "rotation", "moment", "shear")
    return [
        f"{names[k]} from {a[i]:.9g} to {b[i]:.9g} is off by {off[k, i]:.3g} of {scale[k]:.3g}"
        for k, i in np.argwhere(off > NEAR * scale[:, None])
    ]


def at_places(made, result):
    """What is wrong with jumps at places, the ends of the beam among them."""
    places = cuts(made, result)
    step = result.steps[-1]
    left, right = fields(result, places, "left")[2:], fields(result, places)[2:]
    left[:, 0], right[:, -1] = 0.0, 0.0
    for load in made["loads"]:
        if load["type"] in ("force", "moment"):
            i = np.abs(places - place(made, load)).argmin()
            left[:, i] += (load["M"], 0.0) if load["type"] == "moment" else (0.0, -load["F"])
    for k, support in enumerate(made.get("supports", ())):
        i = np.abs(places - place(made, support)).argmin()
        left[:, i] += step.couple[k], step.reaction[k]
    off, scale = np.abs(right - left), np.maximum(np.maximum(np.abs(left).max(axis=1), np.abs(right).max(axis=1)), least(made)[2:])
    names, wrong = ("moment", "shear"), np.argwhere(off > NEAR * scale[:, None])
    found = [f"{names[k]} at {places[i]:.9g} jumps by {off[k, i]:.3g} too much" for k, i in wrong]
    turned = [(hinge, fields(result, hinge["x"], "left"), fields(result, hinge["x"])) for hinge in made.get("hinges", ())]
    found += [
        f"the joint at {hinge['x']} turns by {b[1] - a[1]:.9g}, not by {-a[2] / hinge['stiffness']:.9g}"
        for hinge, a, b in turned
        if abs(b[1] - a[1] + a[2] / hinge["stiffness"]) > NEAR * max(abs(a[1]), abs(b[1]), least(made)[1])
    ]
    hinges = made["beam"].get("hinges", ())
    held = np.abs(fields(result, np.array(hinges))[2]) > NEAR * scale[0] if hinges else np.array([])
    return found + [f"a moment in the hinge at {x}" for x, wrong in zip(hinges, held, strict=True) if wrong]


def supports(made, result):
    """What is wrong with forces of supports at the deflections there."""
    step, found = result.steps[-1], []
    force = max(least(made)[3], np.abs(step.reaction).max(initial=0.0), np.abs(fields(result, cuts(made, result))[3]).max())
    for k, support in enumerate(made.get("supports", ())):
        x = place(made, support)
        w = float(result.at(x).deflection)
        way = max(np.abs(fields(result, cuts(made, result))[0]).max(), abs(support.get("settlement", 0.0)))
        side = {"both": 0, "below": 1, "above": -1}[support.get("side", "both")]
        past = w - support.get("settlement", 0.0) - side * support.get("gap", 0.0)
        if side:
            past *= side
        push, stiffness = (side or 1) * step.reaction[k], support.get("stiffness", math.inf)
        if side and push < -NEAR * force:
            found.append(f"support {k} pulls with {push:.3g}")
        if stiffness < math.inf:
            right = stiffness * (max(past, 0.0) if side else past)
            if abs(push - right) > NEAR * max(force, stiffness * way):
                found.append(f"support {k} carries {push:.9g}, not {right:.9g}")
        elif past > NEAR * way or (abs(past) > NEAR * way and (not side or push > NEAR * force)):
            found.append(f"support {k} carries {push:.3g} with the beam {past:.3g} beyond it")
    return found


FAMILY = Family("ground", PROMISE, draw_scene, judge, share=0.5)
