"""Random numbers by case, and distributions of results."""

import json
from io import StringIO

import gapbeam
import numpy as np
import pytest
from gapbeam import sample
from gapbeam.batches.quantile import normal_quantile
from gapbeam.cli import main
from gapbeam.report.batch import print_summary
from rich.console import Console
from scipy.special import ndtri

from .test_batch import SCENE, digests

GAPS = {"supports.R-101.gap": sample.normal(0.0, 0.01), 'supports."R 102".gap': sample.uniform(0.0, 0.02),
        "factors.wind": sample.lognormal(1.0, 0.3)}  # fmt: skip


# Draws


def test_a_case_has_its_numbers_whatever_is_drawn_beside_it():
    table = sample.draw(1000, GAPS, seed=3)
    whole = np.array(list(table.columns().values()))
    for first, stop in ((0, 1000), (17, 18), (501, 777), (998, 1000)):
        assert np.array_equal(table.rows(first, stop).columns()[0], whole[:, first:stop])
    fewer = sample.draw(50, {"factors.wind": GAPS["factors.wind"]}, seed=3).columns()
    assert np.array_equal(fewer["factors.wind"], whole[2, :50])
    assert len({table.digest, sample.draw(1000, GAPS, seed=4).digest, sample.draw(999, GAPS, seed=3).digest}) == 3


def test_quantiles_of_the_normal_distribution():
    share = np.concatenate([np.arange(1, 2000) / 2000.0, 10.0 ** -np.linspace(3, 16, 50)])
    assert normal_quantile(share) == pytest.approx(ndtri(share), rel=3e-15, abs=1e-15)


def test_distributions_and_correlation():
    pairs = {("a", "b"): 0.6, ("b", "c"): -0.3}
    columns = {"a": sample.normal(2.0, 0.5), "b": sample.uniform(1.0, 3.0), "c": sample.lognormal(2.0, 0.4)}
    for correlation in (None, pairs):
        a, b, c = sample.draw(40_000, columns, correlation=correlation).columns().values()
        assert (a.mean(), a.std()) == pytest.approx((2.0, 0.5), rel=0.02)
        assert (b.min(), b.mean(), b.max()) == pytest.approx((1.0, 2.0, 3.0), rel=0.01)
        assert (c.mean(), c.std()) == pytest.approx((2.0, 0.4), rel=0.02)
        # Of the normal numbers behind them
        behind = np.corrcoef([a, ndtri((b - 1.0) / 2.0), np.log(c)])
        wanted = (0.6, -0.3, 0.0) if correlation else (0.0, 0.0, 0.0)
        assert (behind[0, 1], behind[1, 2], behind[0, 2]) == pytest.approx(wanted, abs=0.02)


def test_latin_hypercube():
    columns = sample.draw(200, GAPS, method="latin-hypercube", seed=1).columns()
    shares = columns['supports."R 102".gap'] / 0.02
    assert sorted((200 * shares).astype(int)) == list(range(200))


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: sample.normal(0.0, -1.0), "deviation: expected 0 or a positive number, got -1"),
        (lambda: sample.lognormal(0.0, 1.0), "mean: lognormal numbers are positive, so their mean is; got 0"),
        (lambda: sample.uniform(2.0, 1.0), "high: expected a number from 2 on, got 1"),
        (lambda: sample.draw(0, GAPS), "cases: "),
        (lambda: sample.draw(2, {"a": 3.0}), 'columns: expected a distribution for each column by its name, got "a": 3.0'),
        (lambda: sample.draw(2, GAPS, method="sobol"), 'method: expected "random" or "latin-hypercube", got "sobol"'),
        (lambda: sample.draw(2, GAPS, correlation={("factors.wind", "x"): 0.1}), "correlation: expected pairs of columns"),
        (lambda: sample.draw(2, dict.fromkeys("abc", sample.normal(0, 1)),
                             correlation={("a", "b"): 1.0, ("b", "c"): 0.5, ("a", "c"): -0.5}), "correlation: no numbers have all"),
        (lambda: sample.draw(2, dict.fromkeys("abc", sample.normal(0, 1)),
                             correlation={("a", "b"): 0.9, ("b", "c"): 0.9, ("a", "c"): -0.9}), "correlation: no numbers have all"),
    ],
)  # fmt: skip
def test_draws_that_are_refused(call, message):
    with pytest.raises(ValueError, match=message):
        call()


# Summaries


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    """Draws in several files, some cases without equilibrium."""
    columns = {**GAPS, "factors.dead": sample.normal(1.0, 0.7)}
    return gapbeam.batch(SCENE, sample.draw(700, columns), tmp_path_factory.mktemp("draws"), chunk=150)


def test_draws_give_the_same_bytes_as_their_numbers(done, tmp_path):
    table = sample.draw(700, {**GAPS, "factors.dead": sample.normal(1.0, 0.7)})
    gapbeam.batch(SCENE, table.columns(), tmp_path / "out", chunk=150)
    mine, others = digests(done.path), digests(tmp_path / "out")
    assert {name for name in mine if mine[name] != others[name]} == {"_manifest.json"}  # which has the table's hash


def test_counts_and_quantiles_are_exact(done):
    limits = {"moment.max": [5.0, 12.0], "moment.min": -3.0}
    shares = [0.0, 0.001, 0.37, 0.5, 0.999, 1.0]
    summary = done.summary(limits=limits, shares=shares, bins=7)
    assert summary.statuses == done.statuses()
    assert len(summary.statuses) == 2
    for name, one in summary.columns.items():
        values = done.read([name])[name]
        values = values[~np.isnan(values)]
        assert (one.count, one.least, one.largest) == (len(values), values.min(), values.max())
        assert list(one.quantiles.values()) == np.quantile(values, shares, method="inverted_cdf").tolist(), name
        assert (one.mean, one.deviation) == pytest.approx((values.mean(), values.std(ddof=1)), rel=1e-12)
        assert one.counts.sum() == len(values)
        if one.least < one.largest:
            assert one.counts.tolist() == np.histogram(values, one.edges)[0].tolist()
        assert one.above == {limit: int((values > limit).sum()) for limit in np.ravel(limits.get(name, [])).tolist()}


