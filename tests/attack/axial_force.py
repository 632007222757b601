"""Beams with axial forces that bending feels, against an independent solution in 90 digits: tension, compression, ground, modes."""

import math
import random

import gapbeam
import numpy as np
from mpmath import mpf
from oracle.axial_force import Solution, solve
from oracle.axial_ground import Unsettled, solve_on_ground
from oracle.axial_modes import buckling, frequencies, inertia, unstable
from oracle.axial_path import follow
from scenes import axial_force as drawn
from scenes.tapered import with_joints

from .family import Family, Verdict

PROMISE = (
    "Under axial forces reactions, fields, extremes and ends of contact are those of a solution in 90 digits, to 1e-13 of the "
    "largest. sqrt(N L^2/EI) is 1e-6 to 1e4, over ground to 1e3. Factors of buckling and frequencies are complete and "
    "right to 1e-12. Beyond the first factor the state is stable, and the one reached as the compression grows"
)
CLOSE, OF_MODES = 1e-13, 1e-12
NO_SHEAR = 0.996  # of GA, up to which the other solution has factors
PLACES = 24  # in which fields are looked at, beside their extremes
MODES = 3
FIELDS = ("deflection", "rotation", "moment", "shear", "transverse")
KINDS = ("tension", "on ground", "compression", "modes", "stops", "tapers")


def draw_scene(seed):
    """Kind and scene of a seed."""
    kind, rng = KINDS[seed % len(KINDS)], random.Random(f"axial {seed}")
    made = draw_of(kind, rng, seed)
    if made["beam"].get("hinges") and rng.random() < 0.4:  # what is stiffer is as stable
        made = with_joints(rng, made)
    if rng.random() < 0.5:
        made = drawn.with_imposed(rng, made)
    return kind, made


def draw_of(kind, rng, seed):
    """A scene of a kind."""
    if kind == "stops":
        return drawn.column(seed)
    if kind == "tension":
        return drawn.random_scene(seed)
    if kind == "on ground":
        return on_one_side(rng, drawn.random_scene(seed, ground=True, u=(1e-6, 1e3)))
    tapers, asked = kind == "tapers", kind == "modes" or (kind == "tapers" and rng.random() < 0.15)
    if tapers and rng.random() < 0.4:
        return drawn.random_scene(seed, u=(1e-6, 1e2), tapers=True)
    made = drawn.random_scene(seed, compression=rng.uniform(0.2, 0.98), mass=asked, tapers=tapers)
    if asked:
        made["analysis"] = {"buckling": MODES, "frequencies": MODES}
    return made


def on_one_side(rng, made):
    """A scene whose ground cannot pull, with gaps of the size of its deflections."""
    size = max(abs(load.get("F", 0.0)) for load in made["loads"])
    for item in made["foundation"]:
        item.pop("shear", None)
        item["side"] = rng.choice(("below", "below", "above"))
        if size and rng.random() < 0.5:
            item["gap"] = float(f"{size / sum(made['beam']['spans']) / np.max(item['k']) * rng.random():.3g}")
    return made


def judge(made, seed=0):
    """Solve a scene, and compare it."""
    result = gapbeam.solve(made)
    try:
        exact, zones = solution(made, result)
    except Unsettled:
        return Verdict("no other solution")
    verdict = Verdict(exact.status)
    if result.status != exact.status:
        verdict.wrong.append(f"{result.status}, not {exact.status}: {result.reason}")
    elif exact.status == "solved":
        turns = exact.extremes()
        verdict.wrong += [*values(made, exact, turns, result), *contact(made, zones, exact, turns, result), *modes(made, result)]
    return verdict


def solution(made, result):
    """The state in many digits, and the zones of contact with the ground."""
    if any("side" in item for item in made.get("foundation", ())):
        exact, zones = solve_on_ground(made)
        return exact, [joined(some) for some in zones]
    if min(drawn.axial_forces(made)) >= 0.0 or not unstable(made, N_factor=1):
        return solve(made), ()
    path = follow(made)
    if path.jumps and result.status == "solved":  # where a jump ends is not told by statics
        return solve(made, active=acting(made, result), stable=False), ()
    return path.end if path.status == "solved" and not path.jumps else Solution("buckles"), ()


