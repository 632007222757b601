"""The report, JSON and CSV of a result."""

import csv
import io
import json
import math
import re

import gapbeam
import numpy as np
import pytest
import scenes
from gapbeam.report import report_text, to_csv, to_json
from gapbeam.report.contact_history import contact_table, merged
from gapbeam.results.answer import MOST_LIMITS


def rocking(steps=8):
    """Two spans that only lie on their supports, the load on the first one lifts the far end."""
    made = scenes.scene(
        [1.0, 1.0], [scenes.at(node, side="below") for node in range(3)],
        [scenes.uniform(1.0, case="dead"), scenes.uniform(10.0, to=1.0)], analysis={"steps": steps},
    )  # fmt: skip
    return made | {"title": "Rocking", "units": {"force": "kN", "length": "m"}}


def many(spans, steps=1):
    """Many equal spans on one-sided springs under loads that change from span to span."""
    q = np.random.default_rng(7).uniform(-10, 25, spans)
    supports = [scenes.at(0), *(scenes.at(node, side="below", stiffness=1e5) for node in range(1, spans)), scenes.at(spans)]
    loads = [scenes.uniform(float(load), **scenes.stretch(6.0 * i, 6.0 * i + 6.0)) for i, load in enumerate(q)]
    return scenes.scene([6.0] * spans, supports, loads, EI=1e4, analysis={"steps": steps})


@pytest.fixture(scope="module")
def result():
    return gapbeam.solve(rocking())


@pytest.fixture(scope="module", params=[30, 100, 250])
def long_result(request):
    return gapbeam.solve(many(request.param, steps=2))


def numbers(value):
    """All numbers in nested lists and dicts."""
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        return [number for item in value for number in numbers(item)]
    return [value] if isinstance(value, float) else []


def test_json_reads_back_to_the_same_numbers(result):
    data = json.loads(to_json(result))
    assert data == json.loads(json.dumps(result.to_dict()))
    assert data["steps"][-1]["supports"][0]["reaction"] == result.steps[-1].reaction[0]
    assert data["fields"]["moment"] == result.fields().moment.tolist()
    assert list(data)[:3] == ["schema", "title", "units"]
    assert data["schema"] == "gapbeam-result 1"
    assert {"status", "system", "steps", "fields", "extremes"} <= set(data)
    assert all(map(math.isfinite, numbers(data)))


def test_json_holds_one_line_a_support(result):
    lines = to_json(result).splitlines()
    assert sum('"reaction"' in line and '"state"' in line for line in lines) == 8 * 3


def test_csv_is_the_table_of_the_fields(result):
    header, *rows = csv.reader(io.StringIO(to_csv(result, points=10)))
    fields = result.fields(points=10)
    assert header == ["x [m]", "deflection [m]", "rotation [rad]", "moment [kN m]", "shear [kN]", "curvature [1/m]"]
    table = np.array(rows, dtype=float).T
    for name, column in zip(("x", "deflection", "rotation", "moment", "shear", "curvature"), table, strict=True):
        np.testing.assert_array_equal(column, getattr(fields, name))


def test_csv_has_axial_columns_only_with_axial_loads():
    scene = rocking(1)
    scene["beam"]["EA"] = 1e5
    scene["supports"].append({"node": 0, "direction": "axial"})
    scene["loads"].append({"type": "axial", "node": 2, "F": 3.0})
    result = gapbeam.solve(scene)
    header = to_csv(result).partition("\n")[0]
    assert header.endswith("shear [kN],axial_force [kN],axial_displacement [m],curvature [1/m],transverse [kN]")
    text = report_text(result)
    assert "axial force [kN]" in text
    assert "axial forces" not in text.partition("left out")[2].partition("\n\n")[0]


def test_without_unit_labels_there_are_no_brackets():
    assert "[" not in report_text(gapbeam.solve(rocking() | {"units": {}})).replace("[rad]", "")


@pytest.mark.parametrize("width", [80, 100])
def test_no_line_is_longer_than_the_terminal(result, width):
    lines = report_text(result, width).splitlines()
    assert max(map(len, lines)) <= width


