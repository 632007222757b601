"""The ground in pictures: what is in the figures."""

from itertools import pairwise

import gapbeam
import numpy as np
import pytest
import scenes
from gapbeam.plots import figure, ground_path, path_figure, plot
from gapbeam.plots.ground import GroundLanes, draw_ground, surface
from gapbeam.scene import read_scene
from matplotlib.figure import Figure
from matplotlib.image import imread
from scenes.ground import footing, on_ground, rail, stopped, touching, two, yielding
from scenes.moving import movement

from .curves import curve

WAVES = [[x, 0.02 + 0.02 * np.sin(x)] for x in np.linspace(0.0, 20.0, 21).tolist()]


@pytest.fixture(scope="module")
def on_rail():
    return gapbeam.solve(rail())


@pytest.fixture(scope="module")
def rail_picture(on_rail):
    return figure(on_rail)


@pytest.fixture(scope="module")
def following():
    return gapbeam.solve(stopped(follow="events"))


def collections(axes, label):
    return [collection for collection in axes.collections if collection.get_label() == label]


def zones(axes, label="contact closed"):
    """Ends of what is drawn thick."""
    (lines,) = collections(axes, label)
    return [(float(line[0, 0]), float(line[-1, 0])) for line in lines.get_segments()]


def line(axes, label):
    (found,) = (line for line in axes.lines if line.get_label() == label)
    return found.get_xydata()


def panel(picture, word):
    (found,) = (axes for axes in picture.axes if axes.get_ylabel().startswith(word))
    return found


def test_zones_of_contact_are_thick(on_rail, rail_picture):
    assert zones(rail_picture.axes[0]) == [(zone.from_, zone.to) for zone in on_rail.steps[-1].contact]
    texts = [text.get_text() for text in rail_picture.texts]
    assert "load factor 1, contact in 3 zones" in texts
    (legend,) = rail_picture.legends
    assert [text.get_text() for text in legend.get_texts()] == ["in contact"]


def test_a_touch_is_marked():
    picture = figure(gapbeam.solve(touching()))
    assert line(picture.axes[0], "contact touching")[:, 0].tolist() == [4.0]
    (legend,) = picture.legends
    assert "touching" in [text.get_text() for text in legend.get_texts()]


def test_pressure_has_a_panel_with_its_extremes(on_rail, rail_picture):
    axes = panel(rail_picture, "pressure [kN/m]")
    assert rail_picture.axes[-1] is axes
    (value, x) = on_rail._pairs_of_extremes()["pressure"]["max"]
    assert [text.get_text() for text in axes.texts] == [f"{value:.4g} at {x:g}"]
    x, drawn = curve(axes)
    np.testing.assert_allclose(drawn, on_rail.at(x).pressure, atol=1e-4 * value)
    assert {end for zone in on_rail.steps[-1].contact for end in (zone.from_, zone.to)} <= set(x.tolist())


def test_no_pressure_without_ground():
    result = gapbeam.solve(scenes.scene([2.0], [scenes.at(0), scenes.at(1)], [scenes.uniform(1.0)]))
    assert len(figure(result).axes) == 4


def test_curves_on_stiff_ground_are_smooth():
    loads, ground = [scenes.force(10.0, 1.0)], [{"k": 4e4}]
    result = gapbeam.solve(on_ground([20.0], ground, loads, EI=1.0))
    x, drawn = curve(panel(figure(result), "moment"))
    near = np.abs(x - 10.0) < 0.1  # a length of (4 EI/k)^(1/4)
    assert near.sum() > 20
    np.testing.assert_allclose(drawn, result.at(x).moment, atol=1e-3 * drawn.max())


def test_the_surface_is_to_scale_beside_the_deflection():
    ground = [{"k": 100.0, "side": "below", "profile": WAVES}, {"k": 100.0, "side": "above", "gap": 0.01}, {"k": 1.0}]
    result = gapbeam.solve(on_ground([20.0], ground, [scenes.uniform(1.0)], EI=100.0))
    axes = panel(figure(result), "deflection")
    np.testing.assert_array_equal(line(axes, "surface 0"), WAVES)
    np.testing.assert_array_equal(line(axes, "surface 1"), [[0.0, -0.01], [20.0, -0.01]])
    assert [found.get_label() for found in axes.lines].count("surface 2") == 0  # bilateral: it goes with the beam
    low, high = sorted(axes.get_ylim())
    assert low < -0.01
    assert high > 0.04


