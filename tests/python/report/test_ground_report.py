"""What the report, JSON and CSV say of the ground."""

import csv
import io
import json

import gapbeam
import numpy as np
import pytest
import scenes
from gapbeam.cli import main
from gapbeam.report import report_text, to_csv, to_json
from gapbeam.results.data import event_data
from gapbeam.results.paths.ground_path import GroundEvent
from scenes.ground import footing, on_ground, patches, rail, stopped, touching, two, yielding


@pytest.fixture(scope="module")
def on_rail():
    return gapbeam.solve(rail())


@pytest.fixture(scope="module")
def following():
    return gapbeam.solve(stopped(follow="events"))


def section(text, heading):
    """The lines of a section of the report."""
    lines = text.splitlines()
    begin = next(k for k, line in enumerate(lines) if line.startswith(heading))
    end = next((k for k in range(begin, len(lines)) if not lines[k].strip()), len(lines))
    return lines[begin:end]


def test_the_first_lines_tell_contact_and_free_spans(on_rail):
    step = on_rail.steps[-1]
    together = sum(zone.to - zone.from_ for zone in step.contact)
    longest, sag = (max(values) for values in zip(*((span.to - span.from_, span.sag) for span in step.free_spans), strict=True))
    first = [line.rstrip() for line in report_text(on_rail).splitlines()[:3]]
    assert first[1] == f"Contact with the ground over {together:.4g} of 30 m, in 3 zones."
    assert first[2].startswith("2 free spans, the longest from x = ")
    assert first[2].endswith(f": {longest:.4g} m; up to {1e3 * sag:.4g} mm")


def test_zones_and_free_spans_stand_along_the_beam(on_rail):
    step = on_rail.steps[-1]
    rows = [line.split() for line in section(report_text(on_rail), "Contact with the ground at")[4:-1]]
    assert [row[4] for row in rows] == ["in", "free", "in", "free", "in"]
    ends = [(float(row[0]), float(row[1])) for row in rows]
    np.testing.assert_allclose(ends[::2], [(zone.from_, zone.to) for zone in step.contact], atol=1e-3)
    np.testing.assert_allclose(ends[1::2], [(span.from_, span.to) for span in step.free_spans], atol=1e-3)
    np.testing.assert_allclose([float(row[6]) for row in rows[::2]], [zone.resultant for zone in step.contact], rtol=1e-3)
    np.testing.assert_allclose([float(row[5]) for row in rows[1::2]], [1e3 * span.sag for span in step.free_spans], rtol=1e-3)


def test_a_touch_is_told():
    result = gapbeam.solve(touching())
    text = report_text(result)
    assert text.splitlines()[1].rstrip() == "It only touches the ground at x = 4."
    (row,) = (line.split() for line in section(text, "Contact with the ground at") if "touching" in line)
    assert [*map(float, row[:3]), row[4], float(row[5])] == [4.0, 4.0, 0.0, "touching", 0.0]
    zones = json.loads(to_json(result))["steps"][-1]["contact"]
    assert zones == [{"foundation": 0, "from": 4.0, "to": 4.0, "state": "touching", "resultant": 0.0}]


def test_foundations_carry_the_load(on_rail):
    lines = section(report_text(on_rail), "Foundations at load factor 1")
    assert [line.rstrip() for line in lines[-2:]] == ["Sum of reactions  2.03 kN", "Sum of loads      2.03 kN"]
    assert lines[-3].split()[:6] == ["0", "0", "30", "below", "4", "0"]


def test_what_is_left_out(on_rail):
    left_out = " ".join(report_text(on_rail, verbose=True).partition("left out")[2].partition("(")[0].split())
    assert left_out == "axial forces, shear flexibility, hinges, rotational restraints"
    assert "foundation" not in on_rail.system.left_out
    bilateral = gapbeam.solve(on_ground([2.0], [{"k": 1.0}], [scenes.uniform(1.0)]))
    assert "iteration" in bilateral.system.left_out


