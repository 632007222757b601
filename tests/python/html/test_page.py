"""What stands in a page: the digits of the JSON output, checks by hand, words, and nothing from elsewhere."""

import hashlib
import json
import re
import subprocess
import sys
from pathlib import Path

import gapbeam
import numpy as np
import pytest
from gapbeam.html.hand_check import sums_data
from gapbeam.html.tables import tables_of
from gapbeam.html.three_moments import three_moments_data
from gapbeam.results.event_words import state_in_words

from .pages import EVENTS, LOADS, combined, data_of, fifty, on_ground, scene, see_saw, train, without_seconds

EXAMPLES = Path(__file__).resolve().parents[3] / "examples"


def test_states_have_the_digits_of_the_json_output():
    result = gapbeam.solve(scene())
    given, data = result.to_dict(), data_of(result.to_html())
    (way,) = data["ways"]
    ends = [way["states"][nodes[-1]] for _, _, _, nodes in way["intervals"]]
    assert len(ends) == len(given["steps"]) > 2
    for state, interval, step in zip(ends, way["intervals"], given["steps"], strict=True):
        assert state["factor"] == step["factor"]
        for name in ("reaction", "opening", "deflection"):
            assert state[name] == [one[name] for one in step["supports"]]
        assert [data["words"][int(code, 36)] for code in way["schemes"][interval[2]]] == [one["state"] for one in step["supports"]]
    assert [one["factor"] for one in way["events"]] == [one["factor"] for one in given["events"]]


def test_both_ends_of_every_interval_are_the_states_at_their_load_factors():
    result = gapbeam.solve(scene())
    way = data_of(result.to_html())["ways"][0]
    assert len(way["intervals"]) > 1
    for from_, to, _, nodes in way["intervals"]:
        for factor, k in ((from_, nodes[0]), (to, nodes[-1])):
            assert np.allclose(way["states"][k]["reaction"], result.state(factor).reaction, rtol=0.0, atol=1e-9)


@pytest.mark.parametrize("make", [scene, combined, train, on_ground, see_saw])
def test_the_result_is_that_of_the_json_output(make):
    result = gapbeam.solve(make())
    given, data = without_seconds(json.loads(result.to_json())), data_of(result.to_html())["result"]
    for one in given.get("trains", []):
        assert len(one.pop("events")) == sum(len(way["events"]) for way in data_of(result.to_html())["ways"])
    for key in ("schema", "status", "reason", "motion", "events", "lifted", "extremes", "history_extremes", "system", "trains"):
        assert data.get(key) == given.get(key)
    for name, row in given.get("envelope", {}).get("extremes", {}).items():
        for kind, one in row.items():
            assert data["envelope"]["extremes"][name][kind][:2] == one[:2]
    for one, other in zip(data.get("combinations", []), given.get("combinations", []), strict=True):
        assert one["extremes"] == other["extremes"]


def test_ground_along_the_beam_is_marked():
    """In the stretches that have some, in one at least, and nowhere else."""
    result = gapbeam.solve(EXAMPLES / "pile_load_test.toml")
    assert len(data_of(result.to_html())["along"]) == 36
    made = result.scene.to_dict()
    made["axial_ground"] = [{"from": 2.0, "to": 4.0, "limit": 500.0, "stiffness": 1e4}, {"from": 9.0, "to": 9.1, "stiffness": 1e4}]
    places = data_of(gapbeam.solve(made).to_html())["along"]
    assert [one for one in places if not 2.0 < one < 4.0] == pytest.approx([9.05])
    assert len(places) > 3
    assert data_of(gapbeam.solve(scene()).to_html())["along"] == []


@pytest.mark.parametrize("make", [scene, combined, train, on_ground, see_saw])
def test_pages_are_the_same_when_made_again(make):
    first = gapbeam.solve(make()).to_html()
    assert first == gapbeam.solve(make()).to_html()
    assert not re.search(r"(?:https?:)?//[a-z]", first.partition('id="gapbeam-data"')[0].replace("file://", ""))
    assert "default-src 'none'" in first


def test_fifty_supports_stay_small():
    result = gapbeam.solve(fifty())
    page = result.to_html()
    assert len(page.encode()) < 400_000
    assert (len(result.events) > 10, "stretches between two of them" in page) == (True, False)
    crane = gapbeam.Train(name="crane", axles=[(0.0, 80.0), (2.4, 80.0)], both_directions=True)
    under = gapbeam.solve(scene(beam=result.scene.beam, supports=fifty(gap=0.0).supports, loads=LOADS[:1], trains=[crane]))
    assert len(under.to_html().encode()) < 500_000


