"""Pictures: what is in the figure, and that files come out of it."""

import gapbeam
import numpy as np
import pytest
import scenes
from gapbeam.plots import figure, plot
from matplotlib.colors import to_rgba
from matplotlib.image import imread

from .curves import curve


def paper():
    """The paper's beam: clamp; closed from above; open; closed from below."""
    supports = [scenes.at(0, rotation="fixed"), *(scenes.at(i, side=side) for i, side in enumerate(("above", "below", "below"), 1))]
    loads = [scenes.force(2.0, 0.70707), scenes.force(4.0, -4.3597), scenes.force(6.0, 2.1155)]
    return scenes.scene([2.0, 2.0, 2.0], supports, loads, EI=44.5) | {"units": {"force": "tf", "length": "m"}}


def everything():
    """Every kind of support and load."""
    supports = [
        scenes.at(0, rotation=500.0),
        scenes.at(1, side="below", gap=0.002, stiffness=1e5),
        scenes.at(1, side="above", gap=0.002),
        scenes.at(2),
        scenes.at(3, rotation="fixed"),
        scenes.at(0, direction="axial"),
    ]
    loads = [
        scenes.uniform(5.0, case="dead"),
        scenes.linear(0.0, 20.0, **scenes.stretch(4.0, 9.0)),
        scenes.moment(2.0, 10.0),
        scenes.moment(6.0, -10.0),
        scenes.curvature(1e-4, **scenes.stretch(0.0, 4.0)),
        scenes.force(5.0, 25.0),
        scenes.force(7.5, -15.0),
        scenes.uniform(-8.0, **scenes.stretch(9.0, 12.0)),
        {"type": "axial", "x": 5.0, "F": 3.0},
        {"type": "axial", "node": 3, "F": -3.0},
    ]
    return scenes.scene(
        [4.0, 5.0, 6.0], supports, loads, EI=1e4, EA=1e6, hinges=[10.0],
        sections=[{"from": 6.0, "to": 8.0, "EI": 4e4}],
    )  # fmt: skip


def changing():
    """A linear load that changes its sign, beside one that does not; a couple under a force."""
    loads = [scenes.linear(-10.0, 10.0, to=6.0), scenes.linear(-5.0, -15.0, **{"from": 6.0}), scenes.moment(3.0, -50.0)]
    return scenes.scene([6.0, 6.0], [scenes.at(i) for i in range(3)], [*loads, scenes.force(3.0, 50.0)], EI=1e4)


def crowded():
    """Opposite forces and a couple at one place, three supports close together."""
    supports = [
        scenes.at(0), scenes.at(1, side="below"), scenes.at(2, settlement=0.02),
        scenes.at(x=6.2, side="above", gap=0.003), scenes.at(x=6.4, side="below", gap=0.004),
    ]  # fmt: skip
    loads = [
        scenes.force(3.0, 100.0, case="dead"), scenes.force(3.0, -60.0), scenes.moment(3.0, -50.0),
        scenes.uniform(-5.0, **{"from": 6.0}), scenes.linear(-10.0, 10.0, to=6.0), scenes.curvature(1e-3),
        scenes.curvature(-2e-3, to=3.0), scenes.uniform(3.0, case="dead"),
    ]  # fmt: skip
    return scenes.scene([6.0, 6.0], supports, loads, EI=1e4) | {"units": {"force": "kN", "length": "m"}}


def clearances(spans=(100.0, 150.0, 30.0, 200.0, 120.0)):
    """Clearance of another size on both sides of every bearing, two of them close together."""
    supports = []
    for i in range(len(spans)):
        supports += [scenes.at(i, side="below", gap=0.02 * (i + 1)), scenes.at(i, side="above", gap=0.05 * (i + 1))]
    return scenes.scene(list(spans), supports, [scenes.uniform(0.1)], EI=1e9)


def texts(axes):
    return [text.get_text() for text in axes.texts if text.get_text()]


def corners(picture, label):
    """The polygons of the distributed loads in one direction: places and heights of their corners."""
    found = [c for c in picture.axes[0].collections if c.get_label() == f"distributed {label}"]
    return [path.vertices for collection in found for path in collection.get_paths()]


def symbols(picture):
    """Number and face colour of the support symbols in the first panel, by label."""
    return {
        collection.get_label(): (len(collection.get_offsets()), tuple(collection.get_facecolor()[0]))
        for collection in picture.axes[0].collections
        if len(collection.get_facecolor())
    }


def test_closed_symbols_are_filled_and_open_ones_are_not():
    shown = symbols(figure(gapbeam.solve(paper())))
    black, white = to_rgba("black"), to_rgba("white")
    assert shown["closed above"] == (1, black)
    assert shown["closed below"] == (1, black)
    assert shown["open below"] == (1, white)


