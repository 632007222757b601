"""Lane loads on parts of spans, beside closed forms, strips solved in rational numbers, and placements drawn at random."""

import random
from itertools import pairwise

import gapbeam
import numpy as np
import oracle
import pytest
from gapbeam.report import report_text
from scenes import at, force, scene, uniform

Q, SPAN = 16.0, 4.0
STRIPS = 32
"""Of every span."""
EXACT, LOWER = "are the largest for", "are a lower bound of the largest for"


def lanes(supports, spans, loads=(), **changes):
    """A beam with a lane load that may be on any parts of spans."""
    made = scene(spans, supports, [*loads, uniform(Q, case="lane", **changes)], EI=1e4)
    factors = {"lane": 1.0} | ({"dead": 1.0} if loads else {})
    return made | {"combinations": [{"name": "c", "factors": factors, "expand": {"lane": "parts"}}]}


def strips(made):
    """The lane load of a scene in strips."""
    end = sum(made["beam"]["spans"])
    edges = np.linspace(0.0, end, STRIPS * len(made["beam"]["spans"]) + 1).tolist()
    return [uniform(Q, **{"from": a, "to": b}) for a, b in pairwise(edges)]


def test_shear_of_a_simple_span():
    """Right of x: q (L - x)**2 / 2L from the load on the right, at midspan q L/8, where the whole span gives none."""
    result = gapbeam.solve(lanes([at(0), at(1)], [SPAN]))
    x = SPAN * np.arange(1, 10) / 10
    curves = result.envelope(x=x).fields
    assert curves.largest["shear"] == pytest.approx(Q * (SPAN - x) ** 2 / (2 * SPAN), rel=1e-12)
    assert curves.smallest["shear"] == pytest.approx(-Q * x**2 / (2 * SPAN), rel=1e-12)
    assert curves.largest["shear"][4] == pytest.approx(Q * SPAN / 8, rel=1e-12)
    assert curves.largest["moment"] == pytest.approx(Q * x * (SPAN - x) / 2, rel=1e-12)
    assert result.names[:2] == ("c [lane whole]", "c [lane none]")
    assert "c [lane max shear at 2]" in result.names
    assert EXACT in result.remarks[0]
    assert "any parts of spans" in report_text(result)
    # Factors and loads that act up turn the signs
    made = lanes([at(0), at(1)], [SPAN])
    made["loads"].append(uniform(-2.0 * Q, case="lane", to=3 * SPAN / 4))
    made["combinations"][0]["factors"]["lane"] = -2.0
    shear = gapbeam.solve(made).envelope(x=[SPAN / 2]).fields
    found = shear.largest["shear"][0], shear.smallest["shear"][0]
    assert found == pytest.approx((5 * Q * SPAN / 8, -6 * Q * SPAN / 8), rel=1e-12)


def test_three_spans_beside_strips():
    """All strips that add to a value, each solved in rational numbers: less than the parts by what the strips cut wrongly."""
    made = lanes([at(k) for k in range(4)], [SPAN, 5.0, SPAN])
    result = gapbeam.solve(made)
    curves = result.envelope(x=[2.0, 4.0, 5.0, 6.5]).fields
    single = [oracle.solve({**made, "combinations": [], "loads": [strip]}) for strip in strips(made)]
    for k, x in enumerate((2.0, 4.0, 5.0, 6.5)):
        for name in ("moment", "deflection") if x == 4.0 else ("moment", "shear", "deflection"):
            parts = np.array([float(getattr(one.at(x), name)) for one in single])
            if name == "deflection" and x == 4.0:
                continue
            for found, true in ((curves.largest, parts[parts > 0.0].sum()), (curves.smallest, parts[parts < 0.0].sum())):
                assert 0.0 <= np.sign(true) * (found[name][k] - true) + 1e-12 <= 0.02 * np.abs(parts).sum(), (name, x)
    reactions = np.array([[float(force) for force in one.reaction] for one in single])
    for k, row in enumerate(result.envelope().supports):
        for kind, part in (("max", reactions[:, k].clip(min=0.0)), ("min", reactions[:, k].clip(max=0.0))):
            assert row["reaction"][kind].value == pytest.approx(part.sum(), abs=0.02 * np.abs(reactions[:, k]).sum())
    assert EXACT in result.remarks[0]