def test_the_surface_and_supports_are_where_loads_have_moved_them():
    ground = [{"k": 100.0, "side": "below", "gap": 0.01, "from": 4.0}, {"k": 50.0, "gap": 0.02}]
    loads = [scenes.uniform(1.0, case="dead"), movement([0.02, 0.04], foundation=0), movement(0.01, foundation=1, case="dead"),
             movement(0.03, support=0)]  # fmt: skip
    supports = [scenes.at(0, side="below"), scenes.at(1)]
    result = gapbeam.solve(on_ground([20.0], ground, loads, supports, EI=100.0, analysis={"steps": 2}))
    for step, factor in enumerate((0.5, 1.0)):
        axes = panel(figure(result, step), "deflection")
        np.testing.assert_allclose(line(axes, "surface 0"), [[4.0, 0.01 + 0.02 * factor], [20.0, 0.01 + 0.04 * factor]])
        both = [np.array(one.get_xydata()) for one in axes.lines if one.get_label() == "surface 1"]
        np.testing.assert_allclose([one[:, 1] for one in both], [[0.03, 0.03], [-0.01, -0.01]])
        (mark,) = [one for one in axes.collections if str(one.get_label()).startswith("contact ")]
        np.testing.assert_allclose(mark.get_offsets(), [[0.0, 0.03 * factor]])


def test_a_profile_is_drawn_in_proportion():
    scene = read_scene(on_ground([20.0], [{"k": 1.0, "side": "below", "profile": WAVES}], []))
    (layer,) = GroundLanes(scene, 450.0).layers
    x, gap = np.transpose(WAVES)
    np.testing.assert_array_equal(layer.x, x)
    np.testing.assert_allclose((layer.y - layer.y.max()) / np.ptp(layer.y), (gap.min() - gap) / np.ptp(gap), atol=1e-12)
    assert layer.rim < layer.y.min() < layer.y.max() < 0.0


def test_a_part_of_a_profile_is_drawn_where_the_foundation_is():
    foundation = {"k": 1.0, "side": "above", "from": 5.25, "to": 30.0, "profile": WAVES}
    scene = read_scene(on_ground([30.0], [foundation], []))
    x, gap = surface(scene, scene.foundation[0])
    assert (x[0], x[1], x[-2], x[-1]) == (5.25, 6.0, 20.0, 30.0)
    assert gap[0] == pytest.approx(0.75 * WAVES[5][1] + 0.25 * WAVES[6][1])
    assert gap[-1] == gap[-2] == WAVES[-1][1]
    (layer,) = GroundLanes(scene, 450.0).layers
    assert layer.rim > layer.y.max() > layer.y.min() > 0.0


def test_a_constant_gap_stands_off_as_those_of_supports():
    ground = {"k": 1.0, "side": "below"}
    far, near = (GroundLanes(read_scene(on_ground([2.0], [ground | {"gap": gap}], [])), 450.0) for gap in (0.1, 0.0))
    np.testing.assert_allclose(near.layers[0].y - far.layers[0].y, 4.0)


def test_foundations_that_overlap_lie_under_one_another():
    first, second = GroundLanes(read_scene(two()), 450.0).layers
    assert first.rim > second.y.max()
    names = [words for *_, words, _ in GroundLanes(read_scene(two()), 450.0).names]
    assert names == ["foundation 0", "foundation 1"]
    apart = [{"k": 1.0, "side": "below", "to": 4.0}, {"k": 1.0, "side": "below", "from": 4.0}]
    first, second = GroundLanes(read_scene(on_ground([10.0], apart, [])), 450.0).layers
    assert first.rim == second.rim


def test_numbers_of_supports_are_below_the_ground(following):
    axes = figure(following).axes[0]
    (number,) = (text for text in axes.texts if text.get_text() == "1")
    assert number.get_position()[1] < GroundLanes(following.scene, 450.0).layers[0].rim


def test_states_of_ground_have_shades_of_their_own():
    axes = figure(gapbeam.solve(yielding())).axes[0]
    assert [len(zones(axes, f"contact branch {branch}")) for branch in (1, 2)] == [2, 1]
    shades = [tuple(collections(axes, f"contact branch {branch}")[0].get_colors()[0]) for branch in (1, 2)]
    assert shades[0] != shades[1]
    axes = figure(gapbeam.solve(two())).axes[0]
    assert zones(axes, "contact bilateral") == [(0.0, 12.0)]


def test_segments_of_a_law_are_in_order():
    """Those that share a colour are named by the first of them, and 10 comes after 2."""
    points = [[k * 1e-3, 10.0 * k - 0.4 * k * k] for k in range(1, 12)]
    result = gapbeam.solve(on_ground([8.0], [{"law": points}], [scenes.force(0.0, 60.0)], EI=500.0))
    words = [text.get_text() for text in figure(result).legends[0].get_texts()]
    assert words == [*(f"segment {k} of the ground's law" for k in range(1, 6)), "segment 6 of the ground's law and beyond"]


def test_many_points_of_a_profile_are_thinned():
    x = np.linspace(0.0, 1e3, 100_000)
    gap = np.where(np.arange(len(x)) == 51_234, 5.0, np.sin(x))
    scene = read_scene(on_ground([1e3], [{"k": 1.0, "side": "below", "profile": np.column_stack((x, gap))}], []))
    lanes = GroundLanes(scene, 450.0)
    axes = Figure().add_subplot()
    draw_ground(axes, lanes, ())
    drawn = line(axes, "surface 0")
    assert len(drawn) < 20_000
    assert drawn[drawn[:, 1].argmin(), 0] == x[51_234]


