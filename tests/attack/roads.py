"""Every road to one state of a beam beside the others: steps, events, combinations, cases, functions, files."""

import random
import tomllib

import gapbeam
import numpy as np
from gapbeam.engine.quantities import QUANTITIES
from scenes import (
    axial_force,
    curved,
    foundation,
    law,
    links_along,
    moving,
    plain,
    rigid_ground,
    tabled,
    tapered,
)
from scenes.axial_springs import bedded_bar
from scenes.transformed import cut, mirrored, upside_down
from scenes.units import in_units, powers

from .family import Family, Verdict

PROMISE = (
    "A scene of any kind has the same reactions, fields and extremes on every road. Roads are a combination and its envelope, a "
    "prepared case alone and among others, a row of a function, load steps, events, other units, and a file that is read again. So "
    "has the beam seen from behind, upside down, and with one more node. Events are at the same factors there"
)
NEAR = 1e-9
SAME_FACTOR, NEXT_TO_END = 1e-10, 1e-6
PLACES = np.array([0.1337, 0.3141, 0.5, 0.6517, 0.8779])
"""Shares of the beam."""
FORCE, LENGTH = -20, 7
"""Powers of two of other units."""
UNITS = {one.name: one.unit.format(force="F", length="L") for one in QUANTITIES}
BEHIND = {"rotation", "shear", "transverse", "axial_displacement"}
"""What changes its sign seen from behind."""
OVER = set(UNITS) - {"axial_force", "axial_displacement"}
"""And upside down."""


def _plain(made):
    return {**made, "analysis": {}}


def _first_order(made):
    return {**made, "analysis": {"first_order": True}}


def _rack(seed):
    beam, supports, loads, _ = links_along.random_rack(random.Random(seed))
    return {"beam": {"EI": 1e3, **beam}, "supports": supports, "loads": loads}


def _joints(seed):
    made = plain.random_scene(random.Random(seed), held=True)
    tapered.with_joints(random.Random(seed), made)
    return _plain(made)


KINDS = {
    "plain": lambda seed: _plain(plain.random_scene(random.Random(seed))),
    "foundation": lambda seed: _plain(foundation.random_scene(seed)),
    "curved": lambda seed: _plain(curved.random_curved_scene(seed)),
    "tables": lambda seed: _plain(tabled.random_tabled_scene(seed)),
    "moving": lambda seed: _plain(moving.random_moving_scene(seed)),
    "tension": lambda seed: _plain(axial_force.random_scene(seed)),
    "compression": lambda seed: _plain(axial_force.random_scene(seed, compression=0.5)),
    "tension on ground": lambda seed: _plain(axial_force.random_scene(seed, ground=True, u=(1e-6, 1e2))),
    "tapers": lambda seed: _plain(axial_force.random_scene(seed, tapers=True, u=(1e-6, 1e2))),
    "joints": _joints,
    "rigid ground": lambda seed: _plain(rigid_ground.rigid_scene(seed)),
    "rack": _rack,
    "stops": lambda seed: _plain(links_along.random_stops(random.Random(seed))),
    "pipe": lambda seed: _first_order(links_along.random_pipe(random.Random(seed))),
    "pile": lambda seed: _first_order(bedded_bar(seed)),
    "pile on ground": lambda seed: {**_first_order(bedded_bar(seed)), "foundation": [{"k": 1e4}]},
    **{family: lambda seed, family=family: _plain(law.law_scene(seed, family)) for family in law.FAMILIES},
}


def draw_scene(seed):
    """Kind and scene of a seed."""
    kind = list(KINDS)[seed % len(KINDS)]
    return kind, KINDS[kind](seed)


