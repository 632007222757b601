"""Every error in a scene, with its exact message.

The tables hold a wrong part of a scene as TOML ("; " stands for a new line) and the message it gets.
"""

import re
import tomllib
from copy import deepcopy
from fractions import Fraction

import numpy as np
import pytest
from gapbeam.base.errors import GapbeamError, SceneError
from gapbeam.scene import (
    Beam,
    ForceLoad,
    LinearLoad,
    Scene,
    Support,
    UniformLoad,
    read_scene,
)
from gapbeam.scene.wording import beyond, shown

inf = float("inf")
BEAM = {"spans": [6.0, 6.0, 6.0], "EI": 1.0e4}
FORCE = {"type": "force", "x": 3.0, "F": 25.0}


def message(**parts):
    """Message with which a scene is refused; whatever is not given is sound."""
    scene = {"beam": BEAM, "supports": [{"node": 0}, {"node": 3}], "loads": [FORCE]} | deepcopy(parts)
    with pytest.raises(SceneError) as caught:
        read_scene({key: value for key, value in scene.items() if value is not None})
    return str(caught.value)


def cases(table):
    """Pairs of a piece of TOML and the message it gets."""
    pairs = []
    for case in re.sub(r"\n +", " ", table).strip().splitlines():
        given, _, expected = case.partition(" ->")
        pairs.append(pytest.param(tomllib.loads(given.replace("; ", "\n")), expected.strip(), id=given))
    return pairs


# Types and keys

TYPES_IN_A_SUPPORT = """
gap = "0,02" -> supports[0].gap: expected a number, got "0,02"
gap = true -> supports[0].gap: expected a number, got true
gap = [1, 2] -> supports[0].gap: expected a number, got [1, 2]
gap = {} -> supports[0].gap: expected a number, got a table
node = "end" -> supports[0].node: expected a whole number, got "end"
node = 1.5 -> supports[0].node: expected a whole number, got 1.5
side = "under" ->
    supports[0].side: expected "above", "below", "both", "left" or "right", got "under"; a support that lies under the beam
    and lets it lift off is "below"
side = 1 -> supports[0].side: expected "above", "below", "both", "left" or "right", got 1
rotation = "stiff" -> supports[0].rotation: expected "fixed", "free", a number or a table, got "stiff"
rotation = [1] -> supports[0].rotation: expected "fixed", "free", a number or a table, got [1]
direction = "x" -> supports[0].direction: expected "axial", "hinge", "normal" or "rotational", got "x"
law = 3 -> supports[0].law: expected a list of pairs of numbers or a table, got 3
law = [[1.0]] -> supports[0].law[0]: expected a pair of numbers, got [1.0]
law = [[1.0, "a"]] -> supports[0].law[0][1]: expected a number, got "a"
stifness = 3 -> supports[0].stifness: unknown key; did you mean "stiffness"?
Stiffness = 3 -> supports[0].Stiffness: unknown key; did you mean "stiffness"?
zzz = 1 ->
    supports[0].zzz: unknown key; the keys are node, x, name, side, stiffness, gap, settlement, rotation,
    at_hinge, direction, friction, law and unloading
"""


@pytest.mark.parametrize(("given", "expected"), cases(TYPES_IN_A_SUPPORT))
def test_types_in_a_support(given, expected):
    assert message(supports=[{"x": 1.0} | given]) == expected


