"""Labels of pictures: none covers another one or the axes, and every number is one of the result."""

import re

import gapbeam
import numpy as np
import pytest
from gapbeam.plots import figure, path_figure
from gapbeam.plots.marks import DIGITS
from gapbeam.plots.save import picture
from gapbeam.plots.support_values import short_names
from gapbeam.results.formatting import number
from gapbeam.studies.meshes import gapped_spans
from matplotlib.text import Text

SPANS = [3, 12, 50, 1000]
MINUS = "\N{MINUS SIGN}"


@pytest.fixture(scope="module", params=SPANS)
def drawn(request):
    result = gapbeam.solve(gapped_spans(request.param))
    made = figure(result)
    made.draw_without_rendering()
    return result, made


def words(axes):
    return [text for text in axes.texts if text.get_text()]


def test_no_label_covers_another(drawn):
    _, made = drawn
    for axes in made.axes:
        boxes = [text.get_window_extent().shrunk(1, 0.7) for text in words(axes)]
        assert not [(a, b) for k, a in enumerate(boxes) for b in boxes[:k] if a.overlaps(b)]


def test_no_label_covers_the_axes_or_leaves_the_page(drawn):
    _, made = drawn
    for axes in made.axes[1:]:
        for text in words(axes):
            box = text.get_window_extent()
            assert axes.bbox.x0 <= box.x0
            assert box.x1 <= made.bbox.x1
        ticks = [tick.get_window_extent() for tick in axes.get_xticklabels() if tick.get_text() and tick.get_visible()]
        assert not any(a.overlaps(b) for k, a in enumerate(ticks) for b in ticks[:k])


def test_reactions_and_openings_are_those_of_the_result(drawn):
    result, made = drawn
    step = result.steps[-1]
    names = {str(k) for k in range(len(step.reaction))}
    reactions = {number(abs(value), DIGITS) for value in step.reaction} | {"0"}
    openings = {f"open {number(value, DIGITS)}" for value in step.opening}
    shown = [text.get_text().split(": ")[-1] for text in words(made.axes[0]) if text.get_position()[1] < -15.0]
    shown = [text for text in shown if not re.match(r"gap|reaction|two-way|in contact|no contact|hardens|spring|\d+ gaps", text)]
    assert len(shown) > 3
    assert set(shown) <= names | reactions | openings
    assert "open" not in step.state or max(openings, key=lambda text: float(text[5:])) in shown


def test_moments_are_those_of_the_result(drawn):
    result, made = drawn
    (panel,) = (axes for axes in made.axes if axes.get_ylabel().startswith("moment"))
    dots = [line.get_xydata()[0] for line in panel.lines if line.get_marker() == "o"]
    assert len(dots) == len(words(panel)) >= 3
    for (x, value), text in zip(dots, words(panel), strict=True):
        assert text.get_text().split(" at ")[0] == number(value, DIGITS).replace("-", MINUS)
        assert min(abs(result.at(x, side=side).moment - value) for side in ("left", "right")) <= 1e-9 * abs(value)
        ends = result.scene.span_ends()
        if np.abs(ends - x).min() > 1e-3:  # a peak; the largest value of a span may stand at its end
            around = result.at(x + np.array([-1e-3, 1e-3])).moment
            assert (np.sign(value) * around <= abs(value) * (1 + 1e-9)).all()


def test_files_are_small(drawn):
    assert len(picture(drawn[1], ".svg")) < 500_000


def test_arrows_point_as_reactions_push(drawn):
    result, made = drawn
    if len(result.scene.supports) > 100:
        return
    push = result.steps[-1].reaction
    push = push[np.abs(push) > 1e-9 * np.abs(push).max()]
    heads = {c.get_label(): len(c.get_offsets()) for c in made.axes[0].collections if c.get_label().startswith("reactions")}
    assert heads.get("reactions up", 0) == (push > 0.0).sum()
    assert heads.get("reactions down", 0) == (push < 0.0).sum()


