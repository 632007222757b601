"""Counts of linear solves: the numbers that the documentation gives must not get worse."""

import pytest
from gapbeam import solve
from gapbeam.study_schemes import gapped_spans, lifted_end, schemes, sprung_base, to_markdown


@pytest.fixture(scope="module")
def rows():
    return {row.problem: row for row in schemes(largest=100)}


def test_paper_beam_takes_three_solves_from_every_start(rows):
    row = rows["P1 paper's beam (+--)"]
    assert (row.block, row.single, row.events) == (3, 3, 0)


def test_small_problems_end_from_every_start_by_both_rules(rows):
    assert all(max(row.block, row.single) <= 8 for row in rows.values() if row.supports <= 4 and row.single)


def test_page_has_a_line_for_every_problem(rows):
    page = to_markdown(list(rows.values()))
    assert all(name in page for name in rows)


@pytest.mark.parametrize(("count", "closed"), [(100, 84), (1000, 847), (10_000, 8489)])
def test_a_front_does_not_move_one_support_a_solve(count, closed):
    step = solve(lifted_end(count)).steps[-1]
    assert step.state.count("closed") == closed
    assert step.solves < 60


def test_scale():
    step = solve(gapped_spans(10_000)).steps[-1]
    assert step.state.count("closed") == 6975
    assert step.solves < 20
    step = solve(sprung_base(10_000)).steps[-1]
    assert step.state.count("closed") == 4059
    assert step.solves < 25
