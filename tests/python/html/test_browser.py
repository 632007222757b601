"""What pages do in Chromium: sliders, events, tables, themes, keys; and that what they draw is what the solver says."""

import itertools
import re
import shutil
import tempfile
import time
from pathlib import Path

import gapbeam
import numpy as np
import pytest

from . import pages
from .pages import combined, on_ground, scene, see_saw, train

webdriver = pytest.importorskip("selenium.webdriver", reason="no selenium on this machine")
from selenium.webdriver.common.action_chains import ActionChains  # noqa: E402
from selenium.webdriver.common.by import By  # noqa: E402
from selenium.webdriver.common.keys import Keys  # noqa: E402

CHROMIUM, DRIVER = shutil.which("chromium"), shutil.which("chromedriver")
OPTIONS = ("headless", "no-sandbox", "disable-gpu", "disable-quic", "no-first-run", "disable-background-networking",
           "disable-component-update", "disable-sync", "disable-dev-shm-usage", "window-size=1100,1400")  # fmt: skip
pytestmark = pytest.mark.skipif(CHROMIUM is None or DRIVER is None, reason="no Chromium on this machine")
VALUES = """
const [k, at, places] = arguments, way = DATA.ways[k];
const interval = way.intervals.find((one) => one.from <= at && at <= one.to), state = new State(way, interval, at);
const fields = ["deflection", "moment", "shear"].map((name) => places.map((x) => state.value(name, x)));
return { fields, reaction: Array.from(state.reaction), opening: Array.from(state.opening), words: state.words };
"""


@pytest.fixture(scope="module")
def browser():
    options = webdriver.ChromeOptions()
    options.binary_location = CHROMIUM
    for option in OPTIONS:
        options.add_argument(f"--{option}")
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        options.add_argument(f"--user-data-dir={folder}")
        one = webdriver.Chrome(options=options, service=webdriver.ChromeService(DRIVER))
        yield one
        one.quit()


@pytest.fixture
def look_at(browser, tmp_path):
    """Open the page of a scene from its file; nothing may be complained about."""

    def opened(given):
        result = gapbeam.solve(given)
        result.to_html(tmp_path / "page.html")
        browser.get((tmp_path / "page.html").as_uri())
        return result

    yield opened
    assert [one["message"] for one in browser.get_log("browser")] == []


def find(browser, selector):
    return browser.find_element(By.CSS_SELECTOR, selector)


def column(browser, name):
    """Numbers of a column of the table of supports, in the order of the scene."""
    return browser.execute_script(
        "const i = Array.from(document.querySelectorAll('#supports th'), (one) => one.dataset.of).indexOf(arguments[0]);"
        "return Array.from(document.querySelectorAll('#supports tbody tr')).sort((a, b) => a.dataset.row - b.dataset.row)"
        ".map((row) => row.cells[i].dataset.value ? Number(row.cells[i].dataset.value) : row.cells[i].textContent)", name
    )  # fmt: skip


def test_the_slider_moves_the_beam_and_opens_its_supports(browser, look_at):
    result = look_at(scene())
    slider, last = find(browser, "#slider"), result.to_dict()["steps"][-1]["supports"]
    assert float(find(browser, "#now").get_attribute("data-value")) == 1.0
    assert column(browser, "reaction") == [one["reaction"] for one in last]
    assert column(browser, "opening") == [one["opening"] for one in last]
    assert find(browser, '#picture [data-support="2"]').get_attribute("class") == "support open"
    slider.send_keys(Keys.HOME)
    first, third = result.state(0.0), find(browser, '#picture [data-support="2"]')
    assert (third.get_attribute("data-state"), third.get_attribute("class")) == (first.state[2], "support closed")
    assert column(browser, "reaction") == pytest.approx(first.reaction.tolist(), abs=1e-12)
    slider.send_keys(Keys.ARROW_RIGHT)
    factor = float(find(browser, "#now").get_attribute("data-value"))
    assert 0.0 < factor < 0.02
    assert column(browser, "reaction") == pytest.approx(result.state(factor).reaction.tolist(), abs=1e-10)
    assert slider.get_attribute("aria-valuetext").startswith("load factor 0.00")


def test_half_arrows_mark_ground_along_the_beam(browser, look_at):
    look_at(Path(__file__).resolve().parents[3] / "examples" / "buried_pipe.toml")
    assert len(browser.find_elements(By.CSS_SELECTOR, "#picture .held")) == 2 * 36


