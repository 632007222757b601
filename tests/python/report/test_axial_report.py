"""What report, JSON, pictures and pages tell of axial forces in bending."""

import json
import math
import re
from pathlib import Path

import gapbeam
import numpy as np
import pytest
from gapbeam.base.errors import EngineError
from gapbeam.html.hand_check import sums_data
from gapbeam.html.page import html_page
from gapbeam.plots.bezier import cells_of
from gapbeam.plots.result import figure
from gapbeam.report import report_text, to_json

EXAMPLES = Path(__file__).resolve().parents[3] / "examples"
UNITS = {"force": "kN", "length": "m"}
EULER = math.pi**2 * 10.0


def column(N, **changes):
    """A column of length 1 with a stop."""
    given = {
        "units": UNITS, "beam": {"spans": [0.5, 0.5], "EI": 10.0, "N": N, "mass": 0.1},
        "supports": [{"node": 0}, {"node": 1, "side": "below", "gap": 0.002}, {"node": 2}],
        "loads": [{"type": "uniform", "q": 1.0}], "analysis": {"buckling": 2, "frequencies": 1},
    }  # fmt: skip
    return gapbeam.solve(given | changes)


def told(result):
    """The report in one line."""
    return " ".join(report_text(result, width=200).split())


def test_report_tells_where_it_acts_and_what_it_changes():
    result = column([-0.5 * EULER, -0.4 * EULER])
    text = told(result)
    assert "N = -49.348 kN (compression) from x = 0 to 0.5; -39.478 kN (compression) from x = 0.5 to 1. It acts in full" in text
    first = gapbeam.solve(gapbeam.replace(result.scene, "beam.N", 0.0))
    sizes = [max(abs(row.value) for row in one.extremes["moment"].values()) for one in (result, first)]
    shown = [f"{size:.5g} kN m" for size in sizes]
    assert f"Largest |moment| {shown[0]}, {sizes[0] / sizes[1]:.3g} times that of first order (N = 0), {shown[1]}." in text
    assert "transverse = shear + N w'" in text
    assert f"Buckling factors: {result.buckling[0]:.6g}, {result.buckling[1]:.6g} times all N" in text
    assert f"Frequencies omega: {result.frequencies[0]:.6g} rad" in text
    assert f"f = omega/2pi: {result.frequencies[0] / (2 * math.pi):.6g} per" in text
    assert "other stable states" not in text


def test_sections_have_forces_of_their_own():
    result = column(20.0, sections=[{"from": 0.25, "to": 0.75, "N": 0.0}])
    assert "N = 20 kN (tension) from x = 0 to 0.25; 0 kN from x = 0.25 to 0.75; 20 kN (tension) from x = 0.75 to 1." in told(result)
    assert "Buckling factors: none" in told(result)


def test_a_string_has_no_first_order():
    hinged = {"spans": [1.0, 1.0], "EI": 10.0, "N": 30.0, "hinges": [0.5]}
    loads = [{"type": "force", "x": 1.0, "F": 1.0}]
    result = gapbeam.solve({"beam": hinged, "supports": [{"node": 0}, {"node": 2}], "loads": loads})
    assert "Without N there is no equilibrium." in told(result)


def test_other_states_are_not_excluded():
    result = column(-2.0 * EULER)
    assert "other stable states are not excluded" in told(result)
    page = html_page(result)
    assert "Modes at the end of the load" in page
    assert "other stable states are not excluded" in page
    data = json.loads(to_json(result))
    assert data["steps"][-1]["unique"] is False
    assert data["buckling"] == list(result.buckling)
    assert data["frequencies"] == list(result.frequencies)
    assert {"transverse"} <= data["fields"].keys() & data["extremes"].keys()
    assert "unique" not in column(-0.5 * EULER).to_dict()["steps"][-1]
    assert not {"buckling", "frequencies"} & column(-0.5 * EULER, analysis={}).to_dict().keys()


