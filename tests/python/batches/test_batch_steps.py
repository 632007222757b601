"""Load steps in a batch: left out where they change nothing, with the same outcomes."""

import gapbeam
import numpy as np
import pytest
from gapbeam.batches.load_steps import at_once, shares_before
from gapbeam.batches.paths import find_paths, scene_data, with_values


def pipe(**changes):
    """A pipe on racks that cannot pull, with a bracket that holds it both ways."""
    made = {
        "beam": {"spans": [4.0, 4.0, 2.0], "EI": 2e3},
        "supports": [{"node": 0, "side": "below"}, {"node": 1, "side": "below", "gap": 0.002}, {"node": 2, "side": "below"}],
        "loads": [{"type": "uniform", "q": 2.0, "case": "dead"}, {"type": "force", "x": 10.0, "F": 5.0, "case": "tip"},
                  {"type": "force", "x": 2.0, "F": 5.0, "case": "span"}],
        "analysis": {"steps": 50},
    }  # fmt: skip
    return {**made, **changes}


def plain(made):
    return scene_data(gapbeam.read_scene(made))


def paths_of(made, *names):
    return find_paths(gapbeam.read_scene(made), names)


def test_which_steps_are_left():
    assert shares_before(gapbeam.read_scene(pipe())) == [0.02]
    assert shares_before(gapbeam.read_scene(pipe(loads=pipe()["loads"][1:]))) == []
    rigid = pipe(beam={"spans": [4.0, 4.0, 2.0], "EI": [2e3, float("inf"), 2e3]})
    assert len(shares_before(gapbeam.read_scene(rigid))) == 49
    law = pipe()
    law["supports"][1]["law"] = [[0.01, 5.0], [0.02, 6.0]]
    assert len(shares_before(gapbeam.read_scene(law))) == 49


@pytest.mark.parametrize(
    ("changes", "columns", "left"),
    [
        ({}, ["factors.tip"], 50),  # dead loads, and nothing that holds both ways
        ({"loads": pipe()["loads"][1:]}, ["factors.tip"], 1),
        ({"supports": [{"node": 0}, {"node": 1}, {"node": 2, "side": "below"}]}, ["factors.tip"], 1),
        ({"supports": [{"node": 0}, {"node": 1, "stiffness": 5.0}]}, ["supports[1].stiffness"], 50),  # it may be 0
        ({"supports": [{"node": 0}, {"node": 1}]}, ["beam.spans[1]"], 50),
        ({"supports": [{"node": 0}, {"node": 1}], "analysis": {"steps": 50, "follow": "events"}}, ["factors.tip"], 50),
    ],
)
def test_what_is_solved_at_once(changes, columns, left):
    made = pipe(**changes)
    assert at_once(plain(made), paths_of(made, *columns))["analysis"]["steps"] == left


@pytest.mark.parametrize("combined", [False, True])
def test_outcomes_are_those_of_steps(tmp_path, combined):
    """Some cases tip at the full load, some while only a share of it acts, some not."""
    made = pipe(loads=[*pipe()["loads"], {"type": "force", "x": 8.0, "F": 5.0, "case": "hold"}])
    if combined:
        made["combinations"] = [{"name": "all", "factors": {"dead": 1.0, "tip": 1.0, "span": 1.0}}]
        made["supports"][0]["side"] = made["supports"][2]["side"] = "both"
    rng = np.random.default_rng(5)
    ranges = {"factors.tip": (-2.0, 6.0), "factors.span": (-6.0, 3.0), "factors.dead": (-0.2, 1.0)}
    table = {name: rng.uniform(*ends, 40) for name, ends in ranges.items()}
    done = gapbeam.batch(made, table, tmp_path / "out", want=["reaction"]).read()
    paths = paths_of(made, *table)
    outcomes = set()
    for k in range(40):
        alone = gapbeam.solve(with_values(plain(made), paths, [column[k] for column in table.values()]))
        assert done["status"][k] == alone.status
        outcomes.add(alone.status)
        if alone.status == "solved":
            names = [f"reaction.{i}.max" if combined else f"reaction.{i}" for i in range(3)]
            state = (alone.combinations["all"] if combined else alone).steps[-1]
            assert [done[name][k] for name in names] == pytest.approx(state.reaction, rel=1e-11, abs=1e-11)
    assert len(outcomes) == (1 if combined else 2)