def test_events_are_stops_that_one_clicks(browser, look_at):
    result = look_at(scene())
    steps, events = result.to_dict()["steps"], result.events
    marks = browser.find_elements(By.CSS_SELECTOR, ".mark")
    assert len(marks) == len(events) > 1
    marks[1].click()
    assert float(find(browser, "#now").get_attribute("data-value")) == events[1].factor
    step = next(one for one in steps if one["factor"] == events[1].factor)
    assert column(browser, "reaction") == [one["reaction"] for one in step["supports"]]
    assert "Support D (x = 18) lifts off." in find(browser, "#caption").text
    time.sleep(0.5)
    assert find(browser, "#spoken").get_attribute("textContent") == find(browser, "#caption").text
    browser.find_elements(By.CSS_SELECTOR, "#events [data-jump]")[0].click()
    assert float(find(browser, "#now").get_attribute("data-value")) == events[0].factor
    find(browser, "#next").click()
    assert float(find(browser, "#now").get_attribute("data-value")) == events[1].factor
    find(browser, "#before").send_keys(Keys.ENTER)
    assert float(find(browser, "#now").get_attribute("data-value")) == events[0].factor


def test_tables_are_sorted_by_mouse_and_keys(browser, look_at):
    result = look_at(scene())
    button = find(browser, '#supports th[data-of="reaction"] button')
    names = lambda: [row.text.split()[0] for row in browser.find_elements(By.CSS_SELECTOR, "#supports tbody tr")]  # noqa: E731
    reaction = lambda: [result.reactions[name] for name in names()]  # noqa: E731
    button.click()
    assert reaction() == sorted(reaction())
    assert find(browser, '#supports th[data-of="reaction"]').get_attribute("aria-sort") == "ascending"
    button.send_keys(Keys.ENTER)
    assert reaction() == sorted(reaction(), reverse=True)
    assert find(browser, '#supports th[data-of="reaction"]').get_attribute("aria-sort") == "descending"
    find(browser, '#supports th[data-of="support"] button').send_keys(Keys.SPACE)
    assert names() == list("ABCD")


def test_pointer_and_keys_read_values_along_the_beam(browser, look_at):
    result = look_at(scene())
    read = lambda name: float(find(browser, f'#readout output[data-field="{name}"]').get_attribute("data-value"))  # noqa: E731
    ActionChains(browser).move_to_element_with_offset(find(browser, "#picture"), 120, 40).perform()
    x = read("x")
    assert 9.5 < x < 14.0
    there = result.at(x)
    assert [read(name) for name in ("deflection", "moment", "shear")] == pytest.approx(
        [float(there.deflection), float(there.moment), float(there.shear)], rel=1e-9
    )
    find(browser, "#place").send_keys(Keys.HOME)
    assert read("x") == 0.0
    assert read("shear") == pytest.approx(result.steps[-1].reaction[0], rel=1e-12)
    written = browser.find_elements(By.CSS_SELECTOR, '[data-panel="moment"] .peak')
    peaks = {one.get_attribute("textContent").partition(" ")[0] for one in written}
    extremes = [gapbeam.results.formatting.number(value, 5) for value, _ in result._pairs_of_extremes()["moment"].values()]
    assert peaks == {one.replace("-", "\N{MINUS SIGN}") for one in extremes}


def test_play_goes_on_and_stops(browser, look_at):
    look_at(scene())
    play = find(browser, "#play")
    play.click()
    time.sleep(0.4)
    play.click()
    assert play.get_attribute("aria-pressed") == "false"
    stop = find(browser, "#slider").get_attribute("value")
    assert 0 < int(stop) < 200
    time.sleep(0.2)
    assert find(browser, "#slider").get_attribute("value") == stop


def test_themes(browser, look_at):
    look_at(scene())
    back = lambda: find(browser, "body").value_of_css_property("background-color")  # noqa: E731
    colours = set()
    for _ in range(2):
        find(browser, "#theme").click()
        colours.add(back())
    assert colours == {"rgba(255, 255, 255, 1)", "rgba(20, 24, 29, 1)"}
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    assert back() == "rgba(255, 255, 255, 1)"
    assert not find(browser, "#slider").is_displayed()
    assert find(browser, "#field-checker").is_displayed()
    features = [{"name": "prefers-color-scheme", "value": "dark"}]
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "screen", "features": features})
    browser.refresh()
    assert back() == "rgba(20, 24, 29, 1)"
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "", "features": []})