@pytest.mark.parametrize("steps", [1, 5])
def test_a_beam_that_buckles(steps):
    beam = {"spans": [2.0, 2.0], "EI": 10.0, "N": -18.0 if steps > 1 else -30.0}
    ground = [{"k": 60.0, "side": "below"}] if steps > 1 else []
    loads = [{"type": "uniform", "q": 1.0, "case": "dead"}, {"type": "force", "x": 2.0, "F": -2.0}]
    supports = [] if ground else [{"node": 0}, {"node": 2}]
    result = gapbeam.solve({"units": UNITS, "beam": beam, "supports": supports, "foundation": ground, "loads": loads,
                            "analysis": {"steps": steps}})  # fmt: skip
    assert result.status == "buckles"
    assert steps == 1 or len(result.steps)
    text = told(result)
    assert text.count("uckles") == 1
    assert "The mode (sign and scale arbitrary):" in text
    assert f"N = {-18 if steps > 1 else -30} kN (compression) all along the beam." in text
    labels = [axes.get_ylabel() for axes in figure(result).axes]
    assert [label for label in labels if label.startswith("buckling mode")]
    json.loads(to_json(result))
    assert "buckling mode" in html_page(result)


def test_combinations_tell_their_modes():
    combinations = [{"name": "wind", "factors": {"live": 1.0}}, {"name": "suction", "factors": {"live": -1.0}}]
    result = column(-0.5 * EULER, combinations=combinations)
    text = told(result)
    for one in result.combinations.values():
        assert f"{one.buckling[0]:.6g}, {one.buckling[1]:.6g} {one.frequencies[0]:.6g}" in text
    for data, one in zip(result.to_dict()["combinations"], result.combinations.values(), strict=True):
        assert data["buckling"] == list(one.buckling)
    pushed = column(-2.0 * EULER, combinations=combinations[:1])
    assert "other stable states are not excluded in wind" in told(pushed)


def test_sums_have_the_moments_of_axial_forces():
    """About the foot of a cantilever of which the axial force changes, and on ground that resists slopes."""
    loads = [{"type": "force", "x": 5.0, "F": 7.0}]
    mast = gapbeam.solve({"units": UNITS, "beam": {"spans": [3.0, 2.0], "EI": 1000.0, "N": [-100.0, -60.0]},
                          "supports": [{"node": 0, "rotation": "fixed"}], "loads": loads})  # fmt: skip
    sag = mast.at([3.0, 5.0]).deflection
    assert -mast.steps[-1].couple[0] == pytest.approx(35.0 + 40.0 * sag[0] + 60.0 * sag[1], rel=1e-13)
    of_reactions, of_loads = [line.split()[-3] for line in report_text(mast).splitlines() if line.startswith("Sum of")]
    assert of_reactions == of_loads == f"{-mast.steps[-1].couple[0]:.5g}"
    slab = gapbeam.solve({"beam": {"spans": [10.0], "EI": 1000.0, "N": -50.0}, "loads": [{"type": "force", "x": 3.0, "F": 7.0}],
                          "foundation": [{"k": 300.0, "shear": 200.0, "from": 2.0, "to": 7.0}]})  # fmt: skip
    for result in (mast, slab):
        found = sums_data(result, result.steps[-1])
        assert abs(found["moment"]) < 1e-12 * found["sizes"]["moment"]


