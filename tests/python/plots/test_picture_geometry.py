"""Geometry of all kinds of pictures: no text covers another one or leaves the page, and every number is one of the result."""

import re

import gapbeam
import numpy as np
import pytest
import scenes
from gapbeam.plots import figure, hysteresis_figure, path_figure
from gapbeam.plots.save import picture
from gapbeam.plots.sheet import is_upright
from gapbeam.plots.support_values import DIGITS
from gapbeam.results.formatting import number
from gapbeam.studies.meshes import gapped_spans
from matplotlib.text import Text

KN_M = {"units": {"force": "kN", "length": "m"}}
MINUS = "\N{MINUS SIGN}"


def pile(springs):
    """A pile on springs that yield on both sides, pushed at its head and loaded along its axis."""
    law = {"type": "plastic", "stiffness": 4000.0, "limit": 150.0 / springs}
    depths = np.linspace(1.0, 12.0, springs // 2 + 1).round(3).tolist()
    supports = [scenes.at(x=x, side=side, law=law) for x in depths for side in ("below", "above")]
    loads = [scenes.force(0.0, 20.0), scenes.uniform(2.0, to=3.0), scenes.moment(0.0, 10.0)]
    made = scenes.scene([12.0], supports, loads, EI=2e5) | KN_M
    made["beam"] |= {"direction": "down"}
    return made


def spans(count, **more):
    """A beam on springs that can lift off, with names, gaps and a settlement."""
    supports = [
        scenes.at(i, side="below", stiffness=1e5, gap=0.001 * (i % 3), name=f"P{i}", settlement=0.01 * (i == 1))
        for i in range(count + 1)
    ]  # fmt: skip
    return scenes.scene([6.0] * count, supports, [scenes.uniform(5.0, case="dead")], EI=2e4) | KN_M | more


def combined(count, upright=False):
    """Combinations that push spans down and up."""
    rng = np.random.default_rng(3)
    made = spans(count)
    for case, sign in (("wind", -1.0), ("snow", 1.0)):
        made["loads"] += [scenes.uniform(sign * float(q), case=case, **scenes.stretch(6.0 * j, 6.0 * j + 6.0))
                          for j, q in enumerate(rng.uniform(0.0, 12.0, count))]  # fmt: skip
    factors = [{"dead": 1.35, "snow": 1.5}, {"dead": 0.9, "wind": 1.5}, {"dead": 1.0, "snow": 0.7, "wind": 0.6}, {"dead": 1.35}]
    made["combinations"] = [{"name": f"combination {k}", "factors": one} for k, one in enumerate(factors)]
    if upright:
        made["beam"] |= {"direction": "down"}
    return made


def trains(count):
    """A crane that goes both ways, and a lighter one."""
    heavy = {"name": "crane", "axles": [[0.0, 90.0], [2.0, 90.0]], "both_directions": True}
    return spans(count, trains=[heavy, {"name": "trolley", "axles": [[0.0, 70.0]]}])


def lifted(count):
    supports = [scenes.at(0), *(scenes.at(i, side="below", gap=0.002 * (i % 3)) for i in range(1, count + 1))]
    loads = [scenes.uniform(2.0, case="dead"), scenes.force(6.0 * count, -4.2 * count)]
    return scenes.scene([6.0] * count, supports, loads, EI=1e4, analysis={"follow": "events"}) | KN_M


MADE = {
    **{f"pile {n}": (pile, n, figure) for n in (3, 12, 50)},
    **{f"state {n}": (gapped_spans, n, figure) for n in (3, 12, 50, 1000)},
    **{f"combinations {n}": (combined, n, figure) for n in (3, 12, 50)},
    "combinations upright": (lambda n: combined(n, upright=True), 3, figure),
    **{f"trains {n}": (trains, n, figure) for n in (3, 12)},
    **{f"path {n}": (lifted, n, path_figure) for n in (3, 12, 50)},
}


@pytest.fixture(scope="module", params=MADE)
def drawn(request):
    make, count, draw = MADE[request.param]
    result = gapbeam.solve(make(count))
    made = draw(result)
    made.draw_without_rendering()
    return result, made


def texts(made):
    """Every text of a figure that is seen, with its rectangle: ticks beyond the ends of an axis are not."""
    hidden = set()
    for axes in made.axes:
        for axis, limits in ((axes.xaxis, axes.get_xlim()), (axes.yaxis, axes.get_ylim())):
            for tick in axis.get_major_ticks():
                out = not min(limits) <= tick.get_loc() <= max(limits)
                hidden |= {id(label) for label in (tick.label1, tick.label2) if out or not axes.axison or not label.get_visible()}
    seen = [text for text in made.findobj(Text) if text.get_text().strip() and text.get_visible() and id(text) not in hidden]
    return [(text.get_text(), text.get_window_extent()) for text in seen]


def test_no_text_covers_another(drawn):
    _, made = drawn
    found = [(words, box.shrunk(1, 0.7)) for words, box in texts(made)]
    assert [(a, b) for k, (a, one) in enumerate(found) for b, other in found[:k] if one.overlaps(other)] == []


def test_no_text_leaves_the_page(drawn):
    _, made = drawn
    off = [words for words, box in texts(made) if box.x0 < 0 or box.y0 < 0 or box.x1 > made.bbox.x1 or box.y1 > made.bbox.y1]
    assert off == []


def test_reactions_are_those_of_the_result(drawn):
    result, made = drawn
    if result.scene.trains or result.combinations:
        rows = result.envelope().supports
        values = {name: np.concatenate([rows.values(name, kind) for kind in ("max", "min")]) for name in ("reaction", "opening")}
    else:
        step = result.steps[-1]
        values = {"reaction": step.reaction, "opening": step.opening}
    reactions = {number(abs(float(value)), DIGITS) for value in values["reaction"]}
    factor = 1e3 if result.scene.units.length == "m" else 1.0
    openings = {number(factor * float(value), DIGITS) for value in values["opening"]}
    along = 0 if is_upright(result.scene) else 1  # loads are on the other side of the beam
    found = [text.get_text() for text in made.axes[0].texts if (text.get_position()[along] > 0.0) != bool(along)]
    said = [match for words in found for match in re.findall(rf"(?:max|min) {MINUS}?([\d.e-]+)", words)]
    said += [match for words in found for match in re.findall(r"^([\d.]+) kN$", words)]
    opened = [match for words in found for match in re.findall(r"open ([\d.e-]+)", words)]
    assert set(said) <= reactions
    assert set(opened) <= openings
    if result.combinations or result.scene.trains:
        assert len(said) > 3


def test_files_are_small(drawn):
    assert len(picture(drawn[1], ".svg")) < 500_000


def test_piles_stand_upright():
    result = gapbeam.solve(pile(12))
    assert is_upright(result.scene)
    made = figure(result)
    sketch, *panels = made.axes
    assert [axes.get_title().split()[0] for axes in panels] == ["deflection", "moment", "shear"]
    assert all(axes.yaxis_inverted() and not axes.xaxis_inverted() for axes in panels)
    lefts = [axes.get_position().x0 for axes in made.axes]
    assert lefts == sorted(lefts)
    path = next(patch for patch in panels[1].patches if patch.get_label() == "curve").get_path()
    ends = path.vertices[[0, -1]]
    assert ends[:, 1].tolist() == [0.0, 12.0]
    inner = path.vertices[path.codes != 4]
    np.testing.assert_allclose(inner[:, 0], result.at(inner[:, 1]).moment, atol=1e-9 * np.abs(inner).max() + 25.0)
    right = [c.get_offsets()[0] for c in sketch.collections if c.get_label().endswith("below") and len(c.get_offsets())]
    assert right
    assert all(at[0] > 0.0 for at in right)  # what is below a lying beam


def test_curves_are_the_polynomials_themselves():
    """Control points of a span without loads, by the end values and slopes of the moment."""
    result = gapbeam.solve(scenes.scene([4.0, 6.0], [scenes.at(i) for i in range(3)], [scenes.uniform(3.0, to=4.0)], EI=1e3))
    panel = figure(result).axes[2]
    path = next(patch for patch in panel.patches if patch.get_label() == "curve").get_path()
    assert set(path.codes.tolist()) <= {1, 2, 4}
    k = 1
    while path.codes[k] == 4:
        (x0, m0), (x1, m1), (x2, m2), (x3, m3) = path.vertices[k - 1 : k + 3]
        wide = x3 - x0
        assert (x1, x2) == pytest.approx((x0 + wide / 3, x0 + 2 * wide / 3))
        ends = result.at([x0, x3]).shear
        assert m1 == pytest.approx(m0 + wide / 3 * ends[0], abs=1e-9)
        after = result.at(x3, side="left").shear
        assert m2 == pytest.approx(m3 - wide / 3 * after, abs=1e-9)
        k += 3
    assert k > 3
    assert (path.codes[k:] == 2).all()  # without load the moment is straight


def test_hysteresis_gives_the_energy_of_every_cycle():
    """An elastic, perfectly plastic spring of its own: the area of the loop is the yield force times the plastic movement."""
    law = {"type": "plastic", "stiffness": 100.0, "limit": 1.0}
    result = gapbeam.solve(scenes.scene(
        [1.0], [scenes.at(0), scenes.at(1), scenes.at(x=0.5, side="below", law=law, unloading="plastic", name="pad")],
        [scenes.force(0.5, 4.0)], EI=1.0, analysis={"follow": "events", "history": [1.0, 0.0, 1.0, 0.0]},
    ) | KN_M)  # fmt: skip
    made = hysteresis_figure(result, "pad")
    assert "support pad" in made.axes[0].get_title("left")
    said = [float(re.search(r"energy ([\d.]+) kN m", text.get_text())[1]) for text in made.legends[0].get_texts()]
    loaded = result.state(1.0, leg=0)
    plastic = loaded.set[2]
    assert plastic > 0.0
    assert said[0] == pytest.approx(1.0 * plastic, rel=1e-3)  # the second cycle goes where the first one came to
    assert said[1] == pytest.approx(0.0, abs=1e-9)
    assert result.plot("hysteresis").axes[0].get_title("left").endswith("support pad")
    with pytest.raises(ValueError, match="pad"):
        hysteresis_figure(result, "pat")


def test_long_reasons_are_wrapped_and_whole():
    supports = [scenes.at(1, side="below"), scenes.at(2, side="below")]
    result = gapbeam.solve(scenes.scene([2.0, 4.0, 2.0], supports, [scenes.force(8.0, 2.0)]))
    said = " ".join(text.get_text().replace("\n", " ") for text in figure(result).texts)
    assert "..." not in said
    assert result.reason.removeprefix("no equilibrium ")[1:] in said


def test_axles_stand_where_the_largest_moment_is():
    result = gapbeam.solve(trains(3))
    extremes = [one for one in result.envelope().extremes["moment"].values() if one is not None]
    most = max(extremes, key=lambda one: abs(one.value))
    made = figure(result)
    (lines,) = (c for c in made.axes[0].collections if c.get_label() == "forces")
    places = sorted({float(line[0, 0]) for line in lines.get_segments()})
    axles = sorted(float(load.x) for load in most.state.result.scene.loads if isinstance(load, gapbeam.ForceLoad))
    assert places == pytest.approx(axles)
    notes = " ".join(text.get_text() for text in made.texts)
    assert f"{most.train}" in notes
    assert f"at position {number(most.position, 4)} m" in notes


def test_axles_are_no_loads_of_a_case():
    """Also where a case does not act in the combination, which has less loads than the scene."""
    crane = {"name": "crane", "axles": [[0.0, 90.0], [2.0, 80.0]], "case": "crane"}
    loads = [scenes.uniform(2.0, case="dead"), scenes.force(3.0, 1.0, case="wind")]
    supports = [scenes.at(k) for k in range(3)]
    made = scenes.scene([6.0, 6.0], supports, loads) | {"trains": [crane]}
    made["combinations"] = [{"name": "uls", "factors": {"dead": 1.0, "crane": 1.5}}]
    words = [text.get_text() for axes in figure(gapbeam.solve(made)).axes for text in axes.texts]
    assert {"135 axle", "120 axle"} <= set(words)
    assert not any("live" in word for word in words)