def joined(zones):
    """Zones as one where the beam between them is held just at the ground, and none where it only is."""
    found = []
    for a, b in zones:
        if b - a < CLOSE * b:
            continue
        if found and a - found[-1][1] < CLOSE * b:
            a, _ = found.pop()
        found.append((a, b))
    return found


def acting(made, result):
    """One-sided supports that act."""
    sides = [support.get("side", "both") for support in made["supports"]]
    return tuple(k for k, side in enumerate(sides) if side != "both" and result.steps[-1].state[k] == "closed")


def values(made, exact, turns, result):
    """What is wrong with reactions, fields and extremes."""
    x = np.linspace(0.0, sum(made["beam"]["spans"]), PLACES)
    found, truth, wrong = result.at(x), [exact.at(place) for place in x.tolist()], []
    forces = max([mpf(0), *map(abs, exact.reaction)])
    for name in FIELDS:
        expected = [getattr(one, name) for one in truth]
        largest = max([abs(value) for value in expected] + ([forces] if name in ("shear", "transverse") else []))
        if name in turns:
            largest = max(largest, *(abs(value) for value, _ in turns[name].values()))
            wrong += extremes(name, turns[name], exact, result, CLOSE * largest)
        off = max(abs(mpf(float(a)) - b) for a, b in zip(getattr(found, name), expected, strict=True))
        if off > CLOSE * largest:
            wrong.append(f"{name} is off by {float(off):.3g} of {float(largest):.3g}")
    off = max((abs(mpf(float(a)) - b) for a, b in zip(result.steps[-1].reaction, exact.reaction, strict=True)), default=mpf(0))
    if off > CLOSE * forces:
        wrong.append(f"reactions are off by {float(off):.3g} of {float(forces):.3g}")
    return wrong


def extremes(name, turns, exact, result, least):
    """What is wrong with the extremes of a quantity: one that is not the farthest out, or is not reached where it is said to be."""
    for end, sign in (("max", 1), ("min", -1)):
        found = result.extremes[name][end]
        if sign * (found.value - turns[end][0]) < -least:
            yield f"{end} of {name} is {found.value:.17g}, not {float(turns[end][0]):.17g}"
        there = [getattr(exact.at(mpf(found.x), side), name) for side in ("left", "right")]
        if min(abs(found.value - value) for value in there) > least:
            yield f"{end} of {name} is not reached at {found.x:.17g}"


def contact(made, zones, exact, turns, result):
    """What is wrong with the ends of contact: by how much the gap is not closed there, of the largest deflection."""
    largest = max(abs(value) for value, _ in turns["deflection"].values())
    for k, (item, some) in enumerate(zip(made.get("foundation", ()), zones, strict=False)):
        found = [zone for zone in result.steps[-1].contact if zone.foundation == k]
        if item["side"] != "both" and len(found) != len(some):
            yield f"foundation {k} acts in {len(found)} zones, not {len(some)}"
            continue
        for zone, right in zip(found, some, strict=True):
            for x, end in ((zone.from_, right[0]), (zone.to, right[1])):
                past = exact.at(mpf(x)).deflection - exact.at(end).deflection
                if abs(past) > CLOSE * largest:
                    yield f"contact with foundation {k} ends at {x:.17g}, not at {float(end):.17g}"


def modes(made, result):
    """What is wrong with factors of buckling and frequencies, and with a state that is said to be stable."""
    on = acting(made, result)
    if not any("side" in item for item in made.get("foundation", ())) and inertia(made, on):
        yield "the state is not stable"
    if "analysis" not in made:
        return
    for name, found, asked in (("factors", result.buckling, buckling), ("frequencies", result.frequencies, frequencies)):
        right = [float(value) for value in asked(made, on, MODES)]
        if name == "factors" and len(right) < MODES:  # the other solution looks no closer to where shear itself buckles
            most = NO_SHEAR * made["beam"].get("GA", math.inf) / -min(drawn.axial_forces(made))
            found = [value for k, value in enumerate(found) if k < len(right) or value < most]
        if len(found) != len(right) or not np.allclose(found, right, rtol=OF_MODES, atol=0.0):
            yield f"{name} {found}, not {right}"


FAMILY = Family("axial force", PROMISE, draw_scene, judge, share=0.1)