def test_everything_has_a_name_for_who_listens(browser, look_at):
    look_at(combined())
    unnamed = browser.execute_script(
        "return Array.from(document.querySelectorAll('button, input, select, svg'))"
        ".filter((one) => !(one.getAttribute('aria-label') || one.textContent.trim() || (one.labels && one.labels.length)))"
        ".map((one) => one.outerHTML)"
    )
    ids = browser.execute_script("return Array.from(document.querySelectorAll('[id]'), (one) => one.id)")
    missing = browser.execute_script(
        "return Array.from(document.querySelectorAll('[aria-labelledby]')).filter((one) => !document.getElementById("
        "one.getAttribute('aria-labelledby'))).length"
    )
    assert unnamed == []
    assert len(ids) == len(set(ids))
    assert missing == 0
    assert find(browser, "html").get_attribute("lang") == "en"
    assert "Largest moment" in find(browser, "#picture").get_attribute("aria-label")


def test_combinations_are_chosen_and_the_worst_comes_first(browser, look_at):
    result = look_at(combined())
    chosen = find(browser, "#ways")
    assert browser.execute_script("return document.getElementById('ways').selectedOptions[0].text") == "lift"
    chosen.send_keys("rest")
    assert column(browser, "reaction") == result.combinations["rest"].steps[-1].reaction.tolist()


FAULTS = Path(__file__).resolve().parents[2] / "faults"
MANY_LOADS = {
    "beam": gapbeam.Beam(spans=[6.0, 6.0, 6.0], EI=[1e4, 2e4, 1e4], GA=3e4, hinges=[14.0]),
    "supports": [*pages.SUPPORTS[:3], gapbeam.Support(node=3, rotation=2e3)],
    "loads": [*pages.LOADS, gapbeam.LinearLoad(q=(1.0, 7.0), to=9.0), gapbeam.CurvatureLoad(kappa=1e-3, from_=4.0),
              gapbeam.CurvatureLoad(kappa=(1e-3, -2e-3), from_=5.0),
              gapbeam.MomentLoad(x=7.0, M=30.0)],
}  # fmt: skip


@pytest.mark.parametrize("more", [{}, MANY_LOADS], ids=["few", "many"])
def test_along_a_path_all_that_is_drawn_is_exact(browser, look_at, more):
    result = look_at(scene(**more))
    places = np.linspace(0.1, 17.9, 41)
    ends = [segment.start + 0.37 * (segment.stop - segment.start) for segment in result.segments]
    for factor in ends:
        found = browser.execute_script(VALUES, 0, factor, places.tolist())
        there, step = result.at(places, factor=factor), result.state(factor)
        for row, exact in zip(found["fields"], (there.deflection, there.moment, there.shear), strict=True):
            np.testing.assert_allclose(row, exact, rtol=0, atol=1e-12 * np.abs(exact).max())
        np.testing.assert_allclose(found["reaction"], step.reaction, rtol=0, atol=1e-10)
        assert found["words"] == list(step.state)


def test_a_taper_is_drawn_as_it_bends(browser, look_at):
    """It was drawn with its least stiffness everywhere, and the largest deflection was told by that."""
    result = look_at({
        "beam": {"spans": [6.0, 6.0], "EI": 1e4, "EA": 1e5},
        "supports": [{"node": 0}, {"node": 1, "side": "below", "gap": 0.002}, {"node": 2}, {"node": 0, "direction": "axial"}],
        "sections": [{"to": 6.0, "EI": {"from": 1e4, "to": 8e4, "power": 3}}],
        "analysis": {"follow": "events", "first_order": True},
        "loads": [{"type": "uniform", "q": 10.0}, {"type": "axial", "x": 9.0, "F": 5.0}],
    })  # fmt: skip
    largest = result.extremes["deflection"]["max"]
    assert f"{largest.value:.5g} at {largest.x:.5g}" in {one.text for one in browser.find_elements(By.CSS_SELECTOR, "text")}
    for factor in (0.03, 0.7, 1.0):
        places = np.linspace(0.1, 11.9, 41)
        found = browser.execute_script(VALUES, 0, factor, places.tolist())
        there = result.at(places, factor=factor)
        for row, exact in zip(found["fields"], (there.deflection, there.moment, there.shear), strict=True):
            np.testing.assert_allclose(row, exact, rtol=0, atol=2e-4 * np.abs(exact).max())


