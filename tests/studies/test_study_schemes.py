"""Counts of linear solves: the numbers that the documentation gives must not get worse."""

import pytest
from gapbeam import solve
from gapbeam.studies.meshes import gapped_spans

from studies.fronts import random_front, scaled
from studies.schemes import PAGE, lifted_end, schemes, sprung_base, table


@pytest.fixture(scope="module")
def rows():
    return {row.problem: row for row in schemes(largest=100)}


def test_paper_beam_takes_three_solves_from_every_start(rows):
    row = rows["P1 paper's beam (+--)"]
    assert (row.block, row.single, row.events) == (3, 2, 0)


def test_small_problems_end_from_every_start_by_both_rules(rows):
    assert all(max(row.block, row.single) <= 8 for row in rows.values() if row.supports <= 4 and row.single)


def test_page_has_a_line_for_every_problem(rows):
    page = PAGE.markdown(table(list(rows.values())))
    assert all(name in page for name in rows)


@pytest.mark.parametrize(("count", "closed", "most"), [(100, 84, 20), (1000, 847, 10), (10_000, 8489, 8)])
def test_a_front_does_not_move_one_support_a_solve(count, closed, most):
    step = solve(lifted_end(count)).steps[-1]
    assert step.state.count("closed") == closed
    assert step.solves <= most


@pytest.mark.parametrize("less", [0.001, 0.01, 0.1])
@pytest.mark.parametrize("count", [100, 1000, 10_000])
def test_a_warm_start_takes_a_handful_of_solves(count, less):
    assert warm_solves(lifted_end(count, 1.0 - less), lifted_end(count)) <= 8


@pytest.mark.parametrize("seed", range(12))
def test_random_fronts_of_10_000_supports(seed):
    name, made = random_front(seed, 10_000)
    step = solve(made).steps[-1]
    assert step.solves < 60, name
    if "curved" not in name:  # there contact levels are known to a unit in the last place, which moves reactions by 1e-5
        assert step.certificate["complementarity"] < 1e-9, name
    assert warm_solves(scaled(made, 0.999), made) <= 8, name
    assert warm_solves(scaled(made, 0.99), made) <= 8, name


@pytest.mark.parametrize("seed", range(20))
def test_random_fronts_end_in_the_same_scheme_from_cold_and_warm(seed):
    name, made = random_front(seed, 200)
    cold = solve(made).steps[-1]
    warm = solve(made, start=[state == "closed" for state in solve(scaled(made, 1.3)).steps[-1].state]).steps[-1]
    assert warm.reaction == pytest.approx(cold.reaction, rel=1e-6, abs=1e-9 * abs(cold.reaction).max()), name


def warm_solves(before, made):
    start = [state == "closed" for state in solve(before).steps[-1].state]
    return solve(made, start=start).steps[-1].solves


def test_scale():
    step = solve(gapped_spans(10_000)).steps[-1]
    assert step.state.count("closed") == 6975
    assert step.solves < 20
    step = solve(sprung_base(10_000)).steps[-1]
    assert step.state.count("closed") == 4059
    assert step.solves < 25
