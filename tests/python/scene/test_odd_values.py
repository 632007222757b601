"""Values and keys that no scene holds: refused in words, whatever Python makes of them."""

import math
import warnings
from fractions import Fraction

import numpy as np
import pytest
from gapbeam.base.errors import SceneError
from gapbeam.scene import Beam, Scene, Support, read_scene

BEAM = {"spans": [6.0, 6.0, 6.0], "EI": 1.0e4}


def message(**parts):
    """Message with which a scene is refused."""
    with pytest.raises(SceneError) as caught:
        read_scene({"beam": BEAM} | parts)
    return str(caught.value)


@pytest.mark.parametrize(
    ("key", "shown"), [("", '""'), ("a.b", '"a.b"'), ("a b", '"a b"'), ("\x1b[2J", r'"\u001b[2J"'), ("Ä", '"Ä"'), ("a-1_", "a-1_")]
)
def test_keys_stand_as_in_toml(key, shown):
    keys = "node, x, name, side, stiffness, gap, settlement, rotation, at_hinge, direction, friction, law and unloading"
    assert message(supports=[{"x": 1.0, key: 1}]) == f"supports[0].{shown}: unknown key; the keys are {keys}"
    assert message(**{key: 1}).startswith(f"{shown}: unknown key; the keys are title, units")
    assert message(beam=BEAM | {key: 1}).startswith(f"beam.{shown}: unknown key; the keys are spans, EI")
    assert message(supports=[{"x": 1.0, "Gap ": 1}]) == 'supports[0]."Gap ": unknown key; did you mean "gap"?'


def nested(kind, depth):
    value = 1.0
    for _ in range(depth):
        value = kind(value)
    return value


ENDLESS_LIST, ENDLESS_TABLE = [], {}
ENDLESS_LIST.append(ENDLESS_LIST)
ENDLESS_TABLE["x"] = ENDLESS_TABLE


@pytest.mark.parametrize("value", [nested(lambda v: [v], 10**5), nested(lambda v: {"a": v}, 10**5), ENDLESS_LIST, ENDLESS_TABLE])
def test_deep_nesting(value):
    for parts in ({"supports": value}, {"beam": {"spans": value}}, {"supports": [Support(x=value)]}, {"a": value}):
        with pytest.raises(SceneError, match=r"^the scene: tables or lists are nested too deeply$"):
            read_scene({"beam": BEAM} | parts)
    with pytest.raises(SceneError):
        read_scene(value)


@pytest.mark.parametrize("digits", [30, 400, 4000, 5000])
@pytest.mark.parametrize("sign", [1, -1])
def test_long_integers(digits, sign):
    value = sign * 10**digits
    shown = "an integer of more than 4300 digits" if digits > 4300 else str(value)
    shown = shown if len(shown) <= 60 else shown[:57] + "..."
    if digits > 30:
        assert message(supports=[{"x": value}]).startswith(f"supports[0].x: {shown} is beyond the largest number")
        assert message(beam=BEAM | {"spans": [value]}).startswith(f"beam.spans[0]: {shown} is beyond the largest number")
    assert message(title=value) == f"title: expected a text in quotes, got {shown}"
    problem = message(supports=[{"node": value}])
    assert problem.startswith("supports[0].node: ")
    assert problem.endswith(f"got {shown}") or (digits == 30 and sign < 0)
    assert message(analysis={"steps": value}).endswith(f"got {shown}")


@pytest.mark.parametrize(
    ("value", "shown"),
    [
        (np.longdouble("1.5"), f"1.5 ({np.longdouble.__name__}; take float() of it)"),
        (np.clongdouble(2), f"(2+0j) ({np.clongdouble.__name__}; take float() of it)"),
        (np.ma.masked, "masked"),
        (np.ma.array(1.0, mask=True), "masked"),
        (1 + 2j, "(1+2j)"),
        (Fraction(10**400), "1" + 56 * "0" + "..."),
    ],
)
def test_what_is_no_number(value, shown):
    """Neither rounded nor taken for a key that is left out."""
    for parts in ({"supports": [{"x": value}]}, {"supports": [Support(x=value)]}):
        assert message(**parts).startswith(f'supports[0].x: expected a number, got "{shown}"')
    for spans in ([6.0, value], np.array([6.0, 1.0], dtype=object)):
        spans[1] = value
        assert message(beam=BEAM | {"spans": spans}).startswith("beam.spans[1]: expected a number, got ")


def test_masked_arrays():
    spans = np.ma.array([6.0, 6.0, 6.0], mask=[False, False, True])
    assert message(beam=BEAM | {"spans": spans}) == 'beam.spans[2]: expected a number, got "masked"'
    spans.mask = False
    assert read_scene({"beam": BEAM | {"spans": spans}}).beam.spans == [6.0, 6.0, 6.0]
    assert message(beam=BEAM | {"spans": np.ones(3, np.longdouble)}).startswith("beam.spans[0]: expected a number, got ")


def test_halves_of_characters():
    """Titles may hold them, keys and choices are none."""
    half = "a\ud800"
    assert read_scene({"title": half, "beam": BEAM}).title == half
    assert read_scene(Scene(title=half, beam=Beam(**BEAM))).title == half
    assert message(title=half, supports=[{"x": 1.0, half: 2}]).startswith(r'supports[0]."a\\ud800": unknown key; ')
    assert message(supports=[{"x": 1.0, "side": half}]).startswith("supports[0].side: expected ")


@pytest.mark.parametrize("spans", [[6.0, math.inf], [math.nan], [1e308, 1e308, -math.inf]])
def test_endless_spans_are_refused_without_a_warning(spans):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(SceneError, match=r"beam\.spans"):
            read_scene({"beam": {"spans": spans, "EI": 1.0}})