@pytest.mark.parametrize("spans", [10, 50, 200])
def test_every_support_has_its_symbol(spans):
    q = np.random.default_rng(7).uniform(-10, 25, spans)
    supports = [scenes.at(0), *(scenes.at(i, side="below", stiffness=1e5) for i in range(1, spans)), scenes.at(spans)]
    loads = [scenes.uniform(float(load), **scenes.stretch(6.0 * i, 6.0 * i + 6.0)) for i, load in enumerate(q)]
    result = gapbeam.solve(scenes.scene([6.0] * spans, supports, loads, EI=1e4))
    states = result.steps[-1].state
    shown = symbols(figure(result))
    collections = {c.get_label(): len(c.get_offsets()) for c in figure(result).axes[0].collections}
    assert collections["closed below"] == states.count("closed")
    assert collections["open below"] == states.count("open")
    bilateral = "bilateral" if spans > 60 else "bilateral below"
    assert collections[bilateral] == 2
    if spans <= 60:
        assert shown["open below"][1] == to_rgba("white")


def test_panels_and_their_directions():
    result = gapbeam.solve(paper())
    picture = figure(result)
    labels = [axes.get_ylabel().split()[0] for axes in picture.axes[1:]]
    assert labels == ["deflection", "moment", "shear"]
    assert [axes.yaxis_inverted() for axes in picture.axes[1:]] == [True, True, False]
    assert len({axes.get_xlim() for axes in picture.axes}) == 1
    assert "tension side" in picture.axes[2].get_ylabel()
    x, moment = curve(picture.axes[2])
    assert np.interp(4.0, x, moment) == pytest.approx(result.extremes["moment"]["min"].value)


def test_curves_are_those_of_the_result():
    result = gapbeam.solve(paper())
    x, shear = curve(figure(result).axes[3])
    assert shear.max() == pytest.approx(result.extremes["shear"]["max"].value)
    assert (np.diff(x) == 0.0).any()  # jumps are drawn as jumps


def test_extremes_are_annotated():
    texts = [text.get_text() for axes in figure(gapbeam.solve(paper())).axes[1:] for text in axes.texts]
    assert sum(" at " in text for text in texts) == 6
    assert "\N{MINUS SIGN}3.171 at 4" in texts
    assert len(texts) > 6  # and moments of the other spans


def test_labels_of_loads_and_extremes_do_not_overlap():
    for scene in (paper(), everything(), changing(), crowded(), clearances(), clearances([5.0] * 8)):
        picture = figure(gapbeam.solve(scene))
        picture.draw_without_rendering()
        for axes in picture.axes:
            boxes = [text.get_window_extent() for text in axes.texts if text.get_text()]
            pairs = [(a, b) for i, a in enumerate(boxes) for b in boxes[:i]]
            # Bounding boxes hold some empty space above and below the letters.
            assert not any(a.shrunk(1, 0.7).overlaps(b.shrunk(1, 0.7)) for a, b in pairs)


def test_a_load_that_changes_its_sign_is_drawn_in_both_directions():
    picture = figure(gapbeam.solve(changing()))
    up, down = corners(picture, "up"), corners(picture, "down")
    assert [(part[:, 0].min(), part[:, 0].max()) for part in up] == [(0.0, 3.0), (6.0, 12.0)]
    assert [(part[:, 0].min(), part[:, 0].max()) for part in down] == [(3.0, 6.0)]
    base = down[0][:, 1].min()
    falling, rising = up[0], down[0]
    assert np.ptp(falling[falling[:, 0] == 3.0][:, 1]) == 0.0
    assert np.ptp(rising[rising[:, 0] == 3.0][:, 1]) == 0.0
    assert falling[:, 1].max() == rising[:, 1].max() > base
    assert "\N{MINUS SIGN}10 to 10" in texts(picture.axes[0])


def test_no_load_is_no_block():
    picture = figure(gapbeam.solve(scenes.scene([2.0], [scenes.at(0), scenes.at(1)], [scenes.uniform(0.0)])))
    assert np.ptp(corners(picture, "down")[0][:, 1]) == 0.0


def test_opposite_forces_at_one_place_are_two_arrows_with_signs():
    picture = figure(gapbeam.solve(crowded()))
    picture.draw_without_rendering()
    axes = picture.axes[0]
    lines = next(c for c in axes.collections if c.get_label() == "forces").get_segments()
    points = axes.transData.transform([line[0] for line in lines])[:, 0] * 72 / picture.dpi
    assert abs(points[0] - points[1]) > 6.0
    assert sum(points) / 2 == pytest.approx(axes.transData.transform((3.0, 0.0))[0] * 72 / picture.dpi)
    labels = {text.get_text(): text.get_window_extent() for text in axes.texts}
    assert {"100 kN dead", "60 kN live", "50 kN m live"} <= set(labels)
    middle = axes.transData.transform((3.0, 0.0))[0]
    assert labels["100 kN dead"].x0 < middle < labels["60 kN live"].x1
    assert labels["50 kN m live"].y0 < labels["60 kN live"].y0