def test_ends_of_zones_are_nodes(on_rail):
    zones = on_rail.steps[-1].contact
    nodes = {0.0, 15.0, 30.0} | {end for zone in zones for end in (zone.from_, zone.to)}
    assert len(nodes) == 7
    assert (on_rail.system.nodes, on_rail.system.unknowns) == (7, 14)
    assert on_rail.to_dict()["system"]["unknowns"] == 14


def test_two_foundations():
    result = gapbeam.solve(two())
    text = report_text(result)
    assert "2: 1 two-way, 1 one-sided from below, 1 with a gap" in report_text(result, verbose=True)
    assert "50 to 500  0 to 50" in text
    rows = [line.split() for line in section(text, "Contact with the ground at")[4:-1]]
    assert [row[0] for row in rows] == ["0", "1", "1", "1", "1"]
    assert [row[5] for row in rows] == ["two-way", "in", "free", "in", "free"]
    assert max(map(len, text.splitlines())) <= 80


def test_bilateral_ground_needs_no_table_of_contact():
    result = gapbeam.solve(on_ground([2.0], [{"k": 1.0}], [scenes.uniform(1.0)]))
    text = report_text(result)
    assert "contact in" not in text
    assert "Contact" not in text
    assert "Sum of reactions  2 kN\n" in "\n".join(map(str.rstrip, text.splitlines()))


def test_ground_that_nothing_touches():
    ground = [{"k": 1.0, "side": "below", "gap": 1.0}]
    result = gapbeam.solve(on_ground([2.0], ground, [scenes.uniform(1.0)], [scenes.at(0), scenes.at(1)], EI=100.0))
    lines = report_text(result).splitlines()
    assert lines[1].rstrip() == "No contact with the ground."
    assert lines[2].startswith("1 free span, from x = 0 to 2: 2 m long, up to 1")


def test_branches_of_a_law():
    text = report_text(gapbeam.solve(yielding()))
    rows = [line.split() for line in section(text, "Contact with the ground at")[4:-1]]
    assert [" ".join(row[4:6]) for row in rows if row[4] == "segment"] == ["segment 1", "segment 2", "segment 1"]
    assert "Contact with the ground over" in text


def test_a_long_list_is_cut_and_summed_up():
    result = gapbeam.solve(patches(30))
    lines = section(report_text(result), "Contact with the ground at")
    closed = [line for line in lines if "in contact" in line]
    rows = len(result.steps[-1].contact) + len(result.steps[-1].free_spans)
    assert rows > 24
    assert len(closed) <= 24
    assert any(line.startswith(f"{rows - 24} rows in the middle are left out") for line in lines)
    heaviest = max(result.steps[-1].contact, key=lambda zone: zone.resultant)
    summary = " ".join(" ".join(lines[-4:]).split())
    assert f"{len(result.steps[-1].contact)} contact zones, together" in summary
    assert f"the largest resultant {heaviest.resultant:.4g} kN from x = {heaviest.from_:.4g} to {heaviest.to:.4g}." in summary


def test_contact_over_the_load():
    result = gapbeam.solve(footing(3))
    rows = [line.split() for line in section(report_text(result), "Contact with the ground over the load")[4:]]
    assert len(rows) == 3
    for row, step in zip(rows, result.steps, strict=True):
        (zone,) = step.contact
        assert float(row[0]) == pytest.approx(step.factor, abs=1e-4)
        assert float(row[1]) == pytest.approx(zone.to - zone.from_, abs=1e-3)
        assert float(row[2]) == pytest.approx(72.0 + 300.0 * step.factor, abs=1e-2)
        assert row[4] == f"{zone.from_:.4g}-{zone.to:.4g}"