def test_pictures_show_bending_within_a_short_length():
    cable = gapbeam.solve({"beam": {"spans": [30.0, 30.0], "EI": 4.0, "N": 200.0}, "supports": [{"node": k} for k in range(3)],
                           "loads": [{"type": "uniform", "q": 0.1}]})  # fmt: skip
    cells = cells_of(cable, -1, 8)
    x = cells.x[:, :1] + (cells.x[:, 3:] - cells.x[:, :1]) * np.array([[0.25, 0.5, 0.75]])
    t = np.array([0.25, 0.5, 0.75])
    bases = np.array([(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3])
    for name in ("moment", "shear", "deflection"):
        drawn = cells.control_points(name)[:, :, 1] @ bases
        exact = getattr(cable.at(x), name)
        assert np.abs(drawn - exact).max() < 5e-3 * np.ptp(exact)
    assert len(cells.x) < 80


def test_error_bounds_are_those_of_the_state():
    """A beam that is solved stretch by stretch without ground."""
    for N in (-50.0, 50.0):
        mast = gapbeam.solve({"beam": {"spans": [5.0], "EI": 1000.0, "N": N}, "supports": [{"node": 0, "rotation": "fixed"}],
                              "loads": [{"type": "force", "x": 5.0, "F": 7.0}]})  # fmt: skip
        bounds = [value for name, value in mast.steps[-1].certificate.items() if name.startswith("error_bound")]
        assert all(0.0 < bound < 1e-13 for bound in bounds)


def test_modes_that_cannot_be_counted_are_told_once(monkeypatch):
    def lost(*_):
        raise EngineError("modes: stiffnesses of the beam are too far apart to count more than 1; ask for no more")

    monkeypatch.setattr("gapbeam.results.state.modes.values_of_modes", lost)
    result = column(-0.5 * EULER)
    assert told(result).count("odes: stiffnesses of the beam are too far apart") == 1
    data = result.to_dict()
    assert not {"buckling", "frequencies"} & data.keys()
    assert "too far apart" in data["remarks"][-1]
    html_page(result)


def test_the_answer_tells_what_is_along_the_beam():
    """Of a pipe that does not bend that alone; beside bending too; and where there is nothing along, nothing of it."""
    pipe = gapbeam.solve(EXAMPLES / "buried_pipe.toml").report()
    assert re.search(r"\nLargest axial force 1440 kN at x = 5040 \(load factor 0 of leg 1\)\n +-2880 kN at x = 4080\n", pipe)
    assert "\nAxial displacement  691.2 mm at x = 6000; -691.2 mm at x = 0\n" in pipe
    assert "Largest moment" not in pipe
    assert "Largest reaction" not in pipe
    assert re.search(r"Sum of reactions +0 kN +moment about x = 0 +0 kN m +along the beam +0 kN\n", pipe)
    rack = gapbeam.solve(EXAMPLES / "pipe_rack_hot.toml").report()
    assert "\nLargest reaction    120.44 kN at support anchor along\n" in rack
    assert "\nLargest moment " in rack
    assert "\nLargest axial force 15.94 kN at x = 0 " in rack
    assert "xial" not in gapbeam.solve(EXAMPLES / "three_spans.toml").report().partition("\n\n")[0]


def subtitle(result):
    """All words of a picture."""
    return " ".join(text.get_text() for text in figure(result).findobj(lambda one: hasattr(one, "get_text")))


def test_a_shear_of_the_ground_is_no_axial_force():
    ground = {"k": 5e3, "shear": 600.0, "side": "both"}
    loads = [{"type": "force", "x": 2.0, "F": 9.0}]
    made = {"units": UNITS, "beam": {"spans": [4.0], "EI": 10.0}, "foundation": [ground], "loads": loads}
    result = gapbeam.solve(made)
    assert result._beam.has_axial_force
    assert "N = 0" not in told(result)
    assert "N 0 kN" not in subtitle(result)
    assert "under its axial forces" not in result.to_html()
    pulled = gapbeam.solve({**made, "beam": {**made["beam"], "N": 3.0}})
    assert "N = 3 kN (tension) all along the beam" in told(pulled)
    assert "N 3 kN" in subtitle(pulled)


def test_what_is_left_out_beside_an_axial_force_is_what_would_be_along_the_beam():
    page, text = html_page(column(-0.2 * EULER)), " ".join(report_text(column(-0.2 * EULER), verbose=True).split())
    assert "Axial forces and displacements: no load" not in page
    assert "Displacements along the beam: no load and no support acts along it; its axial force N is given." in page
    assert "axial displacements" in text
    assert "left out axial forces" not in text