TYPES_AND_KEYS = """
beam = {EI = 1.0} -> beam.spans: this key is missing; give a list of numbers
beam = {spans = [1.0]} -> beam.EI: this key is missing; give a number or a list of numbers
beam = [{spans = [6.0, 6.0, 6.0], EI = 1e4}] -> beam: expected a table, got a list of tables; write it as [beam]
supports = {node = 0} -> supports: expected a list of tables, got a table; write each as [[supports]]
suports = [] -> suports: unknown key; did you mean "supports"?
support = [] -> support: unknown key; did you mean "supports"?
title = 3 -> title: expected a text in quotes, got 3
units = {force = 3} -> units.force: expected a text in quotes, got 3
units = {mass = "kg"} -> units.mass: unknown key; the keys are force and length
beam = {spans = [6.0, 6.0, 6.0], EI = 1e4, ei = 1.0} -> beam.ei: unknown key; did you mean "EI"?
beam = {spans = [6.0, 6.0, 6.0], EI = "rigid"} -> beam.EI: expected a number or a list of numbers, got "rigid"
beam = {spans = [6.0, 6.0, 6.0], EI = [1.0, "a"]} -> beam.EI[1]: expected a number, got "a"
beam = {spans = 6.0, EI = 1e4} -> beam.spans: expected a list of numbers, got 6.0
beam = {spans = [6.0, "x"], EI = 1e4} -> beam.spans[1]: expected a number, got "x"
beam = {spans = [6.0, 6.0, 6.0], EI = 1e4, hinges = 3} -> beam.hinges: expected a list of numbers, got 3
sections = [{EI = 1.0, from_ = 2}] -> sections[0].from_: unknown key; did you mean "from"?
sections = [{EI = [1.0]}] -> sections[0].EI: expected a number, a pair of numbers or a table, got [1.0]
sections = [{EI = {form = 1.0, to = 2.0}}] -> sections[0].EI.form: unknown key; did you mean "from"?
sections = [{EI = {from = 1.0, to = 2.0, power = "3"}}] ->
    sections[0].EI.power: expected a whole number, got "3"; write 3 without quotes
beam = {spans = [6.0], EI = [[1.0, 2.0]]} ->
    beam.EI[0]: expected a number, got [1.0, 2.0]; give a stiffness that changes along the beam in [[sections]]:
    EI = [at from, at to]
foundation = [{}] -> foundation[0].k: this key is missing; give a number
foundation = [{k = "soft"}] -> foundation[0].k: expected a number, a pair of numbers or a list of pairs of numbers, got "soft"
analysis = {steps = 2.5} -> analysis.steps: expected a whole number, got 2.5
analysis = {rule = "fast"} -> analysis.rule: expected "block" or "single", got "fast"
analysis = {follow = "load"} -> analysis.follow: expected "events" or "steps", got "load"
loads = [{}] ->
    loads[0].type: this key is missing; give "force", "moment", "uniform", "linear", "curvature", "temperature",
    "axial", "axial_uniform" or "movement"
loads = [{type = "point"}] ->
    loads[0].type: expected "force", "moment", "uniform", "linear", "curvature", "temperature",
    "axial", "axial_uniform" or "movement", got "point"; did you mean "force"?
loads = [{type = 3}] ->
    loads[0].type: expected "force", "moment", "uniform", "linear", "curvature", "temperature",
    "axial", "axial_uniform" or "movement", got 3
loads = [5] -> loads[0]: expected a table, got 5
loads = [{type = "force", x = 1.0}] -> loads[0].F: this key is missing; give a number
loads = [{type = "moment", x = 1.0, F = 1.0}] ->
    loads[0].F: unknown key; the keys of a load of type "moment" are type, node, x, name, case, M and at_hinge
loads = [{type = "linear", q = 3.0}] -> loads[0].q: expected a pair of numbers, got 3.0
loads = [{type = "linear", q = [1, 2, 3]}] -> loads[0].q: expected a pair of numbers, got [1, 2, 3]
loads = [{type = "uniform", q = [1, 2]}] -> loads[0].q: expected a number, got [1, 2]
loads = [{type = "force", x = 3.0, F = 25.0, case = 3}] -> loads[0].case: expected a text in quotes, got 3
"""


@pytest.mark.parametrize(("given", "expected"), cases(TYPES_AND_KEYS))
def test_types_and_keys(given, expected):
    assert message(**given) == expected


def test_what_toml_cannot_say():
    assert message(beam=None) == "beam: this key is missing; give a table"
    assert message(supports=[{"gap": None}]) == "supports[0].gap: expected a number, got null"
    bound = "expected a whole number of at most 2,147,483,647, got 100"
    assert message(analysis={"steps": 10**30}).startswith(f"analysis.steps: {bound}")
    assert message(analysis={"buckling": 1001}) == "analysis.buckling: expected a whole number of at most 1,000, got 1001"
    assert message(supports=[{"node": 10**400}]).startswith(f"supports[0].node: {bound}")
    assert message(supports=[{1: 3}]) == "supports[0]: keys are texts, one key here is not"


# Beam and sections

IN_THE_BEAM = """
spans = [] -> beam.spans: the beam has no span; give at least one length, for example [6.0]
spans = [6.0, 0.0] ->
    beam.spans[1]: the span from x = 6 to x = 6 has length 0; give a length above 0 or remove it
spans = [6.0, 6.0, -6.0] ->
    beam.spans[2]: the span from x = 12 to x = 6 has length -6; give a length above 0 or remove it
spans = [6.0, inf] -> beam.spans[1]: expected a finite length above 0, got inf
spans = [nan] -> beam.spans[0]: expected a finite length above 0, got nan
spans = [1e+308, 1e+308] -> beam.spans: the beam is too long for the range of numbers
spans = [1e+20, 1.0] ->
    beam.spans[1]: a length of 1 is lost in rounding at x = 1e+20; give a greater length or remove it
EI = 0.0 -> beam.EI: expected a number above 0 (inf = rigid), got 0
EI = -1e4 -> beam.EI: expected a number above 0 (inf = rigid), got -10000
EI = nan -> beam.EI: expected a number above 0 (inf = rigid), got nan
GA = [1.0, 2.0, 0.0] -> beam.GA[2]: expected a number above 0 (inf = rigid), got 0
EA = [nan, 2.0, 0.0] -> beam.EA[0]: expected a number above 0 (inf = rigid), got nan
N = nan -> beam.N: expected a finite number, tension positive, got nan
N = [1.0, inf, 0.0] -> beam.N[1]: expected a finite number, tension positive, got inf
mass = -1.0 -> beam.mass: expected a finite number, 0 or more, got -1
mass = [0.0, nan, 1.0] -> beam.mass[1]: expected a finite number, 0 or more, got nan
mass = [1.0] -> beam.mass: has 1 value for 3 spans; give one number, or one per span
width = 0.0 -> beam.width: expected a finite number above 0, got 0; give the width on the ground
width = -1.5 -> beam.width: expected a finite number above 0, got -1.5; give the width on the ground
width = nan -> beam.width: expected a finite number above 0, got nan; give the width on the ground
EI = [1e4, 1e4] -> beam.EI: has 2 values for 3 spans; give one number, or one per span
EI = [] -> beam.EI: has 0 values for 3 spans; give one number, or one per span
hinges = [0.0] -> beam.hinges[0]: x = 0 is an end of the beam, where no hinge can be; remove it
hinges = [1e-17] -> beam.hinges[0]: x = 1e-17 is an end of the beam, where no hinge can be; remove it
hinges = [3.0, 18.000000000000004] ->
    beam.hinges[1]: x = 18 is an end of the beam, where no hinge can be; remove it
hinges = [19.0] -> beam.hinges[0]: 19 is outside the beam, which runs from x = 0 to x = 18
hinges = [-1.0] -> beam.hinges[0]: -1 is outside the beam, which runs from x = 0 to x = 18
hinges = [nan] -> beam.hinges[0]: expected a number, got nan
hinges = [6.0, 3.0, 6.000000000000001] ->
    beam.hinges[2]: at x = 6 there is a hinge already (beam.hinges[0]); remove one of them
"""


