"""Pictures of the path: what is drawn, and that lines can be told apart."""

import gapbeam
import numpy as np
import pytest
from gapbeam.plots.path import MOST_LINES, path_figure, plot_path
from matplotlib.image import imread
from scenes import at, force, scene, uniform


def lifted(spans, **analysis):
    """Bearings that are met and left one after the other as the far end is pulled up."""
    supports = [at(0), *(at(i, side="below", gap=0.002 * (i % 3)) for i in range(1, spans + 1))]
    loads = [uniform(2.0, case="dead"), force(6.0 * spans, -4.2 * spans)]
    return scene([6.0] * spans, supports, loads, EI=1e4, analysis=analysis)


def curves(axes):
    """The line of every support: places, values, style."""
    found = {}
    for line in axes.lines:
        if line.get_label().startswith("support "):
            style = (line.get_color(), line._unscaled_dash_pattern)  # what was asked for, as nothing public tells it
            found[int(line.get_label().split()[1])] = (line.get_xdata(), line.get_ydata(), style, line.get_marker())
    return found


def names(axes):
    return [int(text.get_text()) for text in axes.texts if text.get_text().isdigit()]


def test_one_step_is_drawn(tmp_path):
    """A line from one point to nowhere is not seen; a dot is."""
    result = gapbeam.solve(lifted(3))
    picture = path_figure(result)
    for axes, values in zip(picture.axes, (result.steps[0].reaction, result.steps[0].opening), strict=True):
        drawn = curves(axes)
        assert sorted(drawn) == np.flatnonzero(values).tolist()
        for k, (x, y, _, marker) in drawn.items():
            assert (x.tolist(), y.tolist(), marker) == ([1.0], [values[k]], ".")
        assert axes.get_xlim() == (0.0, 1.0)
    path = tmp_path / "path.png"
    plot_path(result, path)
    image = imread(path)[..., :3].mean(axis=2)
    right, bottom, top = (image.shape[1] * share for share in (0.86, 0.5, 0.1))
    assert (image[int(top) : int(bottom), int(right) : int(1.02 * right)] < 0.3).any()


@pytest.mark.parametrize("analysis", [{"steps": 20}, {"steps": 500}, {"follow": "events"}])
@pytest.mark.parametrize("spans", [3, 11, 40])
def test_every_line_has_a_style_of_its_own_and_a_name(spans, analysis):
    result = gapbeam.solve(lifted(spans, **analysis))
    picture = path_figure(result)
    styles = {}
    for axes in picture.axes:
        drawn = curves(axes)
        assert 0 < len(drawn) <= MOST_LINES
        assert sorted(names(axes)) == sorted(drawn)
        for k, (_, _, style, _) in drawn.items():
            assert styles.setdefault(k, style) == style  # the same in both panels
    assert len({repr(style) for style in styles.values()}) == len(styles)
    picture.draw_without_rendering()
    for axes in picture.axes:
        boxes = [text.get_window_extent() for text in axes.texts]
        assert not any(a.shrunk(1, 0.7).overlaps(b.shrunk(1, 0.7)) for i, a in enumerate(boxes) for b in boxes[:i])
        assert all(box.x1 < picture.bbox.x1 and box.y1 < picture.bbox.y1 for box in boxes)


def test_names_stand_in_the_order_of_the_ends():
    axes = path_figure(gapbeam.solve(lifted(11, follow="events"))).axes[1]
    heights = {int(t.get_text()): t.get_position()[1] for t in axes.texts if t.get_text().isdigit()}
    ends = {k: y[-1] for k, (_, y, _, _) in curves(axes).items()}
    assert sorted(heights, key=heights.get) == sorted(ends, key=lambda k: (ends[k], -k))


def test_what_is_left_out_is_said():
    upper, lower = path_figure(gapbeam.solve(lifted(40, follow="events"))).axes
    assert upper.get_title("right") == f"the {MOST_LINES} largest of 41"
    result = gapbeam.solve(lifted(40, follow="events"))
    largest = max(range(41), key=lambda k: max(step.opening[k] for step in result.steps))
    assert largest in curves(lower)
    assert path_figure(gapbeam.solve(lifted(3))).axes[0].get_title("right") == ""


def test_lines_of_many_steps_have_their_corners_only():
    """Between steps with the same scheme nothing bends: the same line, drawn through a few of its points."""
    result = gapbeam.solve(lifted(11, steps=2000))
    drawn = curves(path_figure(result).axes[0])
    schemes = {states for _, states in result.history()}
    factors = np.array([step.factor for step in result.steps])
    reaction = np.array([step.reaction for step in result.steps])
    for k, (x, y, _, marker) in drawn.items():
        assert len(x) <= 2 * len(schemes) + 2
        assert np.interp(factors, x, y) == pytest.approx(reaction[:, k], abs=1e-9 * np.abs(reaction).max())
        assert marker == "None"


def test_steps_that_are_few_are_dots():
    axes = path_figure(gapbeam.solve(lifted(3, steps=8))).axes[1]
    assert {marker for _, _, _, marker in curves(axes).values()} == {"."}
    assert axes.get_xlabel() == "load factor (dots: load steps)"


def test_events_are_circles():
    result = gapbeam.solve(lifted(3, follow="events"))
    axes = path_figure(result).axes[1]
    circles = [line for line in axes.lines if line.get_marker() == "o"]
    shown = set(curves(axes))
    assert len(circles) == sum(event.support in shown for event in result.events) > 1
    assert "circles" in axes.get_xlabel()
    assert curves(axes)[3][0][0] == 0.0


def test_a_path_that_ends_says_why():
    loads = [uniform(1.0, case="dead", to=1.0), force(2.0, 10.0)]
    made = scene([1.0, 1.0], [at(0, side="below"), at(1, side="below")], loads)
    picture = path_figure(gapbeam.solve({**made, "analysis": {"follow": "events"}}))
    assert "Above load factor 0.05: the beam tips about" in picture.texts[1].get_text()
    assert picture.axes[0].get_xlim() == (0.0, 0.05)
    with pytest.raises(ValueError, match="there is no path to draw: no equilibrium at load factor 1"):
        path_figure(gapbeam.solve(made))


@pytest.mark.parametrize("analysis", [{"follow": "events"}, {"steps": 20}])
def test_joints_are_drawn_where_something_happens_to_them(analysis):
    """A loose splice and a loose clamp: the supports do nothing but carry."""
    result = gapbeam.solve({
        "beam": {"spans": [6.0, 6.0], "EI": 1e4},
        "hinges": [{"x": 4.0, "slack": 0.004, "stiffness": 3e3, "name": "splice"}],
        "supports": [{"node": 0, "rotation": {"slack": 0.001, "stiffness": 5e4}}, {"node": 1}, {"node": 2}],
        "loads": [{"type": "uniform", "q": 12.0}], "analysis": analysis,
    })  # fmt: skip
    reaction, couple, rotation = path_figure(result).axes
    assert "reaction" in reaction.get_ylabel()
    for axes, row in ((couple, result.steps[-1].reaction), (rotation, result.steps[-1].deflection)):
        drawn = curves(axes)
        assert {k: y[-1] for k, (_, y, *_) in drawn.items()} == {k: pytest.approx(row[k]) for k in (3, 4)}
        assert {"splice", "rotation of 0"} <= {text.get_text() for text in axes.texts}
        marks = {float(line.get_xdata()[0]) for line in axes.lines if line.get_marker() == "o" and len(line.get_xdata()) == 1}
        assert marks == {event.factor for event in result.events}