def test_summary_of_the_command(done, tmp_path, capsys):
    options = ["--limit", "reaction.R-101=15", "--json", str(tmp_path / "s.json"), "--plot", str(tmp_path / "s.svg")]
    assert main(["batch", "--summary", str(done.path), *options]) == 0
    printed = capsys.readouterr().out
    above = int((done.read(["reaction.R-101"])["reaction.R-101"] > 15.0).sum())
    assert printed.startswith("700 of 700 cases\n")
    assert f"{above}" in printed.rpartition("Cases above a limit")[2]
    data = json.loads((tmp_path / "s.json").read_text())
    assert data["columns"]["reaction.R-101"]["above"] == {"15.0": above}
    assert "above 15" in (tmp_path / "s.svg").read_text()
    assert "line: median; dashed: limit" in (tmp_path / "s.svg").read_text()
    assert main(["batch", "--summary", str(done.path), "--limit", "reaction.R-11=15"]) == 2
    assert capsys.readouterr().err.endswith('has no column "reaction.R-11"; did you mean "reaction.R-101"?\n')
    assert main(["batch", "--summary", str(tmp_path)]) == 2
    assert "is no folder of a batch" in capsys.readouterr().err
    assert main(["batch", "--plot", "s.svg", "scene.toml", "t.csv", "--out", "x"]) == 2


def test_infinite_numbers_have_no_distribution(tmp_path):
    done = gapbeam.batch(SCENE, {"beam.EI": [1e4, np.inf]}, tmp_path / "out")
    with pytest.raises(gapbeam.SceneError, match=r'column "beam\.EI" holds infinite numbers, which have no distribution'):
        done.summary(limits={"beam.EI": 1.0})


def test_long_names_stay_whole(tmp_path):
    """In a terminal of 80 characters."""
    long = "anchor block of the riser, north"
    scene = {**SCENE, "supports": [{**SCENE["supports"][0], "name": long}, *SCENE["supports"][1:]]}
    done = gapbeam.batch(scene, {"factors.wind": [1.0, 1.0 / 3.0]}, tmp_path / "out")
    console = Console(width=80, file=StringIO())
    print_summary(done.summary(limits={f"reaction.{long}": 12.0}), console)
    lines = console.file.getvalue().splitlines()
    assert sum(line.startswith(f"reaction.{long} ") for line in lines) == 3
    assert max(map(len, lines)) <= 80


def test_nothing_done_and_nothing_solved(tmp_path):
    done = gapbeam.batch(SCENE, {"beam.EI": [-1.0, -2.0]}, tmp_path / "out", chunk=1)
    summary = done.summary(limits={"moment.max": 1.0})
    assert summary.statuses == {"refused": 2}
    assert summary.columns["moment.max"].count == 0
    assert np.isnan(summary.columns["moment.max"].quantiles[0.5])
    assert summary.to_dict()["columns"] == {}
    for part in (tmp_path / "out").glob("part*"):
        part.unlink()
    assert gapbeam.Batch(tmp_path / "out").summary().statuses == {}


def test_of_combinations_each_support_has_its_largest_opening(tmp_path):
    """A support may be called "max", and there are two columns for each."""
    scene = {
        "beam": {"spans": [6.0, 6.0], "EI": 1e4}, "loads": [{"type": "uniform", "q": 5.0}],
        "supports": [{"node": 0, "name": "max"}, {"node": 1, "side": "below", "gap": 0.5, "name": "pier"}, {"node": 2}],
    }  # fmt: skip
    one = gapbeam.batch(scene, {"loads[0].q": [1.0, 2.0]}, tmp_path / "one")
    assert list(one.extremes) == ["deflection", "moment"]
    combinations = [{"name": "a", "factors": {"live": 1.0}}, {"name": "b", "factors": {"live": -1.0}}]
    both = gapbeam.batch({**scene, "combinations": combinations}, {"loads[0].q": [1.0, 2.0]}, tmp_path / "both")
    for batch, largest in ((one, one.openings["pier"]), (both, both.openings["pier.max"])):
        for lifted in (batch.lifted, batch.summary().lifted):
            assert [(lift.support, lift.opening, lift.share) for lift in lifted] == [(1, largest.max(), 1.0)]
    with pytest.raises(ValueError, match="states: there are many"):
        _ = both.states


def test_the_scenes_of_a_folder_have_no_supports_in_common(tmp_path):
    (tmp_path / "scenes").mkdir()
    for k in range(2):
        scene = gapbeam.Scene(beam=gapbeam.Beam([6.0], EI=1e4), supports=[gapbeam.Support(node=0), gapbeam.Support(node=1)])
        gapbeam.replace(scene, "loads", [gapbeam.UniformLoad(q=k + 1.0)]).to_toml(tmp_path / "scenes" / f"{k}.toml")
    batch = gapbeam.batch(tmp_path / "scenes", None, tmp_path / "out")
    assert list(batch.extremes) == ["deflection", "moment"]
    assert batch.extremes["moment"]["max"].value == pytest.approx([4.5, 9.0])
    for one in (batch, batch.summary()):
        with pytest.raises(ValueError, match="scene"):
            _ = one.lifted