@pytest.mark.parametrize(("given", "expected"), cases(IN_THE_BEAM))
def test_beam(given, expected):
    assert message(beam=BEAM | given) == expected


IN_A_SECTION = """
from = 4.0; to = 2.0; EI = 1.0 ->
    sections[1]: the stretch from = 4 to = 2 has no length; from must be less than to
from = 4.0; to = 4.000000000000001; EI = 1.0 ->
    sections[1]: the stretch from = 4 to = 4 has no length; from must be less than to
from = 18.0; EI = 1.0 -> sections[1]: the stretch from = 18 to = 18 has no length; from must be less than to
from = -1.0; EI = 1.0 -> sections[1].from: -1 is outside the beam, which runs from x = 0 to x = 18
to = 18.1; EI = 1.0 -> sections[1].to: 18.1 is outside the beam, which runs from x = 0 to x = 18
to = inf; EI = 1.0 -> sections[1].to: inf is outside the beam, which runs from x = 0 to x = 18
to = nan; EI = 1.0 -> sections[1].to: expected a number, got nan
EI = 0 -> sections[1].EI: expected a number above 0 (inf = rigid), got 0.0
GA = -2.5 -> sections[1].GA: expected a number above 0 (inf = rigid), got -2.5
EA = nan -> sections[1].EA: expected a number, got nan
N = inf -> sections[1].N: expected a finite number, got inf
EI = { type = "cubic" } -> sections[1].EI.type: unknown key; the keys are from, to and power
from = 2.0; to = 4.0 -> sections[1]: changes nothing; give EI, GA or EA
"""


@pytest.mark.parametrize(("given", "expected"), cases(IN_A_SECTION))
def test_sections(given, expected):
    assert message(sections=[{"EI": 1.0}, given]) == expected


# Supports

