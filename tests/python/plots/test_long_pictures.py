"""Pictures of very long beams: what no eye can part is drawn once, what stands out is drawn."""

import gapbeam
import numpy as np
import pytest
from gapbeam.plots import figure
from gapbeam.plots.save import picture
from gapbeam.plots.thin import APART, MOST_POINTS, MOST_SHAPES, outline, thin
from gapbeam.studies.meshes import gapped_spans
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure

WIDTH = 400.0


def panel():
    """Axes as wide in points as in data, from 0 to 400."""
    axes = Figure(figsize=(WIDTH / 72, 3)).add_axes((0, 0, 1, 1))
    axes.set_xlim(0, WIDTH)
    return axes


@pytest.mark.parametrize("seed", range(5))
def test_an_outline_covers_what_the_curve_covers(seed):
    random = np.random.default_rng(seed)
    x = np.sort(random.uniform(0.0, 7.0, 10**6))
    y = random.normal(size=len(x)) ** 3
    thin_x, thin_y = outline(x, y, WIDTH)
    assert len(thin_x) <= 4 * (WIDTH / APART + 1)
    assert (thin_x[0], thin_y[0], thin_x[-1], thin_y[-1]) == (x[0], y[0], x[-1], y[-1])
    assert np.all(np.diff(thin_x) >= 0)
    column, thin_column = (np.floor((at - x[0]) / (x[-1] - x[0]) * WIDTH / APART) for at in (x, thin_x))
    for extreme in (np.maximum, np.minimum):
        starts = [np.flatnonzero(np.append(True, np.diff(c) > 0)) for c in (column, thin_column)]
        assert np.array_equal(extreme.reduceat(y, starts[0]), extreme.reduceat(thin_y, starts[1]))


def test_a_short_curve_stays_as_it_is():
    x = np.arange(MOST_POINTS, dtype=float)
    assert outline(x, x, WIDTH)[0] is x


@pytest.mark.parametrize("kind", ["symbols", "lines", "areas"])
def test_the_highest_and_the_lowest_stay(kind):
    random = np.random.default_rng(3)
    x, height = random.uniform(0, WIDTH, 50_000), random.exponential(size=50_000) * random.choice([-1, 1], 50_000)
    axes = panel()
    if kind == "symbols":
        shapes = axes.scatter(x, height)
    elif kind == "lines":
        shapes = LineCollection([[(a, 0.0), (a, b)] for a, b in zip(x, height, strict=True)], linewidths=1.0 + np.abs(height))
    else:
        shapes = PolyCollection([[(a, 0.0), (a, b), (a + 0.01, b)] for a, b in zip(x, height, strict=True)])
    axes.add_collection(shapes)
    thin(axes, shapes)
    left = shapes.get_offsets() if kind == "symbols" else np.concatenate([path.vertices for path in shapes.get_paths()])
    count = len(left) if kind == "symbols" else len(shapes.get_paths())
    assert WIDTH / APART < count < 2 * (WIDTH / APART + 2)
    assert left[:, 1].max() == height.max()
    assert left[:, 1].min() == height.min()
    assert len(np.unique(np.round(left[:, 0] / APART))) >= len(np.unique(np.round(x / APART))) - 2
    if kind == "lines":
        widths = [1.0 + np.abs(path.vertices[:, 1]).max() for path in shapes.get_paths()]
        assert shapes.get_linewidths() == pytest.approx(widths)


def test_few_shapes_stay_as_they_are():
    axes = panel()
    shapes = axes.scatter(np.zeros(MOST_SHAPES), np.zeros(MOST_SHAPES))
    thin(axes, shapes)
    assert len(shapes.get_offsets()) == MOST_SHAPES


def test_a_long_beam_makes_a_small_file():
    drawn = figure(gapbeam.solve(gapped_spans(20_000)))
    assert len(picture(drawn, ".svg")) < 4_000_000
    assert sum(len(collection.get_paths()) for collection in drawn.axes[0].collections) < 20_000