def test_long_reports_stay_narrow_and_short(long_result):
    lines = report_text(long_result).splitlines()
    assert max(map(len, lines)) <= 80
    assert len(lines) < 130


def test_numbers_are_not_broken(result):
    lines = report_text(result, 80).splitlines()
    rows = [line.split() for line in lines if re.match(r"\d +\d +below ", line)]
    assert [len(row) for row in rows] == [9] * 3
    assert [float(row[6]) for row in rows] == pytest.approx(result.steps[-1].reaction, abs=1e-5)


def test_long_tables_are_cut_and_say_so(long_result):
    text = report_text(long_result)
    supports = len(long_result.scene.supports)
    if supports > 40:
        assert re.search(r"\d+ supports are left out here", text)
        assert "All are in the output of --json" in " ".join(text.split())
    else:
        assert "left out here" not in text


def test_supports_that_are_left_out_are_counted_in_tables_of_their_own():
    """Restraints of rotations have another table; combinations say what they leave out, too."""
    made = many(59)
    made["supports"][20]["rotation"] = {"slack": 0.001, "stiffness": 5e4}
    told = " ".join(report_text(gapbeam.solve(made)).split())
    shown = len(re.findall(r"(?:^| )\d+ \d+ (?:both|below) ", told.partition("Supports at")[2].partition("Rotations at")[0]))
    assert f" {60 - shown} supports are left out here; " in told
    made["combinations"] = [{"name": "all", "factors": {"live": 1.0}}]
    told = " ".join(report_text(gapbeam.solve(made)).split())
    assert re.search(r"\d+ supports are left out here; (no contact at|all of them stay)", told.partition("Supports, all")[2])


def test_no_support_without_contact_is_cut():
    """Two of a thousand supports beside a heavy load."""
    spans = 1000
    made = scenes.scene([6.0] * spans, [scenes.at(k, side="below") for k in range(spans + 1)],
                        [scenes.uniform(2.0), scenes.force(3003.0, 160.0)], EI=1e4)  # fmt: skip
    result = gapbeam.solve(made)
    assert [one.support for one in result.lifted] == [499, 502]
    text = report_text(result)
    table = text.partition("Supports at")[2].partition("Sum of reactions")[0]
    rows = [line.split()[0] for line in table.splitlines() if "no contact" in line]
    assert rows == ["499", "502"]
    assert "all of them are in contact" in " ".join(text.split())
    assert text.splitlines()[1].startswith("Support 499 (x = 2994) lifts off by")


def test_the_history_shows_every_change(result):
    text = report_text(result).partition("Contact state over")[2]
    assert ["●", "●", "○"] in [line.split()[-3:] for line in text.splitlines()]
    rows = merged(result.history())
    assert [row[2] for row in rows] == [("closed",) * 3, ("closed", "closed", "open")]
    assert rows[0][0] == 0.125
    assert rows[-1][1] == 1.0


def test_the_history_of_hundreds_of_supports_names_the_changes():
    states = ["closed"] * 500
    history = [(0.5, tuple(states))]
    for index in (3, 4, 5, 70):
        states[index] = "open"
    history.append((1.0, tuple(states)))
    headings, rows = contact_table(history, 80)
    assert len(headings) == 4
    assert rows == [["0.5", "500", "0", "start"], ["1", "496", "4", "4 open: 3-5, 70"]]


@pytest.mark.parametrize("supports", [27, 50, 99, 200])
def test_the_history_of_many_supports_has_a_symbol_for_each(supports):
    states = tuple("open" if index % 3 else "closed" for index in range(supports))
    _, rows = contact_table([(1.0, states)], 80)
    symbols = "".join(row[-1].replace(" ", "") for row in rows)
    assert symbols == "".join("○" if state == "open" else "●" for state in states)