def test_events_name_supports_and_foundations(following):
    rows = [line.split(maxsplit=1) for line in section(report_text(following), "Events")[3:]]
    words = {"opens": "lifts off", "closes": "comes into contact", "zone splits": "a contact zone splits",
             "zone appears": "a contact zone appears", "end leaves": "contact leaves the end",
             "end reaches": "contact reaches the end"}  # fmt: skip
    named = [
        f"ground: {words[e.event]} at x = {e.x:.5g}" if e.support is None
        else f"support {e.support} (x = {e.x:.5g}) {words[e.event]}"
        for e in following.events
    ]
    assert any(name.startswith("support 1 ") for name in named)
    assert any(name.startswith("ground: ") for name in named)
    assert [row[1].rstrip() for row in rows] == named


def test_a_zone_vanishes_where_it_was_last():
    loads = [scenes.force(1.0, 30.0, case="dead"), scenes.uniform(-20.0)]
    ground = [{"k": 50.0, "side": "below", "gap": 0.01}]
    supports = [scenes.at(0), scenes.at(1)]
    result = gapbeam.solve(on_ground([3.0], ground, loads, supports, EI=100.0, analysis={"follow": "events"}))
    (event,) = (event for event in result.events if event.event == "zone vanishes")
    (zone,) = result.state(float(np.nextafter(event.factor, 0.0))).contact
    assert zone.from_ - 1e-12 <= event.x <= zone.to + 1e-12
    assert zone.to - zone.from_ < 1e-5
    assert [zone.state for zone in result.state(event.factor).contact] == ["touching"]


def test_json_has_either_support_or_foundation(following):
    data = json.loads(to_json(following))
    assert data["events"] == [event_data(event, following.scene) for event in following.events]
    zones = [event for event in data["events"] if "foundation" in event]
    supports = [event for event in data["events"] if "support" in event]
    assert {tuple(event) for event in zones} == {("factor", "foundation", "x", "event")}
    assert {tuple(event) for event in supports} == {("factor", "support", "x", "event")}
    assert len(zones) + len(supports) == len(data["events"])


def test_json_names_a_branch_beyond_the_first():
    event = GroundEvent(0.5, None, 2, 3.0, "zone appears", 2)
    scene = gapbeam.Scene(beam=gapbeam.Beam([1.0], EI=1.0), foundation=[gapbeam.Foundation(k=1.0)] * 3)
    assert event_data(event, scene) == {"factor": 0.5, "foundation": 2, "x": 3.0, "event": "zone appears", "branch": 2}


def test_json_and_csv_have_the_pressure(on_rail):
    data = json.loads(to_json(on_rail))
    assert data["fields"]["pressure"] == on_rail.fields().pressure.tolist()
    assert [list(zone) for zone in data["steps"][-1]["contact"]] == [["foundation", "from", "to", "state", "resultant"]] * 3
    assert [span["sag"] for span in data["steps"][-1]["free_spans"]] == [span.sag for span in on_rail.steps[-1].free_spans]
    assert list(data["extremes"]["pressure"]) == ["max", "min"]
    header, *rows = csv.reader(io.StringIO(to_csv(on_rail)))
    assert header[-2:] == ["pressure [kN/m]", "curvature [1/m]"]
    for column, name in ((-2, "pressure"), (-1, "curvature")):
        assert [float(row[column]) for row in rows] == data["fields"][name]


def test_fields_bend_where_zones_end(on_rail):
    fields = on_rail.fields()
    ends = {end for zone in on_rail.steps[-1].contact for end in (zone.from_, zone.to)} - {0.0, 30.0}
    assert len(ends) == 4
    assert ends <= set(fields.x.tolist())
    assert np.all(np.diff(fields.x) >= 0.0)
    at_ends = np.isin(fields.x, list(ends))
    np.testing.assert_allclose(fields.pressure[at_ends], 0.0, atol=1e-12)
    np.testing.assert_array_equal(fields.deflection[at_ends], on_rail.at(fields.x[at_ends]).deflection)


def test_check_counts_foundations(tmp_path, capsys):
    path = tmp_path / "rail.json"
    path.write_text(json.dumps(rail()))
    assert main(["check", str(path)]) == 0
    assert capsys.readouterr().out.endswith("0 of them one-sided; 1 foundation, 1 of them one-sided; 2 loads\n")