class State:
    """What a solved scene says, and what else differs from it.

    Parameters
    ----------
    result : Result
        Solved.
    wrong : list of str
        Receives what differs.
    """

    def __init__(self, result, wrong):
        self.step, self.extremes, self.wrong = result.steps[-1], result.extremes, wrong
        self.x = PLACES * float(result.scene.span_ends()[-1])
        self.right, self.left = (result.at(self.x, side=side).columns() for side in ("right", "left"))
        bounds = self.step.error_bounds
        self.sizes, self.slack = {}, {}
        for name in self.step._beam.fields:
            self.sizes[name] = max(abs(self.extremes[name][way].value) for way in ("max", "min"))
            nothing = {"pressure": 1e-12, "axial_displacement": 1e-16}.get(name, 1e-20)
            self.slack[name] = NEAR * self.sizes[name] + 3 * (bounds.get(name) or 0.0) + nothing
        self.force = max(np.abs(self.step.reaction).max(initial=0.0), self.sizes["shear"])
        self.slack["reaction"] = NEAR * self.force + 3 * (bounds["reaction"] or 0.0)

    def compare(self, road, name, found, own):
        if self.step.indifferent and name in ("deflection", "rotation"):
            return
        off = np.abs(np.asarray(found, dtype=float) - np.asarray(own, dtype=float)).max(initial=0.0)
        if not off <= self.slack[name]:
            self.wrong.append(f"{road}: {name} differs by {off:.3g} of {self.sizes.get(name, self.force):.3g}")

    def reactions(self, road, found, which=slice(None)):
        """Reactions of some supports."""
        self.compare(road, "reaction", found, self.step.reaction[which])

    def fields(self, road, found, extremes):
        """Fields at the places, right of where they jump, and extremes, of those that are given."""
        for name in self.sizes:
            if name in found:
                self.compare(road, name, found[name], self.right[name])
            if name in extremes:
                for way in ("max", "min"):
                    self.compare(f"{road}, {way}", name, extremes[name][way].value, self.extremes[name][way].value)

    def envelope(self, found):
        """An envelope of this state alone."""
        curves = found.envelope(x=self.x)
        for name in self.sizes:
            if name in curves.fields.largest:
                both = self.left[name], self.right[name]
                self.compare("envelope", name, curves.fields.largest[name], np.maximum(*both))
                self.compare("envelope", name, curves.fields.smallest[name], np.minimum(*both))
        self.fields("envelope", {}, curves.extremes)
        self.reactions("envelope", [one["reaction"]["max"].value for one in curves.supports])

    def in_units(self, road, found):
        """The same beam in other units: all digits."""
        for name in self.sizes:
            power = sum(unit * times for unit, times in zip((FORCE, LENGTH), powers(UNITS[name]), strict=True))
            for way in ("max", "min"):
                theirs = float(np.ldexp(found.extremes[name][way].value, -power))
                self.compare(f"{road}, {way}", name, theirs, self.extremes[name][way].value)

    def seen(self, road, found, turned, x=None, side="right"):
        """The same beam seen from behind or upside down, where some quantities have another sign."""
        behind = "axial_displacement" in turned
        changes = ("axial", "rotational") if behind else ("normal", "rotational", "hinge")
        signs = np.where([one.direction in changes for one in found.scene.supports], -1.0, 1.0)
        self.reactions(road, signs * found.steps[-1].reaction)
        there = found.at(self.x if x is None else x, side=side).columns()
        for name in self.sizes:
            sign, ends = (-1.0, ("min", "max")) if name in turned else (1.0, ("max", "min"))
            self.compare(road, name, sign * there[name], self.right[name])
            for way, other in zip(("max", "min"), ends, strict=True):
                theirs = sign * found.extremes[name][other].value
                self.compare(f"{road}, {way}", name, theirs, self.extremes[name][way].value)

    def result(self, road, found):
        """Another result."""
        if said(found) != "solved":
            self.wrong.append(f"{road}: {said(found)}, {getattr(found, 'reason', found)}")
            return
        self.reactions(road, found.steps[-1].reaction)
        self.fields(road, found.at(self.x).columns(), found.extremes)


def solved(scene):
    """Solve a scene; an error is an answer."""
    try:
        return gapbeam.solve(scene)
    except gapbeam.GapbeamError as error:
        return error


def said(result):
    """The status of a result, or the kind of an error."""
    return type(result).__name__ if isinstance(result, Exception) else result.status


def judge(made, seed=0):
    """Go all roads."""
    alone = solved(made)
    verdict = Verdict(said(alone))
    if isinstance(alone, gapbeam.SceneError):
        return verdict
    state = State(alone, verdict.wrong) if verdict.outcome == "solved" else None

    def reached(road, outcome):
        """Whether a road leads to a state where there is one."""
        if (outcome == "solved") != (state is not None):
            verdict.wrong.append(f"{road}: {outcome}, alone {verdict.outcome}")
        return state is not None and outcome == "solved"

    _as_combination(made, state, reached)
    _as_case(made, state, reached)
    _as_row(made, state, reached)
    there = solved(in_units(made, 2.0**FORCE, 2.0**LENGTH))
    if reached("other units", said(there)):
        state.in_units("other units", there)
    again = solved(tomllib.loads(gapbeam.read_scene(made).to_toml()))
    if reached("written to a file", said(again)):
        state.result("written to a file", again)
    by_steps, by_events = solved(asked(made, steps=3)), solved(asked(made, follow="events"))
    for road, found in (("steps", by_steps), ("events", by_events)):
        if state is not None and said(found) == "solved":  # on its way a beam may come to where it does not stand
            state.result(road, found)
    _as_another_beam(made, state, reached, by_events, random.Random(seed), verdict.wrong)
    return verdict