def long_names():
    """Names that would run into one another and off the page."""
    names = ["western abutment, bearing number one", "pier A, left bearing", "pier A, right bearing", "temporary prop", "pier B",
             "pier B, second row", "eastern abutment, expansion bearing"]  # fmt: skip
    supports = [{"node": k, "side": "below", "name": name, "gap": 0.001 * (k in (1, 2))} for k, name in enumerate(names)]
    loads = [{"type": "uniform", "q": 2.0, "case": "dead"}, {"type": "force", "x": 3.0, "F": 160.0, "name": "heavy transformer"},
             {"type": "force", "x": 18.6, "F": 16.0, "name": "a second transformer on a lorry"}]  # fmt: skip
    return {
        "title": "Pipe bridge over the river at kilometre 17.4, northern approach, cold, with all hold-downs removed, " * 2,
        "units": {"force": "kN", "length": "m"}, "beam": {"spans": [6.0, 0.4, 5.6, 0.3, 0.3, 6.0], "EI": 1e4},
        "supports": supports, "loads": loads,
    }  # fmt: skip


@pytest.mark.parametrize("draw", [figure, path_figure])
def test_long_names_and_titles_stand_on_the_page_and_apart(draw):
    made = draw(gapbeam.solve(long_names()))
    made.draw_without_rendering()
    texts = [text for text in made.findobj(Text) if text.get_text() and text.get_visible()]
    shown = {text: text.get_window_extent() for text in texts}
    assert [t.get_text() for t, box in shown.items() if not (0.0 <= box.x0 <= box.x1 <= made.bbox.x1)] == []
    title = next(text for text in texts if text.get_text().startswith("Pipe bridge"))
    assert title.get_text().count("\n") == 1
    assert title.get_text().endswith("...")
    drawn = [shown[text].shrunk(1, 0.7) for text in [title, *made.axes[0].texts] if text in shown]
    assert not [(a, b) for k, a in enumerate(drawn) for b in drawn[:k] if a.overlaps(b)]


def test_every_support_with_a_long_name_is_named_where_it_is():
    result = gapbeam.solve(long_names())
    texts = [text.get_text() for text in figure(result).axes[0].texts]
    for name in ("western abutment, beari...", "pier A, right bearing: open", "temporary prop: open", "eastern abutment, expan..."):
        assert any(text.startswith(name) for text in texts)
    names = [f"bearing of the northern girder {way}" for way in ("left", "right")]
    scene = {"beam": {"spans": [6.0], "EI": 1.0}, "supports": [{"node": k, "name": name} for k, name in enumerate(names)]}
    assert short_names(gapbeam.read_scene(scene)) == ["bearing of t... girder left", "bearing of t...girder right"]


def test_loads_that_move_supports_are_drawn_with_value_and_unit():
    """Upward at a jack, along the beam at its fixed point, around at a clamp and in a hinge; as far as the load has grown."""
    result = gapbeam.solve({
        "units": {"force": "kN", "length": "m"}, "beam": {"spans": [6.0, 6.0], "EI": 1e4, "EA": 1e6},
        "supports": [{"node": 0, "rotation": "fixed"}, {"node": 0, "direction": "axial"},
                     {"node": 1, "side": "below", "name": "jack"}, {"node": 2}],
        "hinges": [{"x": 4.0, "slack": 0.004, "stiffness": 3e3, "name": "splice"}],
        "loads": [{"type": "uniform", "q": 4.0, "case": "dead"}, {"type": "movement", "support": "jack", "value": -0.02},
                  {"type": "movement", "support": 0, "rotation": 0.004, "case": "dead"},
                  {"type": "movement", "support": 1, "value": 0.004}, {"type": "movement", "support": "splice", "value": -0.002}],
        "analysis": {"steps": 2},
    })  # fmt: skip
    sketch = figure(result, step=0).axes[0]
    said = "\n".join(text.get_text() for text in sketch.texts)
    for words in ("moves \u2191 10 mm live", "turns \u21bb 0.004 rad dead", "moves \u2192 2 mm live", "turns \u21ba 0.001 rad live",
                  "slack 0.004 rad"):  # fmt: skip
        assert words in said
    drawn = sorted(one.get_label() for one in sketch.collections if one.get_label().startswith("moves"))
    assert drawn == ["moves across", "moves along", "moves turn", "moves turn"]
    assert "0 of 1 joint holds" in "\n".join(text.get_text() for text in figure(result).texts)


def test_ground_that_moves_says_so_by_its_name():
    result = gapbeam.solve({
        "units": {"force": "kN", "length": "m"}, "beam": {"spans": [20.0], "EI": 2e4},
        "foundation": [{"k": 5e3, "name": "clay", "to": 10.0}, {"k": 8e3, "from": 10.0}],
        "loads": [{"type": "uniform", "q": 10.0, "case": "dead"},
                  {"type": "movement", "foundation": "clay", "value": [0.0, 0.003], "case": "mine"},
                  {"type": "movement", "foundation": 1, "value": -0.01}],
    })  # fmt: skip
    texts = [text.get_text() for text in figure(result).axes[0].texts]
    assert {"clay, moves 0 mm to \u2193 3 mm mine", "moves \u2191 10 mm live"} <= {*texts}


