"""Pictures of paths on which the load falls and rises again, and of supports with laws."""

import gapbeam
import numpy as np
import pytest
from gapbeam.plots.branches import JUMP, STABLE, UNSTABLE, Trace
from gapbeam.plots.path import path_figure
from gapbeam.plots.result import figure


def snap_through(at_limit, **analysis):
    """P4 of the reference problems at 8: limit loads 5 and 3.5, landing at 3.25."""
    return gapbeam.solve({
        "beam": {"spans": [2.0], "EI": 1 / 6},
        "supports": [{"node": 0}, {"node": 1}, {"x": 1.0, "law": [[1.0, 4.0], [2.5, 1.0], [3.5, 2.0]]}],
        "loads": [{"type": "force", "x": 1.0, "F": 8.0}],
        "analysis": {"follow": "events", "at_limit": at_limit, **analysis},
    })  # fmt: skip


def to_and_fro(*factors):
    law = {"type": "plastic", "stiffness": 100.0, "limit": 1.0}
    return gapbeam.solve({
        "beam": {"spans": [1.0], "EI": 1.0},
        "supports": [{"node": 0}, {"node": 1}, {"x": 0.5, "side": "below", "law": law, "unloading": "plastic"}],
        "loads": [{"type": "force", "x": 0.5, "F": 4.0}],
        "analysis": {"follow": "events", "history": list(factors)},
    })  # fmt: skip


def lines(axes, name):
    return [(line.get_xdata().tolist(), line.get_ydata().tolist()) for line in axes.lines if line.get_label() == name]


def marks(axes, marker):
    return [(line.get_xdata()[0], line.get_ydata()[0]) for line in axes.lines if line.get_marker() == marker]


def words(picture):
    return "\n".join(text.get_text() for text in picture.texts)


def arrows(axes):
    """Jumps: where they begin and land."""
    found = [t for t in axes.texts if getattr(t, "arrow_patch", None) is not None and t.arrowprops["arrowstyle"] == "->"]
    return [(t.xyann, t.xy) for t in found]


def test_a_path_that_is_followed_goes_back_and_forth():
    picture = path_figure(snap_through("follow"))
    reaction, deflection = picture.axes
    assert deflection.get_ylabel().startswith("deflection")
    stable, unstable = lines(deflection, "support 2"), lines(deflection, "unstable 2")
    assert stable == [([0.0, 0.625, 0.625], pytest.approx([0.0, 1.0, 1.0]))]
    assert unstable == [([0.625, 0.4375], pytest.approx([1.0, 2.5]))]
    assert marks(deflection, "^") == [(0.625, pytest.approx(1.0))]
    assert marks(deflection, "s") == [(0.4375, pytest.approx(2.5))]
    assert "triangles: limit loads; dotted: unstable" in words(picture)
    assert [t.get_text() for t in reaction.texts if "limit" in t.get_text()] == ["limit 0.625"]
    assert reaction.get_xlim() == (0.0, 1.0)


def test_a_jump_is_an_arrow_to_where_it_lands():
    picture = path_figure(snap_through("jump"))
    ((start, stop),) = arrows(picture.axes[1])
    assert start == pytest.approx((0.625, 1.0))
    assert stop == pytest.approx((0.625, 3.25))
    assert "arrows: jumps" in words(picture)
    assert "dotted" not in words(picture)


def test_a_path_that_stops_shows_where_it_would_land():
    result = snap_through("stop")
    picture = path_figure(result)
    deflection = picture.axes[1]
    assert marks(deflection, "D") == [(0.625, pytest.approx(3.25))]
    assert deflection.get_ylim()[1] > 3.25
    assert deflection.get_xlim() == (0.0, 0.625)
    assert "where the load would jump to" in words(picture)
    assert "Limit load: the load cannot grow beyond load factor 0.625, where support 2 softens." in words(picture)
    assert "No equilibrium" not in words(picture)


def test_points_stand_in_the_order_of_the_path():
    trace = Trace(snap_through("follow"))
    assert trace.factors.tolist() == [0.0, 0.625, 0.625, 0.4375, 0.4375, 1.0]
    assert trace.ways == [STABLE, STABLE, UNSTABLE, STABLE, STABLE]
    assert trace.end() == 5
    assert Trace(snap_through("jump")).ways == [STABLE, JUMP, STABLE]
    # Continuous but where it jumps
    deflection = np.array([step.deflection[2] for step in trace.states])
    assert deflection[1:-1:2] == pytest.approx(deflection[2::2], rel=1e-12)