@pytest.mark.parametrize("supports", [49, 50, 51])
def test_up_to_fifty_supports_have_a_column_each(supports):
    headings, rows = contact_table([(1.0, ("open",) * supports)], 400)
    each, tens = ["support 0", *(str(index) for index in range(1, supports))], "".join(f"{index:<11}" for index in range(0, 50, 10))
    assert headings == ["load factor", *(each if supports <= 50 else ["from", tens.rstrip()])]
    assert "".join("".join(row) for row in rows).count("○") == supports


@pytest.mark.parametrize(("more", "words"), [(0, None), (1, "... and 1 more limit."), (2, "... and 2 more limits.")])
def test_the_headline_names_five_limits(more, words):
    """Beside each other supports that break one after the other, at one load each."""
    spans = MOST_LIMITS + more
    brittle = [{"type": "brittle", "stiffness": 500.0, "limit": 1.0 + 0.1 * i} for i in range(spans)]
    supports = [scenes.at(2 * i) for i in range(spans + 1)]
    supports += [scenes.at(2 * i + 1, side="below", law=law) for i, law in enumerate(brittle)]
    made = scenes.scene([0.5, 0.5] * spans, supports, [scenes.force(i + 0.5, 10.0) for i in range(spans)], EI=1.0,
                        analysis={"follow": "events", "at_limit": "jump"})  # fmt: skip
    result = gapbeam.solve(made)
    assert len(result.limits) == spans
    lines = report_text(result).splitlines()
    assert sum(line.startswith("Limit load at ") for line in lines) == MOST_LIMITS == 5
    assert [line for line in lines if "more limit" in line] == ([words] if words else [])


@pytest.mark.parametrize("points", [1, 4])
def test_fields_are_the_values_at_their_places(points):
    made = scenes.scene([2.0, 3.0], [scenes.at(0), scenes.at(1), scenes.at(2)],
                        [scenes.uniform(1.0), scenes.force(0.75, 4.0), scenes.force(4.0, 2.0)])  # fmt: skip
    result = gapbeam.solve(made)
    fields = result.fields(points=points)
    assert {0.0, 0.75, 2.0, 4.0, 5.0} <= set(fields.x.tolist())
    assert (fields.x[0], fields.x[-1]) == (0.0, 5.0)
    inside = np.flatnonzero(np.diff(fields.x, prepend=-1.0) * np.diff(fields.x, append=6.0) > 0.0)
    assert np.all(np.diff(fields.x) >= 0.0)
    for name in ("deflection", "moment", "shear"):
        np.testing.assert_allclose(getattr(fields, name)[inside], getattr(result.at(fields.x[inside]), name), atol=1e-13)


def test_a_bilateral_beam_has_no_history():
    scene = scenes.scene([2.0], [scenes.at(0), scenes.at(1)], [scenes.force(1.0, 3.0)])
    text = report_text(gapbeam.solve(scene))
    assert "Contact state" not in text
    assert "opening" not in text


def test_steps_and_residuals(result):
    text = report_text(result, verbose=True).partition("Residuals against run time")[2]
    for words in ("solves", "time", "equilibrium", "compatibility", "complementarity", "0.125"):
        assert words in text


def test_the_signs_of_an_upright_beam_are_those_of_its_picture():
    made = scenes.scene([2.0], [scenes.at(0), scenes.at(1)], [scenes.force(1.0, 3.0)])
    made["beam"]["direction"] = "down"
    text = report_text(gapbeam.solve(made))
    assert "Deflection to the right, moment with tension on the right" in text
    assert "Deflection downward" not in text


def test_where_the_axis_alone_carries(tmp_path):
    """A bar that is heated between two supports: no error bound of bending, one label of its constant force, dT on its page."""
    result = gapbeam.solve({
        "beam": {"spans": [4.0], "EI": 100.0, "EA": 1e3, "alpha": 1e-5}, "loads": [{"type": "temperature", "dT": 30.0}],
        "supports": [{"node": 0}, {"node": 1}, {"node": 0, "direction": "axial"}, {"node": 1, "direction": "axial"}],
    })  # fmt: skip
    assert "Error bound" not in report_text(result)
    texts = [text.get_text() for axes in result.plot().axes for text in axes.texts]
    assert len([text for text in texts if text.endswith("0.3 at 0")]) == 1
    result.to_html(tmp_path / "page.html")
    assert re.search(r'"type": ?"temperature".*"changes": ?{"dT": ?30.0}', (tmp_path / "page.html").read_text())


