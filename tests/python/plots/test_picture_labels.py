"""Labels of pictures: none covers another one or the axes, and every number is one of the result."""

import re

import gapbeam
import numpy as np
import pytest
from gapbeam.plots import figure
from gapbeam.plots.marks import DIGITS
from gapbeam.plots.save import picture
from gapbeam.results.formatting import number
from gapbeam.studies.meshes import gapped_spans

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
    shown = [text for text in shown if not re.match(r"gap|reaction|bilateral|closed|open below|hardens|spring|\d+ gaps", text)]
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