def test_no_equilibrium_shows_the_ground():
    ground = [{"k": 1.0, "side": "below"}]
    result = gapbeam.solve(on_ground([2.0], ground, [scenes.force(1.0, -1.0)]))
    assert result.status == "no-equilibrium"
    picture = figure(result)
    assert len(picture.axes) == 2
    assert len(collections(picture.axes[0], "ground 0")) == 1


def test_files_come_out(on_rail, tmp_path):
    plot(on_rail, tmp_path / "rail.png")
    assert imread(tmp_path / "rail.png").shape[1] == 1480


def test_path_shows_where_zones_end(following, monkeypatch):
    monkeypatch.setattr(ground_path, "MOST_STATES", 12)
    picture = path_figure(following)
    assert [axes.get_ylabel() for axes in picture.axes] == ["x of contact [m]", "reaction, upward positive [kN]", "opening [mm]"]
    (area,) = (found for found in collections(picture.axes[0], "contact") if found.get_paths())
    for path in area.get_paths():
        (low, from_), (_, to) = path.vertices[:2]
        (zone,) = following.state(low).contact
        assert (from_, to) == (zone.from_, zone.to)
    assert min(path.vertices[:, 0].min() for path in area.get_paths()) == pytest.approx(0.0, abs=1e-9)
    assert max(path.vertices[:, 0].max() for path in area.get_paths()) == 1.0
    marks = [tuple(found.get_xydata()[0]) for found in picture.axes[0].lines if found.get_marker() in ("o", "s")]
    assert marks == [(event.factor, event.x) for event in following.events if event.support is None]
    note = picture.texts[-1].get_text()
    assert "grey: in contact with the ground; squares" in note.replace("\n", " ")
    assert note.startswith("circles: filled, the support closes")


def test_path_of_a_beam_that_hardly_touches_begins_where_it_can_be_settled():
    """A tube in clearances of its baffles: from no load to next to none it is loose."""
    made = {
        "beam": {"spans": [1.2, 1.5, 0.9], "EI": 12.5, "hinges": [2.2]},
        "supports": [{"node": 1, "side": side, "gap": 0.0004} for side in ("below", "above")],
        "foundation": [{"k": 8000.0, "side": "below", "gap": 0.0006}, {"k": 8000.0, "side": "above", "gap": 0.0003}],
        "loads": [{"type": "force", "x": 0.0, "F": 0.02}],
        "analysis": {"follow": "events"},
    }
    result = gapbeam.solve(made)
    (stretch,) = ground_path.states_on_ground(result)
    factors = [step.factor for step in stretch]
    assert factors == sorted(factors)
    assert factors[0] < 0.02
    assert factors[-1] == 1.0
    assert all(len(step.contact) == 3 for step in stretch)
    assert path_figure(result).axes


def test_path_by_load_steps_without_supports():
    result = gapbeam.solve(footing(3))
    upper, lower = path_figure(result).axes
    (lines,) = collections(upper, "contact at load steps")
    drawn = [(segment[0, 0], segment[0, 1], segment[1, 1]) for segment in lines.get_segments()]
    assert drawn == [(step.factor, step.contact[0].from_, step.contact[0].to) for step in result.steps]
    for name, which in (("largest", "max"), ("smallest", "min")):
        largest = [step.extremes["deflection"][which].value for step in result.steps]
        np.testing.assert_allclose(line(lower, name)[:, 1], largest)


def test_up_to_an_event_all_zones_are_drawn():
    """One of them vanished or split at the event, and none of that foundation was drawn before it."""
    clay = {"name": "clay", "k": [2e3, 5e3], "side": "below", "to": 12.0, "profile": [[0.0, 0.0], [6.0, 0.02], [12.0, 0.0]]}
    rock = {"name": "rock", "k": 1e4, "side": "below", "gap": 0.01, "from": 20.0}
    scene = {
        "beam": {"spans": [20.0, 10.0], "EI": 3e4}, "supports": [{"node": 2}], "analysis": {"follow": "events"},
        "foundation": [clay, {"k": 3e3, "from": 12.0, "to": 20.0}, rock],
        "loads": [{"type": "uniform", "q": 4.0, "case": "dead"}, {"type": "movement", "foundation": "clay", "value": [0.02, 0.05]},
                  {"type": "movement", "foundation": "rock", "value": -0.015}, {"type": "movement", "support": 0, "value": 0.02}],
    }  # fmt: skip
    result = gapbeam.solve(scene)
    assert {"zone vanishes", "zone splits"} <= {event.event for event in result.events}
    areas = [path.vertices for found in collections(path_figure(result).axes[0], "contact") for path in found.get_paths()]
    for end in (0.0, 30.0):  # contact at either end goes on from its beginning to the end of the load
        there = sorted((low, high) for (low, a), (_, b), (high, c), (_, d), *_ in areas if end in (a, b) and end in (c, d))
        assert there[-1][1] == 1.0
        assert max(low - high for (_, high), (low, _) in pairwise(there)) < 1e-12
