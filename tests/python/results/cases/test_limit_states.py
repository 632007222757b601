"""Envelopes of the combinations of one limit state, beside scenes that have no others."""

import json

import gapbeam
import jsonschema
import numpy as np
import pytest
from gapbeam.report import report_text, to_json
from scenes import at, scene, uniform

SLS, ULS = "SLS characteristic", "ULS"


def made(trains=False, **changes):
    """Three spans on bearings; combinations of two limit states, and one of none."""
    loads = [uniform(3.0, case="dead"), uniform(10.0, to=5.0, case="live"), uniform(-4.0, **{"from": 5.0}, case="wind")]
    found = scene([5.0, 6.0, 5.0], [at(k, side="below") for k in range(4)], loads, EI=1e4)
    found["combinations"] = [
        {"name": "6.10", "factors": {"dead": 1.35, "live": 1.5}, "limit_state": ULS},
        {"name": "uplift", "factors": {"dead": 0.9, "wind": 0.7, "crane": 1.5}, "limit_state": ULS},
        {"name": "often", "factors": {"dead": 1.0, "live": 0.7, "crane": 1.0}, "expand": {"live": "signs"}, "limit_state": SLS},
        {"name": "erection", "factors": {"dead": 1.0}},
    ]
    if trains:
        found["trains"] = [{"name": "crane", "axles": [[0.0, 20.0], [2.0, 20.0]], "case": "crane"}]
    else:
        for one in found["combinations"]:
            one["factors"].pop("crane", None)
    return found | changes


def only(written, name):
    """The scene with the combinations of one limit state alone."""
    return written | {"combinations": [one for one in written["combinations"] if one.get("limit_state") == name]}


@pytest.mark.parametrize("trains", [False, True])
@pytest.mark.parametrize("name", [ULS, SLS])
def test_envelopes_of_limit_states(name, trains):
    written = made(trains)
    result = gapbeam.solve(written)
    assert result.limit_states == (ULS, SLS)
    alone = gapbeam.solve(only(written, name)).envelope()
    envelope = result.envelope(limit_state=name)
    for quantity, row in alone.extremes.items():
        for kind, one in row.items():
            found = envelope.extremes[quantity][kind]
            assert (found.value, found.x, found.combination) == (one.value, one.x, one.combination)
    for support, true in zip(envelope.supports, alone.supports, strict=True):
        for quantity in ("reaction", "opening"):
            for kind, one in true[quantity].items():
                assert (support[quantity][kind].value, support[quantity][kind].combination) == (one.value, one.combination)
    for quantity in ("moment", "shear", "deflection"):
        assert np.array_equal(envelope.fields.largest[quantity], alone.fields.largest[quantity])
        assert np.array_equal(envelope.fields.smallest[quantity], alone.fields.smallest[quantity])
        assert envelope.at([2.0, 8.0]).largest[quantity] == pytest.approx(alone.at([2.0, 8.0]).largest[quantity], rel=1e-13)
    table = envelope.columns()
    assert set(table["moment_max_combination"]) <= set(alone.columns()["moment_max_combination"]) | {None}


@pytest.mark.parametrize("trains", [False, True])
def test_what_tells_them(trains):
    result = gapbeam.solve(made(trains))
    data = json.loads(to_json(result))
    jsonschema.validate(data, gapbeam.result_schema())
    assert list(data["envelopes"]) == [ULS, SLS]
    assert [one.get("limit_state") for one in data["combinations"]] == [ULS, ULS, SLS, SLS, None]
    for name in (ULS, SLS):
        value, *_ = data["envelopes"][name]["extremes"]["moment"]["max"]
        assert value == result.envelope(limit_state=name).extremes["moment"]["max"].value
    assert result.combinations.columns()["limit_state"] == [ULS, ULS, SLS, SLS, ""]
    text = report_text(result)
    heads = ["What governs while trains pass, all other loads in full, {}"] if trains else ["What governs, {} at full load"]
    heads += ["Supports while trains pass, {}"] if trains else ["Supports, {} at full load"]
    for head in heads:
        assert all(head.format(name) in text for name in (ULS, SLS))
    assert ("all combinations at full load" in text) != trains
    assert "limit state" in result.to_html()
    written = "".join(text.get_text() for text in result.plot().texts)
    assert f"({ULS})" in written.replace("\N{NO-BREAK SPACE}", " ")


def test_all_have_one():
    written = made()
    result = gapbeam.solve(written | {"combinations": written["combinations"][:3]})
    assert "all combinations at full load" not in report_text(result)


def test_one_that_is_not_solved():
    written = made(supports=[at(1, side="below"), at(2, side="below")])
    written["combinations"] = [
        {"name": "up", "factors": {"wind": 1.0}, "limit_state": ULS}, {"name": "down", "factors": {"dead": 1.0}, "limit_state": SLS}
    ]  # fmt: skip
    result = gapbeam.solve(written)
    assert result.statuses == ("no-equilibrium", "solved")
    assert list(json.loads(to_json(result))["envelopes"]) == [SLS]
    assert "What governs, SLS characteristic" in report_text(result)
    with pytest.raises(ValueError, match="no combination is solved"):
        result.envelope(limit_state=ULS)


def test_refusals():
    result = gapbeam.solve(made())
    with pytest.raises(ValueError, match=r'limit_state: there is no "SLS"; there are "ULS" and "SLS characteristic"'):
        result.envelope(limit_state="SLS")
    with pytest.raises(ValueError, match=r'limit_state: there is no ""; there are'):
        result.envelope(limit_state="")
    without = gapbeam.solve(made(combinations=[{"name": "a", "factors": {"dead": 1.0}}]))
    assert without.limit_states == ()
    assert "envelopes" not in json.loads(to_json(without))
    with pytest.raises(ValueError, match=r'limit_state: no combination has one; write for example limit_state = "ULS"'):
        without.envelope(limit_state=ULS)
    with pytest.raises(gapbeam.SceneError, match=r"combinations\[0\]\.limit_state: expected a text"):
        gapbeam.read_scene(made(combinations=[{"name": "a", "factors": {"dead": 1.0}, "limit_state": 6.1}]))
