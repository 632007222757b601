"""Errors that the documentation gives under axial forces, and its lines."""

from studies.axial import PAGE, axial, table


def test_gapbeam_keeps_its_digits_where_stability_functions_lose_theirs():
    rows = list(axial(largest=1))
    ours = [row for row in rows if row.program == "gapbeam"]
    others = {(row.problem, row.size): row for row in rows if row.program == "stability functions"}
    assert len(ours) == len(others) == 12
    assert max(max(row.moment, row.rotation) for row in ours) <= 2e-16
    assert others["tension", 1.0].moment <= 1e-14
    assert others["compression", 3.0].rotation <= 1e-13
    assert min(others["tension", 1e-4].rotation, others["compression", 1e-4].rotation, others["tension", 1e3].moment) > 0.1
    assert "| bearings" in PAGE.markdown(table(rows))