IN_A_SUPPORT = """
# no key -> supports[0]: its position is missing; give node or x
node = 1; x = 6.0 -> supports[0]: has both node = 1 and x = 6; give one of the two
node = 4 -> supports[0].node: there is no node 4; the nodes of the beam are 0 to 3
node = -1 -> supports[0].node: there is no node -1; the nodes of the beam are 0 to 3
x = 19.0 -> supports[0].x: 19 is outside the beam, which runs from x = 0 to x = 18
x = -0.001 -> supports[0].x: -0.001 is outside the beam, which runs from x = 0 to x = 18
x = nan -> supports[0].x: expected a number, got nan
x = inf -> supports[0].x: inf is outside the beam, which runs from x = 0 to x = 18
x = 6.0; stiffness = -1.0 -> supports[0].stiffness: expected a number, 0 or more (inf = rigid), got -1.0
x = 6.0; stiffness = nan -> supports[0].stiffness: expected a number, got nan
x = 6.0; side = "below"; gap = inf -> supports[0].gap: expected a finite number, got inf
x = 6.0; side = "below"; gap = nan -> supports[0].gap: expected a finite number, got nan
x = 6.0; settlement = -inf -> supports[0].settlement: expected a finite number, got -inf
x = 6.0; gap = 0.01 -> supports[0].gap: only a support with side = "below" or "above" has a gap
x = 6.0; rotation = -3 -> supports[0].rotation: expected "free", "fixed" or a number, 0 or more, got -3.0
x = 6.0; rotation = nan -> supports[0].rotation: expected "free", "fixed" or a number, 0 or more, got nan
x = 6.0; direction = "axial"; side = "below" ->
    supports[0].side: an axial support pushes to the left or to the right; use side = "left", "right" or "both", got "below"
x = 6.0; side = "left" ->
    supports[0].side: a support across the beam is below or above it; use side = "below" or "above", or direction = "axial",
    got "left"
x = 6.0; direction = "axial"; gap = 0.1 ->
    supports[0].gap: only a support with side = "left" or "right" has a gap
x = 6.0; friction = -0.1 -> supports[0].friction: expected a finite number, 0 or more, got -0.1
x = 6.0; friction = inf -> supports[0].friction: expected a finite number, 0 or more, got inf
x = 6.0; direction = "axial"; friction = 0.1 ->
    supports[0].friction: a support along the beam has none; give it to one across the beam
x = 6.0; direction = "axial"; rotation = "fixed" ->
    supports[0].rotation: an axial support holds no rotation; a normal one here can do that
x = 6.0; law = [] -> supports[0].law: has no point; give (displacement past the gap, force)
x = 6.0; law = [[0.01, 5.0], [0.005, 6.0]] ->
    supports[0].law: the displacements go back at [0.005, 6], after 0.01; give them in ascending order
x = 6.0; law = [[0.01, inf]] -> supports[0].law: expected finite numbers, got [0.01, inf]
x = 6.0; law = [[0.01, -5.0]] ->
    supports[0].law: the force is below zero at [0.01, -5]; a support that pushes cannot pull: end the law at 0
x = 6.0; law = [[0.01, 5.0], [0.02, 4.0]] ->
    supports[0].law: it ends falling, so its force would become negative beyond [0.02, 4]; add a point from which
    on it stays, such as [1.02, 4]
x = 6.0; law = [[0.0, 0.0]] ->
    supports[0].law: the point [0, 0] stands there twice, or at the origin; leave it out
x = 6.0; law = [[0.0, 2.0], [0.0, 1.0], [0.0, 3.0], [1.0, 3.0]] ->
    supports[0].law: there are two vertical pieces at 0; give the outer points only
x = 6.0; side = "below"; law = [[0.01, 10.0], [0.02, 60.0]]; unloading = "plastic" ->
    supports[0].law: plastic unloading is parallel to its first piece, but the piece up to [0.02, 60] is steeper, so it
    would give back more work than it took; begin with the steepest piece, or leave unloading out
x = 6.0; law = [[0.0, 1.0], [0.0, 2.0]] ->
    supports[0].law: there are two vertical pieces at 0; give the outer points only
x = 6.0; direction = "axial"; law = { type = "tanh", stiffness = 1.0, limit = 2.0 } ->
    supports[0].law: a curve along the beam is not available in this version; give its points
x = 6.0; direction = "axial"; side = "left"; law = [[0.0, 1.0], [0.1, 0.5], [1.0, 0.5]] ->
    supports[0].law: a force that falls along the beam is not available in this version; give a law that rises or stays
x = 6.0; law = { type = "soft" } ->
    supports[0].law.type: expected "plastic", "brittle", "hardening", "cubic", "hyperbolic", "tanh" or "power", got
    "soft"
x = 6.0; law = { stiffness = 1.0 } ->
    supports[0].law.type: this key is missing; give "plastic", "brittle", "hardening", "cubic", "hyperbolic",
    "tanh" or "power"
x = 6.0; law = { type = "plastic", stiffness = 1.0 } ->
    supports[0].law.limit: this key is missing; give a number
x = 6.0; law = { type = "plastic", stiffness = 0, limit = 2 } ->
    supports[0].law.stiffness: expected a number above 0, got 0
x = 6.0; law = { type = "tanh", stiffness = inf, limit = 2 } ->
    supports[0].law.stiffness: expected a finite number above 0, got inf
x = 6.0; law = { type = "cubic", k1 = -1, k3 = 2 } ->
    supports[0].law.k1: expected a finite number of 0 or more, got -1
x = 6.0; law = { type = "cubic", k1 = 1, k3 = -2 } ->
    supports[0].law.k3: expected a finite number of 0 or more, got -2
x = 6.0; law = { type = "cubic", k1 = 9, k3 = 1, k2 = -6.5 } ->
    supports[0].law.k2: expected -2*sqrt(k1*k3) = -6 or more, since a support that pushes cannot pull, got -6.5
x = 6.0; law = { type = "cubic", k1 = 0, k3 = 1, k2 = -1e-9 } ->
    supports[0].law.k2: expected -2*sqrt(k1*k3) = 0 or more, since a support that pushes cannot pull, got -1e-09
x = 6.0; law = { type = "cubic", k1 = 9, k3 = 0, k2 = -1 } ->
    supports[0].law.k2: expected -2*sqrt(k1*k3) = 0 or more, since a support that pushes cannot pull, got -1
x = 6.0; law = { type = "cubic", k1 = 9, k3 = 1, k2 = inf } ->
    supports[0].law.k2: expected a finite number, got inf
x = 6.0; law = { type = "cubic", k1 = 9, k3 = 1, k2 = nan } ->
    supports[0].law.k2: expected a finite number, got nan
x = 6.0; law = { type = "cubic", k1 = 0, k3 = 0 } ->
    supports[0].law.k1: expected a number above 0 for k1, k2 or k3, got 0
x = 6.0; law = { type = "plastic", stiffness = 1.0, limit = 2.0, k = 3 } ->
    supports[0].law.k: unknown key; the keys of a law of type "plastic" are type, stiffness and limit
x = 6.0; law = [[0.01, 5.0]]; gap = -0.001 ->
    supports[0].gap: expected 0 or more of a support that holds both ways, got -0.001; put one below and one above at
    this place instead
x = 6.0; law = { type = "tanh", stiffness = 1.0, limit = 2.0 }; gap = -0.5 ->
    supports[0].gap: expected 0 or more of a support that holds both ways, got -0.5; put one below and one above at
    this place instead
x = 6.0; law = [[0.01, 100.0]]; stiffness = 5.0 ->
    supports[0]: has both stiffness and law; give one of the two
"""


@pytest.mark.parametrize(("given", "expected"), cases(IN_A_SUPPORT))
def test_support(given, expected):
    assert message(supports=[given]) == expected


@pytest.mark.parametrize("place", [{"x": 6.0}, {"node": 1}, {"x": 6.000000000000001}])
def test_rotation_held_at_a_hinge(place):
    problem = 'there is a hinge here, so it is unclear which side is held; say at_hinge = "left" or "right"'
    expected = f"supports[0].rotation: {problem}"
    assert message(beam=BEAM | {"hinges": [6.0]}, supports=[place | {"rotation": "fixed"}]) == expected
    assert message(beam=BEAM | {"hinges": [3.0, 6.0, 9.0]}, supports=[place | {"rotation": 5.0}]) == expected