def test_labels_of_narrow_loads_stand_apart_and_above_the_loads():
    loads = [{"type": "uniform", "from": k, "to": k + 0.5, "q": 5.0 + k, "name": f"bogie {k} of the train"} for k in range(5)]
    loads.append({"type": "uniform", "from": 9.9, "to": 10.0, "q": 5.0, "name": "at the end, with a long name"})
    scene = {"units": {"force": "kN", "length": "m"}, "beam": {"spans": [10.0], "EI": 1e4}, "supports": [{"node": 0}, {"node": 1}]}
    made = figure(gapbeam.solve(scene | {"loads": loads}))
    made.draw_without_rendering()
    shown = [text.get_window_extent() for text in made.axes[0].texts if "kN/m" in text.get_text()]
    assert len(shown) == 6
    assert not [(a, b) for k, a in enumerate(shown) for b in shown[:k] if a.shrunk(1, 0.7).overlaps(b.shrunk(1, 0.7))]
    assert all(box.x0 >= 0.0 and box.x1 <= made.bbox.x1 for box in shown)
    (blocks,) = (one for one in made.axes[0].collections if one.get_label() == "distributed down")
    places = [made.axes[0].transData.transform_path(path).get_extents() for path in blocks.get_paths()]
    assert not [box for box in shown for place in places if box.shrunk(1, 0.7).overlaps(place)]


@pytest.mark.parametrize("size", [1e-6, 1e6])
def test_axes_have_no_power_of_ten_apart_from_their_numbers(size):
    scene = {"beam": {"spans": [2.0 * size, 3.0 * size], "EI": size**3}, "supports": [{"node": k} for k in range(3)]}
    made = figure(gapbeam.solve(scene | {"loads": [{"type": "force", "x": size, "F": size}]}))
    made.draw_without_rendering()
    assert {axes.yaxis.get_offset_text().get_text() for axes in made.axes} == {""}
    moment = next(axes for axes in made.axes if axes.get_ylabel().startswith("moment"))
    for tick, text in zip(moment.get_yticks(), moment.get_yticklabels(), strict=True):
        assert float(text.get_text().replace(MINUS, "-")) == pytest.approx(tick, rel=1e-5, abs=0.0)


def test_seats_of_supports_are_seen_beside_the_deflection():
    """One above the beam, whose gap is on the other side of the axis than the deflections."""
    scene = {"beam": {"spans": [10.0], "EI": 1e4}, "loads": [{"type": "force", "x": 4.0, "F": 1.0}],
             "supports": [{"node": 0}, {"node": 1}, {"x": 5.0, "side": "above", "gap": 0.001}]}  # fmt: skip
    panel = figure(gapbeam.solve(scene)).axes[1]
    (mark,) = (one for one in panel.collections if one.get_label() == "contact open")
    low, high = sorted(panel.get_ylim())
    assert low < mark.get_offsets()[0][1] == -0.001 < high


def test_texts_beside_an_upright_beam_are_broken_into_lines():
    scene = {"units": {"force": "kN", "length": "m"}, "beam": {"spans": [4.0], "EI": 5e3, "EA": 1e6, "direction": "down"},
             "supports": [{"node": 0}, {"node": 1, "rotation": "fixed"}, {"node": 1, "direction": "axial"}],
             "loads": [{"type": "force", "x": 2.0, "F": 10.0}, {"type": "axial", "node": 0, "F": 15.0},
                       {"type": "movement", "support": 1, "rotation": 0.002},
                       {"type": "movement", "support": 2, "value": 0.003}]}  # fmt: skip
    made = figure(gapbeam.solve(scene))
    made.draw_without_rendering()
    lines = [text.get_text() for text in made.axes[0].texts if text.get_position()[1] > 3.8]
    assert len(lines) > 2
    assert max(map(len, lines)) <= 40
    assert any(line.startswith("1, 2: ") for line in lines)
    assert made.get_size_inches()[0] < 12.0


def test_headings_of_trains_with_long_names_stand_on_the_page_and_clamps_are_not_in_the_legend():
    trains = [{"name": f"vehicle number {k} of the code", "axles": [[0, 50 + 20 * k], [2 + k, 80]]} for k in range(3)]
    scene = {"beam": {"spans": [12.0], "EI": 1e4}, "supports": [{"node": 0, "rotation": "fixed"}]}
    made = figure(gapbeam.solve(scene | {"trains": trains}))
    made.draw_without_rendering()
    assert all(text.get_window_extent().x1 <= made.bbox.x1 for text in made.texts)
    assert not made.legends