def test_temperatures_are_named_as_they_are_given_and_curvatures_with_their_unit(browser, look_at):
    loads = [gapbeam.TemperatureLoad(gradient=-40.0), gapbeam.TemperatureLoad(dT=5.0, gradient=2.0, to=3.0),
             gapbeam.TemperatureLoad(dT=7.0), gapbeam.CurvatureLoad(kappa=2e-4)]  # fmt: skip
    look_at(gapbeam.Scene(units=gapbeam.Units(force="kN", length="m"), loads=loads,
                          beam=gapbeam.Beam(spans=[6.0, 6.0], EI=1e4, alpha=1e-5, depth=0.3),
                          supports=[gapbeam.Support(node=k, side="below" if k else "both") for k in range(3)]))  # fmt: skip
    told = {one.text for one in browser.find_elements(By.CSS_SELECTOR, "text.load")}
    assert told == {"gradient \N{MINUS SIGN}40", "dT 5, gradient 2", "dT 7", "\N{GREEK SMALL LETTER KAPPA} 0.0002 1/m"}


def test_trains_are_drawn_by_their_polynomials(browser, look_at):
    """With the seven digits of single precision; uniform loads, shear, hinges, springs and both directions included."""
    result = look_at(train())
    places = np.linspace(0.05, 17.95, 60)
    for k, direction in enumerate(("right", "left")):
        way = browser.execute_script("return { title: DATA.ways[arguments[0]].title, over: DATA.ways[arguments[0]].over }", k)
        assert way == {"title": f"crane, going {direction}", "over": "positions"}
        course = result.trains["crane"].traversals[k].course
        for position in np.linspace(course.from_ + 0.013, course.to - 0.017, 23):
            found = browser.execute_script(VALUES, k, position, places.tolist())
            state = result.trains["crane"].state(position, direction)
            there = state.fields(places)
            for row, exact in zip(found["fields"], (there.deflection, there.moment, there.shear), strict=True):
                np.testing.assert_allclose(row, exact, rtol=0, atol=3e-5 * np.abs(exact).max())
            np.testing.assert_allclose(found["reaction"], state.reaction, rtol=0, atol=1e-3)
            np.testing.assert_allclose(found["opening"], state.opening, rtol=0, atol=1e-7)


def loose_splice(**more):
    """A splice and a clamp with slack."""
    return {
        "units": {"force": "kN", "length": "m"}, "beam": {"spans": [6.0, 6.0], "EI": 1e4},
        "hinges": [{"x": 4.0, "slack": 0.004, "stiffness": 3e3, "name": "splice"}],
        "supports": [{"node": 0, "rotation": {"slack": 0.001, "stiffness": 5e4}}, {"node": 1}, {"node": 2}], **more,
    }  # fmt: skip


def test_joints_are_drawn_as_joints_under_trains_too(browser, look_at):
    """They are no supports across the beam: no arrow, no force among the reactions, no opening in mm."""
    result = look_at(loose_splice(trains=[{"name": "crane", "axles": [[0.0, 50.0], [2.0, 50.0]]}]))
    for position in (3.7, 8.3, 10.9):
        found = browser.execute_script(VALUES, 0, position, [1.0])
        state = result.trains["crane"].state(position)
        for name, size in (("reaction", 0.5), ("opening", 1e-4)):
            np.testing.assert_allclose(found[name], getattr(state, name), rtol=0, atol=size)
    look_at(loose_splice(loads=[{"type": "uniform", "q": 3.0}]))
    shown = find(browser, "#picture").get_attribute("innerHTML")
    assert shown.count('class="reaction head"') == 3
    assert 'data-support="4" data-state="open"><circle' in shown
    assert "Turning freely: splice." in find(browser, "#caption").text