@pytest.mark.parametrize(
    ("first", "second", "what"),
    [
        ({}, {}, 'are rigid with side = "both"'),
        ({"side": "below"}, {"side": "below", "gap": 0.1}, 'are rigid with side = "below"'),
        ({"side": "above"}, {"side": "above"}, 'are rigid with side = "above"'),
        ({"direction": "axial"}, {"direction": "axial", "stiffness": 5.0}, "hold the beam horizontally"),
        ({"side": "below", "rotation": "fixed"}, {"rotation": inf}, "hold the rotation of the beam rigidly"),
    ],
)
@pytest.mark.parametrize("places", [({"x": 6.0}, {"node": 1}), ({"x": 6.0}, {"x": 6.000000000000001})])
def test_two_supports_of_a_kind_at_one_place(first, second, what, places):
    supports = [places[0] | first, {"node": 0, "stiffness": 1.0}, places[1] | second]
    expected = f"supports[2]: this one and supports[0] both stand at x = 6 and {what}; remove one of them"
    assert message(supports=supports) == expected


NO_ROOM = """
a = {side = "below", gap = 0.01}; b = {side = "above", gap = -0.03} ->
    supports[0]: this one (below, acts at a deflection of 0.01) and supports[1] (above, acts at 0.03)
    leave no room at x = 6; give a greater gap
a = {side = "above", settlement = 0.5, gap = 0.1}; b = {side = "below", gap = 0.1} ->
    supports[1]: this one (below, acts at a deflection of 0.1) and supports[0] (above, acts at 0.4)
    leave no room at x = 6; give a greater gap
a = {}; b = {side = "below"} ->
    supports[1]: this one (below, acts at a deflection of 0) and supports[0] (both, acts at 0)
    leave no room at x = 6; give a greater gap
a = {settlement = 0.2}; b = {side = "above", settlement = 0.2} ->
    supports[0]: this one (both, acts at a deflection of 0.2) and supports[1] (above, acts at 0.2)
    leave no room at x = 6; give a greater gap
"""


@pytest.mark.parametrize(("given", "expected"), cases(NO_ROOM))
def test_no_room_between_two_supports(given, expected):
    assert message(supports=[{"x": 6.0} | given["a"], {"x": 6.0} | given["b"]]) == expected


# Loads

IN_A_LOAD = """
type = "force"; F = 1.0 -> loads[1]: its position is missing; give node or x
type = "moment"; M = 1.0; node = 0; x = 0.0 -> loads[1]: has both node = 0 and x = 0; give one of the two
type = "force"; F = 1.0; node = 9 -> loads[1].node: there is no node 9; the nodes of the beam are 0 to 3
type = "moment"; M = 1.0; x = 18.5 -> loads[1].x: 18.5 is outside the beam, which runs from x = 0 to x = 18
type = "force"; F = inf; x = 1.0 -> loads[1].F: expected a finite number, got inf
type = "force"; F = nan; x = 1.0 -> loads[1].F: expected a finite number, got nan
type = "moment"; M = -inf; x = 1.0 -> loads[1].M: expected a finite number, got -inf
type = "uniform"; q = nan -> loads[1].q: expected a finite number, got nan
type = "linear"; q = [1.0, inf] -> loads[1].q: expected finite numbers, got [1.0, inf]
type = "curvature"; kappa = inf -> loads[1].kappa: expected a finite number, got inf
type = "uniform"; q = 1.0; from = 5.0; to = 4.0 ->
    loads[1]: the stretch from = 5 to = 4 has no length; from must be less than to
type = "linear"; q = [1.0, 2.0]; from = 5.0; to = 25.0 ->
    loads[1].to: 25 is outside the beam, which runs from x = 0 to x = 18
type = "curvature"; kappa = 1.0; from = -5.0 ->
    loads[1].from: -5 is outside the beam, which runs from x = 0 to x = 18
type = "axial"; F = 1.0; node = 0 ->
    loads[1]: nothing holds the beam horizontally; give a support direction = "axial", friction, or
    axial_ground
"""


@pytest.mark.parametrize(("given", "expected"), cases(IN_A_LOAD))
def test_loads(given, expected):
    assert message(loads=[FORCE, given]) == expected


@pytest.mark.parametrize(
    "place", [{"x": 6.0}, {"node": 1}, {"x": 6.000000000000001}, {"x": 5.999999999999999}]
)
def test_moment_at_a_hinge(place):
    expected = (
        "loads[1]: the moment acts exactly at the hinge at x = 6, so it is unclear which side takes it; "
        'say at_hinge = "left" or "right"'
    )
    loads = [FORCE, {"type": "moment", "M": 2.0} | place]
    assert message(beam=BEAM | {"hinges": [9.0, 6.0]}, loads=loads) == expected


# Foundations