def test_movements_are_written_where_gaps_and_springs_are_summed_up():
    """Two halves of a bearing with gap, spring and settlement each, at three places: too many lines."""
    halves = [{"x": x, "side": side, "gap": 0.0003, "stiffness": 6e5 + 1e4 * k, "settlement": 0.0005, "name": f"{side} {k}"}
              for k, x in enumerate((1.0, 1.4, 1.8)) for side in ("below", "above")]  # fmt: skip
    scene = {"units": {"force": "kN", "length": "m"}, "beam": {"spans": [10.0], "EI": 1e4},
             "supports": [{"node": 0}, {"node": 1}, *halves]}  # fmt: skip
    for moving in ([2], range(6)):
        moves = [{"type": "movement", "support": halves[k]["name"], "value": -0.001 * (k + 1)} for k in moving]
        drawn = figure(gapbeam.solve(scene | {"loads": [{"type": "uniform", "q": 5.0}, *moves]}))
        said = "; ".join(text.get_text() for text in drawn.axes[0].texts)
        assert "springs from" in said
        assert "moves \u2191 3 mm" in said or "6 movements from \u22126 to \u22121 mm" in said


def test_labels_of_large_numbers_stand_apart_from_one_another_and_from_arrows():
    """Widths are measured: digits and signs are wider than letters."""
    supports = [{"node": k, "stiffness": 1.2345e9 + k} for k in range(6)]
    loads = [{"type": "force", "x": 3000, "F": 2.3456789e9}, {"type": "force", "x": 4500, "F": -1.3456789e9}]
    scene = {"units": {"force": "N", "length": "mm"}, "beam": {"spans": 5 * [6000], "EI": 1e18}, "supports": supports}
    made = figure(gapbeam.solve(scene | {"loads": loads}))
    made.draw_without_rendering()
    sketch = made.axes[0]
    boxes = [text.get_window_extent() for text in words(sketch)]
    assert not [(a, b) for k, a in enumerate(boxes) for b in boxes[:k] if a.shrunk(1, 0.7).overlaps(b)]
    first, second = (
        next(text for text in words(sketch) if text.get_text() == said) for said in ("2.3457e+09 N", "1.3457e+09 N")
    )
    assert first.get_window_extent().x1 < sketch.transData.transform((3000, 0))[0]
    assert second.get_window_extent().x0 > sketch.transData.transform((4500, 0))[0]


def test_supports_that_keep_a_set_are_drawn_where_they_are():
    yields = {"node": 1, "side": "above", "law": [[0.004, 60], [0.05, 80]], "unloading": "plastic", "gap": 0.002}
    scene = {"beam": {"spans": [5, 5], "EI": 2e4}, "supports": [{"node": 0}, yields, {"node": 2}],
             "loads": [{"type": "uniform", "q": -20}], "analysis": {"follow": "events", "history": [1.0, 0.3]}}  # fmt: skip
    result = gapbeam.solve(scene)
    panel, step = figure(result).axes[1], result.steps[-1]
    (mark,) = (one for one in panel.collections if one.get_label() == "contact open")
    assert step.set[1] > 0.04
    assert mark.get_offsets()[0][1] == pytest.approx(step.deflection[1] - step.opening[1])


@pytest.mark.parametrize(("stiffer", "said"), [
    (0.0, "31 supports: spring 10000 kN/m each"),
    (1.0, "31 springs from 10000 to 10030 kN/m"),
])  # fmt: skip
def test_upright_beams_with_many_long_names_are_no_wider_and_say_the_rest_at_the_foot(stiffer, said):
    supports = [{"node": k, "name": f"Tieback {k}, northern wall, anchor {k}", "stiffness": 1e4 + stiffer * k} for k in range(31)]
    scene = {"units": {"force": "kN", "length": "m"}, "beam": {"spans": 30 * [0.7], "EI": 5e4, "direction": "down"},
             "supports": supports, "loads": [{"type": "uniform", "q": 60.0}]}  # fmt: skip
    made = figure(gapbeam.solve(scene))
    assert made.get_size_inches()[0] < 11.5
    foot = [text.get_text() for text in made.texts]
    assert said in foot
    assert "beside supports: reaction [kN]" in foot