@pytest.mark.parametrize("name", ["three_spans", "pipe_rack", "rubber_stops", "crane_runway", "snap_through", "shaft_clearance"])
def test_sums_and_three_moments_close(name):
    result = gapbeam.solve(EXAMPLES / f"{name}.toml")
    step = result.steps[-1]
    sums, three = sums_data(result, step), three_moments_data(result, step)
    assert abs(sums["force"]) <= 1e-12 * sums["sizes"]["force"] > 0.0
    assert abs(sums["moment"]) <= 1e-11 * sums["sizes"]["moment"]
    if name != "shaft_clearance":
        assert abs(three["sides"][0] - three["sides"][1]) <= 1e-9 * three["size"] > 0.0


def test_sums_close_under_trains_combinations_and_on_the_ground():
    result = gapbeam.solve(train())
    state = result.trains["crane"].state(7.0)
    three = three_moments_data(state.result, state)
    assert three["shear"]
    assert abs(three["sides"][0] - three["sides"][1]) <= 1e-9 * three["size"]
    sums = sums_data(state.result, state)
    assert abs(sums["moment"]) <= 1e-11 * sums["sizes"]["moment"]
    one = gapbeam.solve(combined()).combinations["lift"]
    assert abs(sums_data(one, one.steps[-1])["moment"]) <= 1e-11 * sums_data(one, one.steps[-1])["sizes"]["moment"]
    ground = gapbeam.solve(on_ground())
    sums = sums_data(ground, ground.steps[-1])
    assert max(abs(sums["force"]), abs(sums["moment"])) <= 1e-9 * sums["sizes"]["moment"]
    assert three_moments_data(ground, ground.steps[-1]) is None


def test_a_wrong_reaction_does_not_close():
    result = gapbeam.solve(scene())
    step = result.steps[-1]

    class Wrong:
        factor, couple, runs, reaction = step.factor, step.couple, step.runs, step.reaction * np.array([1.0, 1.001, 1.0, 1.0])

    sums = sums_data(result, Wrong)
    assert abs(sums["force"]) > 1e-4 * sums["sizes"]["force"]
    assert "e-04 of the sum" in sums["left"][0]


def test_the_checker_reads_input_hash_signs_bounds_and_what_was_left_out():
    result = gapbeam.solve(scene())
    page, text = result.to_html(), result.scene.to_toml()
    assert hashlib.sha256(text.encode()).hexdigest() in page
    assert f"gapbeam {gapbeam.__version__}" in page
    for field in ("Project", "Author", "Checker", "Date", "Signature"):
        assert f">{field}</label>" in page
    assert "No moment is wrong by more than" in page
    assert "Shear deformation: no GA is given" in page
    assert "Moments are positive sagging" in page
    assert "Σ V = 36 + 160 \N{MINUS SIGN} 6 \N{MINUS SIGN} " in page
    assert "Three-moment equation at support B" in page


def test_zones_on_the_ground_are_those_of_the_state():
    """Zones on different segments of a law are not joined under the name of the first one."""
    result = gapbeam.solve(EXAMPLES / "laterally_loaded_pile.toml")
    (table,) = (one for one in tables_of(result, result.envelope(), []) if one.name == "zones")
    given = [(zone.state, zone.from_, zone.to) for zone in result.steps[-1].contact]
    assert len({state for state, *_ in given}) > 2
    assert [(row[0].text, row[2].value, row[3].value) for row in table.rows] == [(state_in_words(a), *ends) for a, *ends in given]


def test_names_are_no_markup():
    names = ['</script><b id="x">', "<i>&amp;"]
    supports = [gapbeam.Support(node=i, side="below", name=name) for i, name in enumerate(names)]
    beam = gapbeam.Beam(spans=[6.0], EI=1e4)
    given = scene(title="<script>alert(1)</script>", beam=beam, supports=supports, loads=LOADS[:2])
    page = gapbeam.solve(given).to_html()
    assert page.count("<script") == 2
    assert page.count("</script>") == 2
    assert '<b id="x">' not in page
    assert data_of(page)["supports"][0][0]["name"] == names[0]


def test_a_beam_that_cannot_stand_says_why_and_how_it_moves():
    page = gapbeam.solve(see_saw()).to_html()
    way = data_of(page)["ways"][0]
    assert way["motion"] == [[0.0, -1.0], [4.0, 0.0], [6.0, 0.5]]
    assert "tips about the support at x = 4" in way["reason"]
    assert "tips about the support at x = 4" in page.partition("<h2")[2].partition("</section>")[0]


def test_a_load_with_very_many_events_is_drawn_in_parts():
    supports = [gapbeam.Support(node=i, side="below", gap=0.003 * (i % 3), name=f"P{i}") for i in range(200)]
    loads = [gapbeam.ForceLoad(x=3.0 + 6.0 * i, F=40.0 + (37 * i) % 90 if i % 3 else -80.0) for i in range(198)]
    result = gapbeam.solve(scene(beam=gapbeam.Beam(spans=[6.0] * 199, EI=2.4e4), supports=supports, loads=[LOADS[0], *loads]))
    page = result.to_html()
    way = data_of(page)["ways"][0]
    assert "stretches between two of them are not drawn" in page
    assert way["left_out"] + len(way["intervals"]) == len(result.segments)
    assert way["intervals"][-1][1] == 1.0  # the last state is there