def test_a_picture_has_one_name_for_all_placements():
    made = lanes([at(0), at(1)], [SPAN], [uniform(1.0, case="dead")])
    made["combinations"] += [{"name": "heavy", "factors": {"dead": 200.0}, "limit_state": "ULS"}]
    written = "".join(text.get_text() for text in gapbeam.solve(made).plot().texts).replace("\N{NO-BREAK SPACE}", " ")
    assert "= heavy (ULS)" in written
    assert "= c [lane on parts]" in written
    assert "lane max" not in written


def drawn(made, seed, count=60):
    """States with the lane load on strips drawn at random."""
    rng, loads = random.Random(seed), [load for load in made["loads"] if load["case"] != "lane"]
    for _ in range(count):
        few = rng.random()
        yield gapbeam.solve(made | {"combinations": [], "loads": loads + [one for one in strips(made) if rng.random() < few]})


def test_nothing_is_beyond_where_no_support_changes_its_state():
    dead = uniform(3.0 * Q, case="dead")
    made = lanes([at(0, side="below"), at(1, side="below", stiffness=2e4), at(2), at(3, side="below")], [SPAN] * 3, [dead])
    result = gapbeam.solve(made)
    assert EXACT in result.remarks[0]
    x = np.arange(1, 30) * SPAN / 10
    curves, supports = result.envelope(x=x).fields, result.envelope().supports
    for one in drawn(made, 3):
        for name in ("moment", "shear", "deflection"):
            slack = 1e-12 * np.abs(curves.largest[name]).max()
            values = getattr(one.at(x), name)
            assert (curves.smallest[name] - slack <= values).all()
            assert (values <= curves.largest[name] + slack).all()
        for row, reaction in zip(supports, one.steps[-1].reaction, strict=True):
            assert row["reaction"]["min"].value - 1e-9 <= reaction <= row["reaction"]["max"].value + 1e-9


def test_a_lower_bound_where_supports_change_their_state():
    """More than whole spans make, and no more than what some placement makes; the answer says that it is a lower bound."""
    made = lanes([at(k, side="below") for k in range(4)], [SPAN] * 3, [uniform(1.0, case="dead")])
    result = gapbeam.solve(made)
    assert len({state.state for state in (one.steps[-1] for one in result.combinations.values())}) > 1
    assert LOWER in result.remarks[0]
    assert "supports change their state with it" in report_text(result).replace("\n", " ")
    spans = made | {"combinations": [made["combinations"][0] | {"expand": {"lane": "spans"}}]}
    for name, row in gapbeam.solve(spans).extremes.items():
        if name in ("moment", "shear"):
            assert result.extremes[name]["max"].value >= row["max"].value * (1 - 1e-12)
            assert result.extremes[name]["min"].value <= row["min"].value * (1 - 1e-12)
    # Every combination is what the scene with these loads gives
    for name in result.names[::9]:
        one = result.combinations[name]
        assert gapbeam.solve(one.scene).steps[-1].reaction == pytest.approx(one.steps[-1].reaction, rel=1e-12)


def test_a_law_that_changes_its_piece():
    law = {"side": "below", "law": [[0.001, 20.0], [0.01, 30.0]]}
    weak = gapbeam.solve(lanes([at(0), at(1, **law), at(2)], [SPAN] * 2))
    assert LOWER in weak.remarks[0]
    dead = uniform(0.01, case="dead")
    strong = gapbeam.solve(lanes([at(0), at(1, side="both", law=[[1.0, 1e6], [2.0, 1e7]]), at(2)], [SPAN] * 2, [dead]))
    assert EXACT in strong.remarks[0]