def test_tables_that_are_too_wide_are_divided_and_break_no_word():
    """Eleven columns: reaction, couple, deflection, opening, friction and slip beside long names."""
    law = {"law": [[0.01, 40.0], [0.05, 60.0]], "unloading": "plastic"}
    result = gapbeam.solve({
        "units": {"force": "kN", "length": "m"}, "beam": {"spans": [6.0, 6.0], "EI": 1e4, "EA": 1e6},
        "supports": [{"node": 0, "name": "fixed-point-anchor-block-17", "rotation": 2e3, "friction": 0.3},
                     {"node": 1, "name": "guide shoe with a long name", "side": "below", "gap": 0.001, "friction": 0.2, **law},
                     {"node": 2, "side": "below", "friction": 0.4}],
        "loads": [{"type": "uniform", "q": 12.0}, {"type": "axial", "node": 2, "F": 1.0}], "analysis": {"follow": "events"},
    })  # fmt: skip
    lines = report_text(result, 80).split("\n")
    table = lines[lines.index("Supports at load factor 1") + 1 :]
    table = table[: next(k for k, line in enumerate(table) if line.startswith("Sum of reactions"))]
    assert sum(line.startswith("0 fixed-point-anchor-block-17 ") for line in table) == 2
    heads = " ".join(table).split()
    assert {"reaction", "couple", "deflection", "friction", "slip"} <= {*heads}
    assert max(map(len, table)) <= 80


def test_long_answers_go_on_below_their_values():
    names = [f"a combination of many loads with a long name {k}" for k in range(2)]
    result = gapbeam.solve({
        "units": {"force": "kN", "length": "m"}, "beam": {"spans": [6.0, 6.0], "EI": 1e4},
        "supports": [{"node": 0}, {"node": 1}, {"node": 2}], "loads": [{"type": "uniform", "q": 12.0}],
        "combinations": [{"name": name, "factors": {"live": 1.0 + k}} for k, name in enumerate(names)],
    })  # fmt: skip
    lines = report_text(result, 80).split("\n")
    first = next(k for k, line in enumerate(lines) if line.startswith("Largest moment"))
    told = [line for line in lines[first : first + 4] if line[:1] in "L "]
    assert max(map(len, told)) <= 80
    assert any(line.startswith(" " * 20) for line in told[1:])


def test_combinations_that_are_followed_say_once_what_is_between():
    """A load that moves a support makes the values depend on the way, which is gone through."""
    result = gapbeam.solve({
        "beam": {"spans": [6.0, 6.0], "EI": 1e4}, "supports": [{"node": 0, "side": "below"}, {"node": 1}, {"node": 2}],
        "loads": [{"type": "uniform", "q": 12.0, "case": "dead"}, {"type": "movement", "support": 1, "value": 0.01}],
        "combinations": [{"name": "moved", "factors": {"dead": 1.0, "live": 1.0}}],
    })  # fmt: skip
    text = result.report()
    assert "Largest values over the loading history" in text
    assert "Not looked for" not in text


@pytest.mark.parametrize("combinations", [[], [{"name": "all", "factors": {"live": 1.0}}]])
def test_sums_that_are_one_number_are_written_alike(combinations):
    """Reactions add up to 10.000499999999999, which alone would be written with another last digit than the load of 10.0005."""
    scene = {"beam": {"spans": [7.3], "EI": 1e4}, "supports": [{"node": 0}, {"node": 1}], "combinations": combinations,
             "loads": [{"type": "force", "x": 3 * 0.91, "F": 10.0005}]}  # fmt: skip
    text = gapbeam.solve(scene).report()
    assert re.search(r"Sum of reactions +10.001 |10.001 +10.001", text)
    assert not re.search(r"Sum of reactions +10 |10.000 +10.001|10 +10.001", text)