IN_A_FOUNDATION = """
k = [1.0] -> foundation[1].k: expected a number, a pair of numbers or a list of pairs of numbers, got [1.0]
k = [1.0, "a"] -> foundation[1].k[1]: expected a number or a pair of numbers, got "a"
k = 0 -> foundation[1].k: with a modulus of 0 it never carries; remove it
k = [0.0, 0.0] -> foundation[1].k: with a modulus of 0 it never carries; remove it
k = -2.0 -> foundation[1].k: expected a finite number, 0 or more, got -2.0
k = nan -> foundation[1].k: expected a finite number, 0 or more, got nan
k = [1.0, -2.0] -> foundation[1].k: expected finite numbers, 0 or more, got [1.0, -2.0]
k = inf -> foundation[1].side: rigid ground holds the beam one way only; give side below or above
k = [1.0, inf] ->
    foundation[1].k: rigid ground is rigid all along, got inf at one end only; give two foundations
k = 1.0; from = 4.0; to = 2.0 ->
    foundation[1]: the stretch from = 4 to = 2 has no length; from must be less than to
k = 1.0; from = 18.0 -> foundation[1]: the stretch from = 18 to = 18 has no length; from must be less than to
k = 1.0; from = -1.0 -> foundation[1].from: -1 is outside the beam, which runs from x = 0 to x = 18
k = 1.0; to = 18.1 -> foundation[1].to: 18.1 is outside the beam, which runs from x = 0 to x = 18
k = 1.0; to = nan -> foundation[1].to: expected a number, got nan
k = 1.0; side = "left" -> foundation[1].side: expected "above", "below" or "both", got "left"
k = 1.0; side = "below"; gap = "a" -> foundation[1].gap: expected a number or a pair of numbers, got "a"
k = 1.0; side = "below"; gap = inf -> foundation[1].gap: expected a finite number, got inf
k = 1.0; side = "below"; gap = [0.0, nan] -> foundation[1].gap: expected finite numbers, got [0.0, nan]
k = 1.0; side = "below"; gap = 0.1; profile = [[0.0, 0.1]] ->
    foundation[1]: has both gap and profile; give one of the two
k = 1.0; side = "below"; profile = [] -> foundation[1].profile: has no point; give (x, gap)
k = 1.0; side = "below"; profile = [[0.0]] -> foundation[1].profile[0]: expected a pair of numbers, got [0.0]
k = 1.0; side = "below"; profile = 3 -> foundation[1].profile: expected a list of pairs of numbers, got 3
k = 1.0; side = "below"; profile = [[0.0, 0.1], [6.0, 0.1], [2.0, 0.0]] ->
    foundation[1].profile[2]: the places go back to x = 2, after 6; give them in ascending order
k = 1.0; side = "below"; profile = [[0.0, 0.1], [6.0, 0.1], [6.000000000000001, 0.0]] ->
    foundation[1].profile[2]: there is a point at x = 6 already; leave one out, or give a step two places
k = 1.0; side = "below"; profile = [[0.0, 0.1], [6.0, inf]] ->
    foundation[1].profile[1]: expected finite numbers, got [6, inf]
k = 1.0; law = [[0.01, 5.0]] -> foundation[1]: has both k and law; give one of the two
law = [] -> foundation[1].law: has no point; give (displacement past the gap, force per length)
law = [[0.01, nan]] -> foundation[1].law[0]: expected finite numbers, got [0.01, nan]
law = [[0.0, 5.0]] -> foundation[1].law[0]: ground has no vertical piece, as at [0, 5]; give a steep slope
law = [[0.01, 5.0], [0.01, 6.0]] ->
    foundation[1].law[1]: ground has no vertical piece, as at [0.01, 6]; give a steep slope
law = [[0.0, 0.0], [0.01, 6.0]] ->
    foundation[1].law[0]: the point [0, 0] stands there twice, or at the origin; leave it out
law = [[0.01, 5.0], [0.005, 6.0]] ->
    foundation[1].law[1]: the displacements go back at [0.005, 6], after 0.01; give them in ascending order
law = [[0.01, -5.0]] -> foundation[1].law[0]: the force is below zero at [0.01, -5]; ground that pushes cannot pull
law = [[0.01, 5.0], [0.02, 4.0]] ->
    foundation[1].law[1]: it ends falling, so its force would become negative beyond [0.02, 4]; add a point from which on
    it stays
law = [[0.01, 0.0]] -> foundation[1].law: its force stays 0, so it never carries; remove the foundation
law = { type = "brittle", stiffness = 1.0, limit = 2.0 } ->
    foundation[1].law: ground has no force that drops at once; give a polyline that falls over a way
law = { type = "power", d0 = 1.0, limit = 2.0, n = 0.5 } ->
    foundation[1].law.n: expected 1, 2 or 3, got 0.5: with n below 1 the ground is infinitely stiff at first, so that a pile
    would change its side infinitely often, with others no series holds where contact begins; give a polyline, as codes do
law = { type = "power", d0 = 0.0, limit = 2.0, n = 2 } -> foundation[1].law.d0: expected a number above 0, got 0
law = { type = "power", d0 = 1.0, limit = [-2.0, 1.0], n = 2 } ->
    foundation[1].law.limit: expected numbers of 0 or more, got -2
law = { type = "power", d0 = 1.0, limit = 0, n = 2 } ->
    foundation[1].law.limit: is 0 everywhere, so it never carries; remove the foundation
law = { type = "tanh", stiffness = [0.0, 4.0], limit = [nan, 400.0] } ->
    foundation[1].law.limit: expected finite numbers, got nan
law = { type = "plastic", stiffness = inf, limit = 2.0 } ->
    foundation[1].law.stiffness: expected finite numbers, got inf
law = { type = "hardening", stiffness = 1.0, limit = 2.0, slope = inf } ->
    foundation[1].law.slope: expected finite numbers, got inf
law = [[0.01, 5.0]]; unloading = "plastic" ->
    foundation[1].unloading: unknown key; the keys are from, to, k, side, gap, profile, law, shear and name
"""