def asked(made, **keys):
    """The scene with other keys of its analysis."""
    return {**made, "analysis": {**made.get("analysis", {}), **keys}}


def _as_another_beam(made, state, reached, by_events, rng, wrong):
    """Seen from behind, upside down and with one more node: states, and factors of events."""
    behind = mirrored(made)
    there = solved(behind)
    if reached("from behind", said(there)):
        state.seen("from behind", there, BEHIND, float(sum(made["beam"]["spans"])) - state.x, "left")
    over = upside_down(made)
    there = solved(over)
    if reached("upside down", said(there)):
        state.seen("upside down", there, OVER)
    cut_there = cut(made, rng.randrange(len(made["beam"]["spans"])), rng.choice((0.25, 0.375, 0.5)))
    there = solved(cut_there)
    if reached("one more node", said(there)):
        state.result("one more node", there)
    for road, other in (("events from behind", behind), ("events upside down", over), ("events, one more node", cut_there)):
        found = solved(asked(other, follow="events"))
        ways = {said(found), said(by_events)}
        if len(ways) > 1 and ("solved" in ways or "EngineError" not in ways):  # where it does not stand either may not be settled
            wrong.append(f"{road}: {said(found)}, {getattr(found, 'reason', found)}; else {said(by_events)}")
        elif len(ways) == 1 and not isinstance(found, Exception):
            factors, others = _factors_of(by_events), _factors_of(found)
            if len(factors) != len(others) or np.abs(factors - others).max(initial=0.0) > SAME_FACTOR:
                wrong.append(f"{road}: at factors {others.tolist()}, not {factors.tolist()}")


def _factors_of(result):
    """Of all events but those that rounding may tell next to where a beam does not stand any more, in order."""
    factors = np.sort([event.factor for event in result.events])
    if result.status == "solved" or result.path is None or not result.path.segments:
        return factors
    return factors[factors < result.path.segments[-1].stop * (1.0 - NEXT_TO_END)]


def _as_combination(made, state, reached):
    cases = dict.fromkeys(load.get("case", "live") for load in made["loads"])
    if not cases:
        return
    found = solved({**made, "combinations": [{"name": "all", "factors": dict.fromkeys(cases, 1.0)}]})
    one = found if isinstance(found, Exception) else found.combinations["all"]
    if reached("combination", said(one)):
        state.result("combination", one)
        state.envelope(found)


def _as_case(made, state, reached):
    try:
        prepared = gapbeam.prepare(made)
    except gapbeam.EngineError:
        reached("prepared", "EngineError")
        return
    one, many = prepared.solve(), prepared.solve(np.ones((9, len(made["loads"]))))
    if reached("case", "solved" if one.status == 0 else f"status {one.status}"):
        state.reactions("case", one.reaction, prepared.supports)
        state.fields("case", one.at(state.x).columns(), one.extremes)
        state.result("result of a case", prepared.result())
    if reached("nine cases", "solved" if not many.status.any() else f"status {many.status}"):
        for row in many.reaction:
            state.reactions("nine cases", row, prepared.supports)


def _as_row(made, state, reached):
    if not made["loads"]:
        return
    at = float(sum(made["beam"]["spans"])) * PLACES[1]
    names = ["moment"] if state is None else list(state.sizes)
    outputs = [*(f"{name}@{at:.17g}" for name in names), *(f"{name}.max" for name in names)]
    function = gapbeam.function(made, [f'factors."{made["loads"][0].get("case", "live")}"'], outputs)
    values = function([1.0])
    if reached("function", "solved" if np.isfinite(values).all() else str(function.evaluate([1.0]).status)):
        for k, name in enumerate(names):
            state.compare("function", name, values[k], state.right[name][1])
            state.compare("function, max", name, values[len(names) + k], state.extremes[name]["max"].value)


FAMILY = Family("roads", PROMISE, draw_scene, judge, share=0.05)