def test_trains_beside_it():
    made = lanes([at(0), at(1), at(2)], [SPAN] * 2) | {"trains": [{"name": "t", "axles": [[0.0, 10.0]], "case": "train"}]}
    made["combinations"][0]["factors"]["train"] = 1.0
    result = gapbeam.solve(made)
    assert "trains pass as well" in result.remarks[0]
    shear = result.envelope(x=[2.0]).fields.largest["shear"][0]
    alone = {kind: gapbeam.solve(made | {"trains": trains, "combinations": [made["combinations"][0] | {"factors": factors}]})
             for kind, trains, factors in (("lane", [], {"lane": 1.0}),)}  # fmt: skip
    axle = gapbeam.solve(made | {"loads": [], "combinations": []}).envelope(x=[2.0]).fields.largest["shear"][0]
    assert shear == pytest.approx(alone["lane"].envelope(x=[2.0]).fields.largest["shear"][0] + axle, rel=1e-12)


def test_a_load_on_a_stretch_and_a_batch(tmp_path):
    made = lanes([at(0), at(1)], [SPAN], to=3.0)
    result = gapbeam.solve(made)
    shear = Q * (2.0**2 - 1.0**2) / (2 * SPAN)
    assert result.envelope(x=[2.0]).fields.largest["shear"][0] == pytest.approx(shear, rel=1e-12)
    rows = gapbeam.batch(made, {"loads[0].q": [Q, 2.0 * Q]}, tmp_path / "rows", want=["moment", "shear"]).read()
    for name in ("moment", "shear"):
        largest = result.extremes[name]["max"].value
        assert rows[f"{name}.max"] == pytest.approx([largest, 2.0 * largest], rel=1e-12)


def test_supports_that_loads_move():
    """They are where they are at full load, as settlements put them; a case that does not act moves nothing."""
    made = lanes([at(k, side="below") for k in range(3)], [6.0, 6.0], [uniform(2.0, case="dead")])
    moved = made | {"loads": [*made["loads"], {"type": "movement", "support": 1, "value": 0.01, "case": "mining"}]}
    (one,) = made["combinations"]

    def largest(some, **more):
        result = gapbeam.solve(some | {"combinations": [one | more]})
        return {name: row["max"].value for name, row in result.envelope().extremes.items()}, EXACT in result.remarks[-1]

    assert largest(moved) == largest(made)
    acts = largest(moved, factors=one["factors"] | {"mining": 1.5})
    settled = largest(made, settlements={"1": 0.015})
    assert acts[0] == pytest.approx(settled[0], rel=1e-12)
    assert acts[1]
    assert settled[1]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"foundation": [{"k": 100.0, "side": "below"}]}, 'combinations "c".expand.lane: "parts" needs influence lines'),
        ({"supports": [at(0), at(1, side="below", law={"type": "tanh", "stiffness": 1e3, "limit": 5.0})]}, "needs influence lines"),
        ({"loads": [force(1.0, 5.0, case="lane")]}, 'a case with expand = "parts" has uniform loads only'),
        ({"combinations": [{"name": "c", "factors": {"lane": 1.0, "wind": 1.0}, "expand": {"lane": "parts", "wind": "signs"}}]},
         '"parts" goes with no other pattern'),
        ({"combinations": [{"name": "b", "factors": {"lane": 1.0}},
                           {"name": "c", "factors": {"lane": 1.0}, "expand": {"lane": "parts"}, "scheme_of": "b"}]},
         'scheme_of: does not go with expand = "parts"'),
    ],
)  # fmt: skip
def test_refusals(change, message):
    made = lanes([at(0), at(1)], [SPAN])
    made["loads"].append(uniform(1.0, case="wind"))
    with pytest.raises(gapbeam.SceneError) as caught:
        gapbeam.solve(made | change)
    assert message in str(caught.value)