@pytest.mark.parametrize(("given", "expected"), cases(IN_A_FOUNDATION))
def test_foundation(given, expected):
    assert message(foundation=[{"k": 1.0}, given]) == expected


# Steps


@pytest.mark.parametrize("steps", [0, -3])
def test_steps(steps):
    expected = f"analysis.steps: expected a whole number, 1 or more, got {steps}"
    assert message(analysis={"steps": steps}) == expected



@pytest.mark.parametrize("value", [-3.0, 0.0, np.nan])
@pytest.mark.parametrize("key", ["moment", "shear", "reaction", "opening", "deflection", "pressure"])
def test_limits(key, value):
    expected = f"limits.{key}: expected a number above 0, got {value:g}; leave it out where there is no limit"
    assert message(limits={key: value}) == expected


# Scenes built in Python


def refused(**parts):
    with pytest.raises(SceneError) as caught:
        read_scene(Scene(**({"beam": Beam([6.0, 6.0], EI=1e4)} | parts)))
    return str(caught.value)


@pytest.mark.parametrize(
    ("parts", "expected"),
    [
        ({"supports": [Support(x="6")]}, 'supports[0].x: expected a number, got "6"; write 6 without quotes'),
        (
            {"supports": [Support(x=6.0, side="left")]},
            'supports[0].side: a support across the beam is below or above it; use side = "below" or "above", or direction = '
            '"axial", got "left"',
        ),
        ({"supports": Support(x=6.0)}, "supports: expected a list of tables, got a table; write each as [[supports]]"),
        (
            {"beam": Beam([6.0, -1.0], EI=1e4)},
            "beam.spans[1]: the span from x = 6 to x = 5 has length -1; give a length above 0 or remove it",
        ),
        ({"beam": Beam(6.0, EI=1e4)}, "beam.spans: expected a list of numbers, got 6.0"),
        ({"beam": Beam(np.zeros((2, 2)), EI=1e4)}, "beam.spans[0]: expected a number, got [0.0, 0.0]"),
        ({"loads": [ForceLoad(x=1.0, F=np.array("a"))]}, 'loads[0].F: expected a number, got "a"'),
        ({"loads": [LinearLoad(q=[1.0])]}, "loads[0].q: expected a pair of numbers, got [1.0]"),
        ({"loads": [UniformLoad(q=10**400)]}, "loads[0].q: 1" + 56 * "0" + "... " + beyond("").lstrip()),
    ],
)
def test_python_scene(parts, expected):
    assert refused(**parts) == expected


def test_structs_among_data():
    assert message(supports=[Support(x="6")]) == 'supports[0].x: expected a number, got "6"; write 6 without quotes'
    assert message(beam=Beam(["a"], EI=1.0)) == 'beam.spans[0]: expected a number, got "a"'
    assert message(loads=[FORCE, UniformLoad(q="a")]) == 'loads[1].q: expected a number, got "a"'


def test_no_scene():
    expected = "expected a Scene, a mapping or the path of a file, got "
    for source, got in ((5, "5"), (None, "None"), ([1], "[1]"), (Beam([1.0], EI=1.0), "a table")):
        with pytest.raises(SceneError) as caught:
            read_scene(source)
        assert str(caught.value) == expected + got


# Files


def write(folder, name, text):
    path = folder / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(SceneError) as caught:
        read_scene(path)
    assert str(caught.value).startswith(str(path))
    return str(caught.value).removeprefix(str(path))


@pytest.mark.parametrize(
    ("name", "text", "begin", "end"),
    [
        ("a.toml", "[beam]\nspans = [6.0\nEI = 1\n", ", line 3, column 1: ", ", in: EI = 1"),
        ("a.toml", "[beam]\nEI == 1\n", ", line 2, column 5: ", ", in: EI == 1"),
        ("a.toml", "[beam]\nEI = 0,02\n", ", line 2, column 7: ", '; write numbers with a point: "0.02"'),
        ("a.toml", "[beam]\nEI = 1\nEI = 2\n", ", line 3, column 7: ", "; it stands above already; leave one of the two out"),
        ("a.toml", "[beam]\nEI = 1\n[beam]\n", ", line 3, column 6: ", "; it stands above already; leave one of the two out"),
        ("a.toml", "loads = []\n[[loads]]\n", ", line 2, column 8: ", "; it is written in one piece above; add to that, or write "
         "all of it as tables of their own"),
        ("a.toml", "beam = { EI = 1, }\n", ", line 1, column 18: ", "; leave out the comma before it"),
        ("a.toml", "beam = { EI = 1,\n", ", line 1, column 17: ", "; a table in braces is written on one line; over several lines "
         "write it as [table]"),
        ("a.toml", "title = “x”\n", ", line 1, column 9: ", "; write straight quotes"),
        ("a.toml", "[beam]\nEI = Infinity\n", ", line 2, column 6: ", "; infinite is inf"),
        ("a.json", '{"supports": [1,\n]}', ", line 2, column 1: ", "; leave out the comma before it"),
        ("a.json", '{"supports": []}  // none', ", line 1, column 19: ", "; JSON has no comments; leave them out, or write TOML"),
        ("a.toml", '[beam]\ntitle = """x', ", line 2, column 13: ", ', in: title = """x'),
        ("a.json", '{"beam":\n [}', ", line 2, column 3: ", ", in: [}"),
        ("a.json", "", ", line 1, column 1: ", ""),
    ],
)
def test_syntax(tmp_path, name, text, begin, end):
    """The words between are those of Python's own readers."""
    problem = write(tmp_path, name, text)
    assert problem.startswith(begin)
    assert problem.endswith(end)