def test_a_history_goes_to_and_fro():
    result = to_and_fro(1.0, 0.0, 1.5, -0.5)
    picture = path_figure(result)
    axes = picture.axes[1]
    assert axes.get_xlim() == (-0.5, 1.5)
    ((factors, values),) = lines(axes, "support 2")
    turns = [b for a, b, c in zip(factors, factors[1:], factors[2:], strict=False) if (b - a) * (c - b) < 0]
    assert turns == []  # every turning point is there twice
    twice = [f for k, f in enumerate(factors[1:], 1) if f == factors[k - 1]]
    assert twice == pytest.approx([0.37, 1.0, 0.63, 0.0, 0.63, 1.0, 1.5, 1.13], rel=1e-15, abs=0.0)
    assert values[-1] == pytest.approx(result.steps[-1].deflection[2])
    assert len(marks(axes, "o")) == 3
    assert len(marks(axes, "s")) == 4
    # The name of a line stands at its value at the largest factor
    names = {t.get_text(): t.get_position()[1] for t in picture.axes[0].texts if t.get_text() in ("0, 1", "2")}
    assert names["0, 1"] > names["2"]  # both ends carry half, so one line is both


def test_dots_are_for_what_is_unstable_only():
    for axes in path_figure(snap_through("follow")).axes:
        for line in axes.lines:
            style = line._unscaled_dash_pattern
            assert (line.get_label() or "").startswith("unstable") or not style[1] or min(style[1]) > 1 or max(style[1]) > 4


def test_supports_with_laws_are_springs():
    result = snap_through("jump")
    picture = figure(result)
    beam = picture.axes[0]
    springs = [c for c in beam.collections if c.get_label() == "springs"]
    assert sorted(c.get_offsets()[0][0] for c in springs) == [1.0, 1.0]  # above and below: it holds both ways
    assert {c.get_label() for c in beam.collections} >= {"branch 3 below", "branch 3 above"}
    assert "load factor 1, 2 two-way, 1 hardening" in words(picture)
    assert [text.get_text() for text in picture.legends[0].get_texts()] == ["two-way", "hardens"]
    assert "(limit load)" in words(figure(snap_through("stop")))


@pytest.mark.parametrize("analysis", [{"follow": "events"}, {"steps": 500}])
def test_smooth_laws_are_drawn_as_curves(analysis):
    result = gapbeam.solve({
        "beam": {"spans": [1.0], "EI": 1.0},
        "supports": [{"node": 0}, {"node": 1}, {"x": 0.5, "law": {"type": "tanh", "stiffness": 100.0, "limit": 1.0}}],
        "loads": [{"type": "force", "x": 0.5, "F": 4.0}],
        "analysis": analysis,
    })  # fmt: skip
    reaction, deflection = path_figure(result).axes
    (factors, forces), (_, w) = (lines(axes, "support 2")[0] for axes in (reaction, deflection))
    assert 90 < len(factors) < 220
    assert forces == pytest.approx(np.tanh(100.0 * np.array(w)), abs=1e-12)


def test_lines_of_laws_without_limits_are_as_always():
    """One more panel's words, and squares at the breakpoints."""
    law = {"type": "hardening", "stiffness": 100.0, "limit": 1.0, "slope": 400.0}
    result = gapbeam.solve({
        "beam": {"spans": [1.0], "EI": 1.0},
        "supports": [{"node": 0}, {"node": 1}, {"x": 0.5, "side": "below", "gap": 0.001, "law": law}],
        "loads": [{"type": "force", "x": 0.5, "F": 4.0}],
        "analysis": {"follow": "events"},
    })  # fmt: skip
    picture = path_figure(result)
    assert picture.axes[1].get_ylabel().startswith("deflection")
    hardens = next(event.factor for event in result.events if event.event == "hardens")
    assert marks(picture.axes[0], "s") == [(hardens, pytest.approx(1.0))]
    assert "squares" in picture.axes[1].get_xlabel()


def test_a_mechanism_is_marked_at_its_end():
    result = gapbeam.solve({
        "beam": {"spans": [1.0], "EI": 1.0},
        "supports": [{"node": 0}, {"node": 1, "side": "below", "law": {"type": "plastic", "stiffness": 100.0, "limit": 1.0}}],
        "loads": [{"type": "force", "x": 0.5, "F": 4.0}],
        "analysis": {"follow": "events"},
    })  # fmt: skip
    picture = path_figure(result)
    assert marks(picture.axes[1], "^") == [(0.5, pytest.approx(0.01))]
    assert "nothing more resists the load beyond load factor 0.5" in words(picture)


def test_a_long_history_is_drawn_without_marks():
    result = to_and_fro(*(sign * (1.0 + k / 400) for k in range(150) for sign in (1.0, -1.0)))
    assert len(result.events) > 300
    picture = path_figure(result)
    assert not marks(picture.axes[1], "s") + marks(picture.axes[1], "o")
    ((factors, _),) = lines(picture.axes[1], "support 2")
    assert len(factors) == 2 * len(result.segments)