@pytest.mark.parametrize("count", [2, 12, 24])
def test_every_load_has_its_label(count):
    loads = [kind(3.0, value) for kind in (scenes.force, scenes.moment) for value in (7.0, -3.0)]
    made = scenes.scene([6.0], [scenes.at(0), scenes.at(1)], (loads * 6)[:count])
    axes = figure(gapbeam.solve(made)).axes[0]
    assert sum(text in ("7", "3") for text in texts(axes)) == count


def test_gaps_are_named_by_their_support():
    shown = texts(figure(gapbeam.solve(clearances())).axes[0])
    for k in range(5):
        names = f"{2 * k} below: gap {0.02 * (k + 1):.4g}\n{2 * k + 1} above: gap {0.05 * (k + 1):.4g}"
        assert shown.count(names) == 1
    shown = texts(figure(gapbeam.solve(crowded())).axes[0])
    assert {"0", "1, 3, 4", "2", "3: gap 3 mm", "4: gap 4 mm"} <= set(shown)


def test_a_gap_that_all_supports_of_a_place_have_needs_no_number():
    supports = [scenes.at(0), scenes.at(1, side="below", gap=0.01), scenes.at(1, side="above", gap=0.01), scenes.at(2)]
    shown = texts(figure(gapbeam.solve(scenes.scene([6.0, 6.0], supports, [scenes.uniform(1.0)]))).axes[0])
    assert shown.count("1, 2") == shown.count("gap 0.01") == 1


@pytest.mark.parametrize("places", [5, 20, 32, 33, 60, 61, 300])
def test_numbers_of_supports_keep_clear_of_one_another(places):
    supports = [scenes.at(i // 2, side=("below", "above")[i % 2], gap=1e-3 * (i % 7)) for i in range(2 * places)]
    picture = figure(gapbeam.solve(scenes.scene([5.0] * (places - 1), supports, [scenes.uniform(5.0)])))
    picture.draw_without_rendering()
    below = [text.get_window_extent() for text in picture.axes[0].texts if text.get_position()[1] < -5.0]
    assert len(below) > 3
    assert not any(a.shrunk(1, 0.7).overlaps(b.shrunk(1, 0.7)) for i, a in enumerate(below) for b in below[:i])
    assert all(box.x0 >= 0.0 and box.x1 <= picture.bbox.x1 for box in below)


def test_everything_is_drawn():
    picture = figure(gapbeam.solve(everything()))
    labels = {artist.get_label() for artist in picture.axes[0].collections}
    assert {"beam", "hinges", "springs", "ground", "clamp", "rotational spring", "axial", "forces", "couples"} <= labels
    assert {"distributed down", "distributed up", "distributed curvature"} <= labels
    assert picture.axes[-1].get_ylabel().startswith("axial force")


def test_an_unloaded_beam_can_be_drawn():
    picture = figure(gapbeam.solve(scenes.scene([2.0], [scenes.at(0), scenes.at(1)])))
    assert len(picture.axes) == 4


def test_a_free_motion_is_drawn_when_there_is_no_equilibrium():
    supports = [scenes.at(1, side="below"), scenes.at(2, side="below")]
    result = gapbeam.solve(scenes.scene([2.0, 4.0, 2.0], supports, [scenes.force(8.0, 2.0)]))
    assert result.status == "no-equilibrium"
    picture = figure(result)
    assert picture.axes[1].get_ylabel().startswith("free motion")
    x, motion = curve(picture.axes[1])
    assert x[0] == 0.0
    assert x[-1] == 8.0
    assert np.abs(motion).max() == 1.0


@pytest.mark.parametrize("suffix", ["png", "pdf", "svg"])
def test_files(tmp_path, suffix):
    path = tmp_path / f"beam.{suffix}"
    plot(gapbeam.solve(everything()), path)
    assert path.stat().st_size > 10_000
    if suffix == "png":
        image = imread(path)
        assert image.shape[1] >= 1400
        assert 0.01 < (image[..., :3].mean(axis=2) < 0.5).mean() < 0.3  # there is ink, and not only ink


def test_figure_leaves_pyplot_alone():
    import sys

    figure(gapbeam.solve(paper()))
    assert "matplotlib.pyplot" not in sys.modules


@pytest.mark.parametrize(("force", "does"), [(5.0, "in contact"), (15.0, "yields"), (30.0, "hardens")])
def test_supports_along_the_beam_with_a_law_are_drawn(force, does):
    law = {"direction": "axial", "node": 0, "law": [[0.005, 10], [0.03, 20], [0.05, 40]]}
    scene = {"beam": {"spans": [8], "EI": 3e4, "EA": 1e5}, "supports": [{"node": 0}, {"node": 1}, law],
             "loads": [{"type": "axial", "x": 8, "F": force}, {"type": "uniform", "q": 1}]}  # fmt: skip
    (legend,) = figure(gapbeam.solve(scene)).legends
    assert does in [text.get_text() for text in legend.get_texts()]