@pytest.mark.parametrize(
    ("name", "text", "expected"),
    [
        ("a.toml", b"title = '\xff'", ": not a text in UTF-8 (byte 10 is wrong); save it as UTF-8"),
        ("a.json", '{"beam": {"EI": 1, "EI": 2}}', ': the key "EI" stands twice in one table'),
        ("a.json", "[" * 100_000, ": tables or lists are nested too deeply"),
    ],
)
def test_content(tmp_path, name, text, expected):
    assert write(tmp_path, name, text) == expected


@pytest.mark.parametrize(
    ("name", "text", "place"),
    [
        ("a.toml", "[beam]\nspans = [6.0, inf, 1e400]\n", "beam.spans[2]: 1e400"),
        ("a.toml", "[[supports]]\ngap = 1_0.0\n[[supports]]\n'a b' = -2.5E+309\n", 'supports[1]."a b": -2.5E+309'),
        ("a.json", '{"beam": {"EI": Infinity, "spans": [6.0]}, "loads": [{"F": 1e400}]}', "loads[0].F: 1e400"),
    ],
)
def test_numbers_too_large_for_a_double(tmp_path, name, text, place):
    """They would be taken to be infinite."""
    (tmp_path / name).write_text(text)
    with pytest.raises(SceneError, match=re.escape(place) + " is beyond the largest number of double precision, 1.8e308; "):
        read_scene(tmp_path / name)


@pytest.mark.parametrize(
    ("name", "text", "place"),
    [
        ("a.toml", "[beam]\nspans = [6.0, 0.0, 1e-400]\n", "beam.spans[2]: 1e-400"),
        ("a.toml", "[[supports]]\ngap = 0.00e-999\n[[supports]]\ngap = -2.5E-325\n", "supports[1].gap: -2.5E-325"),
        ("a.json", '{"beam": {"EI": 0e-400, "spans": [1e-310]}, "loads": [{"F": 10.0e-400}]}', "loads[0].F: 10.0e-400"),
        ("a.json", '{"beam": {"EI": 0.' + 330 * "0" + "1}}", "beam.EI: 0.0"),
    ],
)
def test_numbers_too_small_for_a_double(tmp_path, name, text, place):
    """They would be taken to be zero; what is written as zero is."""
    (tmp_path / name).write_text(text)
    with pytest.raises(SceneError, match=re.escape(place) + ".* is nearer to zero than any number of double precision, 4.9e-324; "):
        read_scene(tmp_path / name)


def test_numbers_that_no_double_holds_are_all_told_with_their_lines(tmp_path):
    path = tmp_path / "a.toml"
    path.write_text("[beam]\nEI = 1e400\nspans = [6.0, 1e-400]\n")
    with pytest.raises(SceneError) as caught:
        read_scene(path)
    first, second = str(caught.value).split("\n")
    assert first.startswith(f"{path}:2: beam.EI: 1e400 is beyond")
    assert second.startswith(f"{path}:3: beam.spans[1]: 1e-400 is nearer to zero")


def test_other_files(tmp_path):
    assert write(tmp_path, "scene.yaml", "") == ': a scene file ends in .toml or .json, not in ".yaml"'
    assert write(tmp_path, "scene", "") == ': a scene file ends in .toml or .json, not in ""'
    path = tmp_path / "none.toml"
    with pytest.raises(SceneError) as caught:
        read_scene(str(path))
    assert str(caught.value) == f"{path}: there is no such file"
    (tmp_path / "folder.json").mkdir()
    with pytest.raises(SceneError) as caught:
        read_scene(tmp_path / "folder.json")
    assert str(caught.value) == f"{tmp_path / 'folder.json'}: cannot be read (Is a directory)"
    path = tmp_path / "list.json"
    path.write_text("[1]")
    with pytest.raises(SceneError) as caught:
        read_scene(path)
    assert str(caught.value) == f"{path}: expected a table with beam, supports and loads, got [1]"


# The exception


def test_scene_error():
    error = SceneError("supports[2].gap", "wrong")
    assert isinstance(error, GapbeamError)
    assert isinstance(error, ValueError)
    assert (str(error), error.place, error.problem) == ("supports[2].gap: wrong", "supports[2].gap", "wrong")
    assert (str(SceneError("wrong")), SceneError("wrong").place) == ("wrong", "")


def test_numbers_of_other_kinds_are_refused_as_what_they_are():
    expected = 'supports[0].gap: expected a number, got "a"'
    assert message(supports=[{"x": Fraction(1, 2), "gap": "a"}]) == expected
    assert message(supports=[{"x": np.float64(0.5), "side": "up"}]).endswith('one that holds it down only is "above"')


@pytest.mark.parametrize("length", [59, 60, 61, 1000])
def test_values_of_up_to_sixty_characters_are_shown_whole(length):
    word = ("0123456789" * 100)[:length]
    assert shown(word) == (f'"{word}"' if length <= 60 else f'"{word[:57]}..."')
    assert message(supports=[{"x": word}]).endswith(f"got {shown(word)}")