def test_what_loads_move_is_drawn_with_value_and_unit(browser, look_at):
    """Supports across and along the beam, restraints, and the ground."""
    look_at({
        "units": {"force": "kN", "length": "m"}, "beam": {"spans": [6.0, 6.0], "EI": 1e4, "EA": 1e6},
        "supports": [{"node": 0, "rotation": "fixed"}, {"node": 1, "side": "below"}, {"node": 2},
                     {"node": 2, "direction": "axial"}],
        "loads": [{"type": "uniform", "q": 5.0, "case": "dead"}, {"type": "movement", "support": 1, "value": -0.01},
                  {"type": "movement", "support": 0, "rotation": 0.002}, {"type": "movement", "support": 3, "value": 0.004}],
    })  # fmt: skip
    shown = [one.text for one in browser.find_elements(By.CSS_SELECTOR, "#picture text.load")]
    assert [text.replace("\u2212", "-") for text in shown] == ["5 kN/m", "moves -10 mm", "turns 0.002 rad", "moves 4 mm"]
    look_at({
        "units": {"force": "kN", "length": "m"}, "beam": {"spans": [20.0], "EI": 2e4}, "foundation": [{"k": 5e3}],
        "loads": [{"type": "uniform", "q": 5.0, "case": "dead"}, {"type": "movement", "foundation": 0, "value": [0.0, 0.01]}],
    })  # fmt: skip
    shown = [one.text for one in browser.find_elements(By.CSS_SELECTOR, "#picture text.load")]
    assert shown == ["5 kN/m", "ground moves 0 mm to 10 mm"]


def test_labels_of_near_supports_stand_apart(browser, look_at):
    near = [{"x": 5.0 + 0.05 * k, "side": "below", "gap": 0.001 * k} for k in range(4)]
    look_at({"beam": {"spans": [10.0], "EI": 1e4}, "supports": [{"node": 0}, {"node": 1}, *near],
             "loads": [{"type": "uniform", "q": 5.0}]})  # fmt: skip
    places = browser.execute_script(
        "return Array.from(document.querySelectorAll('#picture text.value'), (one) => one.getBoundingClientRect())"
        ".map((box) => [box.left, box.right]).sort((a, b) => a[0] - b[0])")  # fmt: skip
    assert len(places) == 6
    assert all(after[0] >= before[1] - 3.0 for before, after in itertools.pairwise(places))


def test_on_the_ground_states_are_at_most_a_pixel_apart(browser, look_at):
    result = look_at(on_ground())
    places = np.linspace(0.1, 5.9, 59)
    largest = {name: max(abs(one.value) for one in row.values()) for name, row in result.envelope().extremes.items()}
    for factor in (0.1, 0.44, 0.77, 0.93):
        found, there = browser.execute_script(VALUES, 0, factor, places.tolist())["fields"], result.at(places, factor=factor)
        for row, name in zip(found, ("deflection", "moment", "shear"), strict=True):
            assert np.abs(np.array(row) - getattr(there, name)).max() <= largest[name] / 100.0
    assert "at most a pixel apart" in find(browser, "#moving").text


def test_a_train_without_any_state_says_why(browser, look_at):
    look_at(FAULTS / "B3_neutral_positions.json")
    assert "no equilibrium: the part between the left end and the hinge" in find(browser, "#caption").text


def test_a_beam_that_cannot_stand_is_shown_moving(browser, look_at):
    look_at(see_saw())
    path = find(browser, ".girder.moving").get_attribute("d")
    assert "tips about the support at x = 4" in find(browser, "#caption").text
    find(browser, "#slider").send_keys(Keys.END)
    assert find(browser, ".girder.moving").get_attribute("d") != path


def test_a_support_that_keeps_a_set_is_drawn_where_it_is(browser, look_at):
    """Where it has been pressed to: unloaded the beam is as far above it as the opening says."""
    yields = {"node": 1, "side": "below", "law": [[0.004, 60.0], [0.05, 80.0]], "unloading": "plastic"}
    result = look_at({
        "beam": {"spans": [5.0, 5.0], "EI": 2e4}, "supports": [{"node": 0}, yields, {"node": 2}],
        "loads": [{"type": "uniform", "q": 20.0}], "analysis": {"follow": "events", "history": [1.0, 0.0]},
    })  # fmt: skip
    symbols = [find(browser, f"[data-support='{k}'] .symbol").get_attribute("d") for k in range(2)]
    held, kept = (float(re.match(r"M[\d.]+[ ,]([\d.]+)", drawn)[1]) for drawn in symbols)
    deepest, opening = result.history_extremes["deflection"]["max"].value, result.steps[-1].opening[1]
    assert kept - held == pytest.approx(34 * opening / deepest, abs=0.2)