def test_many_combinations_are_cut_to_those_that_govern():
    gusts = {f"gust {i}": 1.0 + i for i in range(70)}
    loads = [gapbeam.UniformLoad(q=2.0, case="dead"), *(gapbeam.ForceLoad(x=9.0, F=1.0, case=name) for name in gusts)]
    listed = [gapbeam.Combination(name=name, factors={"dead": 1.0, name: factor}) for name, factor in gusts.items()]
    page = gapbeam.solve(scene(loads=loads, combinations=listed, analysis=gapbeam.Analysis())).to_html()
    ways = data_of(page)["ways"]
    assert len(ways) == 60
    assert {"gust 0", "gust 69"} <= {way["title"] for way in ways}
    assert "10 combinations that do not govern" in page


def test_trains_whose_polynomials_take_too_many_numbers_are_drawn_by_parabolas():
    many = [gapbeam.Support(node=i, side="below", name=f"P{i}") for i in range(41)]
    crane = gapbeam.Train(name="crane", axles=[(1.7 * i, 30.0) for i in range(8)])
    given = scene(beam=gapbeam.Beam(spans=[6.0] * 40, EI=1e4), supports=many, trains=[crane], analysis=gapbeam.Analysis())
    given.loads = [gapbeam.UniformLoad(q=20.0, case="dead")]
    page = gapbeam.solve(given).to_html()
    assert data_of(page)["ways"][0]["over"] == "close positions"
    assert "These are right to" in page


def run(*arguments, **more):
    """Run the command."""
    return subprocess.run([sys.executable, "-m", "gapbeam", *map(str, arguments)], capture_output=True, text=True, **more)


def test_the_command_writes_the_page_with_the_file_as_it_is(tmp_path):
    given, page = EXAMPLES / "three_spans.toml", tmp_path / "sheet.html"
    assert run("run", given, "--quiet", "--html", page).returncode == 0
    text = page.read_text()
    assert hashlib.sha256(given.read_bytes()).hexdigest() in text
    assert "# Three spans on bearings" in text
    assert "three_spans.toml" in text
    done = run("run", "-", "--html", "-", input=given.read_text())
    assert done.stdout.startswith("<!DOCTYPE html>")
    assert run("run", given, "--html", tmp_path / "sheet.pdf").returncode == 2


def test_results_write_the_page(tmp_path):
    result = gapbeam.solve(scene(analysis=EVENTS))
    assert result.to_html(tmp_path / "page.html") == (tmp_path / "page.html").read_text()
    assert result._repr_html_().startswith("<div><strong>Three spans</strong>")


def test_events_of_a_train_that_goes_left_are_listed_as_it_goes():
    result = gapbeam.solve(train())
    right, left = (way for way in data_of(result.to_html())["ways"] if way["of"][2] in ("right", "left"))
    for way, sign in ((right, 1), (left, -1)):
        places = [sign * one["at"] for one in way["events"]]
        assert len(places) > 2
        assert places == sorted(places)


def test_friction_and_slip_have_columns():
    result = gapbeam.solve({
        "units": {"force": "kN", "length": "m"}, "beam": {"spans": [6.0, 6.0], "EI": 1e4, "EA": 1e6},
        "supports": [{"node": 0}, {"node": 0, "direction": "axial"}, {"node": 1, "friction": 0.2}, {"node": 2, "friction": 0.1}],
        "loads": [{"type": "uniform", "q": 12.0, "case": "dead"}, {"type": "axial", "node": 2, "F": 40.0}],
        "analysis": {"follow": "events"},
    })  # fmt: skip
    table = next(one for one in tables_of(result, None, []) if one.name == "supports")
    assert table.head[-2:] == ["friction [kN]", "slip [mm]"]
    way = data_of(result.to_html())["ways"][0]
    step = result.steps[-1]
    last = way["states"][way["intervals"][-1][3][-1]]
    assert (last["friction"], last["slip"]) == (step.friction.tolist(), step.slip.tolist())
    assert step.slip[3] > 0.0


def test_a_beam_that_stands_says_which_end_is_the_top():
    given = {"units": {"force": "kN", "length": "m"}, "beam": {"spans": [4.0], "EI": 1e4, "direction": "down"},
             "supports": [{"node": 0}, {"node": 1}], "loads": [{"type": "force", "x": 1.0, "F": 5.0}]}  # fmt: skip
    result = gapbeam.solve(given)
    page = result.to_html()
    assert data_of(page)["upright"]
    said = ["its top is at the left", "Reactions are positive to the left.", "Deflection to the right", "x goes from the top down"]
    assert [words for words in said if words not in page] == []
    assert "To the left positive; 2 two-way." in result.report()
    given["beam"].pop("direction")
    page = gapbeam.solve(given).to_html()
    assert not data_of(page)["upright"]
    assert "its top is" not in page
