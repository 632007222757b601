"""The verbs that every result has: outcome, values by name, tables, pictures, reports, JSON, and what a notebook shows."""

import json
import pickle
import subprocess
import sys

import gapbeam
import numpy as np
import pytest
from matplotlib.figure import Figure

SUPPORTS = [gapbeam.Support(node=i, side="below", name=name) for i, name in enumerate("ABCD")]
BEAM = gapbeam.Beam(spans=[6.0, 6.0, 6.0], EI=1e4)
LOADS = [gapbeam.UniformLoad(q=2.0, case="dead"), gapbeam.ForceLoad(x=3.0, F=160.0, case="crane")]
COMBINATIONS = [
    gapbeam.Combination(name="rest", factors={"dead": 1.0}), gapbeam.Combination(name="lift", factors={"dead": 1.0, "crane": 1.5}),
]  # fmt: skip


def scene(**more):
    return gapbeam.Scene(beam=BEAM, units=gapbeam.Units("kN", "m"), supports=SUPPORTS, loads=LOADS, **more)


@pytest.fixture(scope="module")
def result():
    return gapbeam.solve(scene())


@pytest.fixture(scope="module")
def combined():
    return gapbeam.solve(scene(combinations=COMBINATIONS))


@pytest.fixture(scope="module")
def train():
    trains = [gapbeam.Train(name="crane", axles=[(0.0, 100.0), (2.0, 60.0)])]
    return gapbeam.solve(gapbeam.Scene(beam=BEAM, supports=SUPPORTS, loads=LOADS[:1], trains=trains))


@pytest.fixture(scope="module")
def fallen():
    return gapbeam.solve(gapbeam.Scene(beam=BEAM, loads=LOADS))


def test_outcome(result, fallen):
    assert result.ok
    assert result.raise_for_status() is result
    assert not fallen.ok
    with pytest.raises(gapbeam.UnsolvedError, match="moves down as a whole") as caught:
        fallen.raise_for_status()
    assert (caught.value.status, caught.value.reason) == ("no-equilibrium", fallen.reason)
    again = pickle.loads(pickle.dumps(caught.value))
    assert (again.status, str(again)) == ("no-equilibrium", fallen.reason)


def test_values_by_number_and_name(result):
    step = result.steps[-1]
    assert result.reactions["B"] == result.reactions[1] == result.reactions[-3] == step.reaction[1]
    assert list(result.reactions) == step.reaction.tolist()
    assert sum(result.reactions) == pytest.approx(2.0 * 18.0 + 160.0)
    assert np.array_equal(np.asarray(result.openings), step.opening)
    assert result.states.to_dict() == dict(zip("ABCD", step.state, strict=True))
    assert (result.states["C"], "open" in result.states, len(result.states)) == ("open", True, 4)
    assert repr(result.reactions) == "reaction: A 71.5, B 119.75, C 0, D 4.75"
    assert result.reactions[:2].tolist() == step.reaction[:2].tolist()
    with pytest.raises(KeyError, match="there is no support 'E'"):
        result.reactions["E"]
    with pytest.raises(IndexError, match="from 0 to 3"):
        result.reactions[4]
    with pytest.raises(TypeError):
        result.reactions["A"] = 1.0


def test_without_names_the_keys_are_numbers():
    bare = gapbeam.Scene(beam=BEAM, supports=[gapbeam.Support(node=i) for i in range(4)], loads=LOADS)
    reactions = gapbeam.solve(bare).reactions
    assert reactions.keys() == (0, 1, 2, 3)
    assert reactions.to_dict()[2] == reactions[2]


def test_of_combinations_by_combination(combined):
    assert combined.reactions.keys() == ("rest", "lift")
    for name in combined.names:
        step = combined.combinations[name].steps[-1]
        assert list(combined.reactions[name]) == pytest.approx(step.reaction.tolist())
        assert list(combined.openings[name]) == pytest.approx(step.opening.tolist())
        assert tuple(combined.states[name]) == step.state
    assert np.asarray(combined.reactions).shape == (2, 4)
    assert combined.reactions["lift"]["B"] == combined.reactions[1][1]
    assert "lift: reaction: A" in repr(combined.reactions)
    at = combined.at(3.0, combination="lift", factor=0.5)
    assert at.moment == combined.combinations["lift"].at(3.0, factor=0.5).moment
    with pytest.raises(ValueError, match="take for example"):
        combined.at(3.0)
    with pytest.raises(KeyError, match="there is no combination"):
        combined.at(3.0, combination="ULS")


def test_of_trains_extremes(train):
    largest = train.envelope().supports[1]["reaction"]["max"]
    assert train.reactions["B"]["max"].value == largest.value
    at = train.at(6.0, position=4.0)
    assert at.moment == train.trains["crane"].state(4.0).fields(6.0).moment
    assert train.at(6.0, position=4.0, train="crane").moment == at.moment
    with pytest.raises(KeyError, match="did you mean 'crane'"):
        train.at(6.0, position=4.0, train="crain")
    with pytest.raises(ValueError, match="leave step, factor and leg out"):
        train.at(6.0, position=4.0, factor=0.5)


def test_at_a_leg_of_the_history():
    supports = [gapbeam.Support(node=i) for i in (0, 1, 3)]
    supports.insert(2, gapbeam.Support(node=2, side="below", law=[(0.001, 20.0), (0.1, 21.0)], unloading="plastic"))
    history = gapbeam.Analysis(follow="events", history=[1.0, 0.0])
    loads = [gapbeam.ForceLoad(x=12.0, F=160.0)]
    result = gapbeam.solve(gapbeam.Scene(beam=BEAM, supports=supports, loads=loads, analysis=history))
    there, back = (float(result.at(12.0, factor=0.5, leg=leg).deflection) for leg in (0, 1))
    assert there != back
    assert back == float(result.at(12.0, factor=0.5).deflection)
    with pytest.raises(ValueError, match="its legs are 0 to 1"):
        result.at(12.0, factor=0.5, leg=2)
    with pytest.raises(ValueError, match="load factor on it"):
        result.at(12.0, leg=0)


def test_tables(result, combined, train):
    table = result.table("supports")
    assert table["support"] == list("ABCD")
    assert table["reaction"].tolist() == list(result.reactions)
    assert repr(table).splitlines()[3].split() == ["C", "12", "below", "open", "0", "-0.0243", "0.0243", "0"]
    assert result.table("fields").keys() == result.fields().columns().keys()
    assert result.table("events").count == 0
    assert combined.table("combinations")["combination"] == ["rest", "lift"]
    assert "reaction_max_combination" in combined.table()
    assert train.table("events")["position"].tolist() == [event.position for event in train.trains["crane"].events]
    followed = gapbeam.solve(scene(analysis=gapbeam.Analysis(follow="events")))
    assert followed.table("events")["event"] == [event.event for event in followed.events]
    assert followed.table("events")["support"][0] == "C"
    with pytest.raises(ValueError, match="the scene has no combinations"):
        result.table("combinations")
    with pytest.raises(ValueError, match='expected "supports"'):
        result.table("support")


def test_tables_for_pandas(result):
    pandas = pytest.importorskip("pandas")
    assert result.table("supports").to_pandas()["reaction"].tolist() == list(result.reactions)
    assert list(pandas.DataFrame(result.fields()).columns) == list(result.fields().columns())


def test_fields_are_rows():
    fields = gapbeam.solve(scene()).at([1.0, 2.0])
    assert [(row.x, row.moment) for row in fields] == list(zip(fields.x, fields.moment, strict=True))


def test_pictures(result, combined, train, fallen, tmp_path):
    for one in (result, combined, train, fallen):
        assert isinstance(one.plot(), Figure)
    assert result.plot()._repr_png_().startswith(b"\x89PNG")
    result.plot(tmp_path / "a.svg")
    result.plot(str(tmp_path / "b.png"))
    figure = result.plot("moment", path=tmp_path / "c.pdf")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.svg", "b.png", "c.pdf"]
    curve = figure.axes[0].lines[0].get_ydata()
    assert curve.max() == pytest.approx(result.extremes["moment"]["max"].value)
    axes = Figure().add_subplot()
    assert combined.plot("shear", ax=axes) is axes.figure
    assert isinstance(result.plot("path"), Figure)
    with pytest.raises(ValueError, match="panels of its own"):
        result.plot(ax=axes)
    with pytest.raises(ValueError, match='"moment"'):
        result.plot("bending")
    with pytest.raises(ValueError, match="a file that ends in"):
        result.plot("a.xyz")


def test_report_and_json(result, combined, tmp_path):
    from gapbeam.report import report_text, to_json

    for one in (result, combined):
        assert one.report() == report_text(one)
        assert one.to_json(tmp_path / "a.json", points=4) == to_json(one, 4) == (tmp_path / "a.json").read_text()
    assert json.loads(result.to_json())["status"] == "solved"


def test_notebook(result, combined, train, fallen):
    for one in (result, combined, train, fallen):
        assert "data:image/svg+xml" in one._repr_html_()
    html = result._repr_html_()
    assert "lifts off by 24.3 mm" in html
    assert "<td>C</td>" in html
    odd = gapbeam.solve(gapbeam.replace(scene(), "title", "<b>5 & 6</b>"))
    assert "&lt;b&gt;5 &amp; 6" in odd._repr_html_()
    assert "<b>5" not in odd._repr_html_()


def test_errors_inside_of_properties_are_told(result):
    class Broken(type(result)):
        @property
        def wrong(self):
            return result.steps.not_there

    broken = Broken(result.scene, result._beam, result._rule)
    with pytest.raises(AttributeError, match="not_there"):
        broken.wrong  # noqa: B018
    assert not hasattr(result, "__nothing__")
    assert not hasattr(result, "nothing_of_this_kind")


def test_an_unpickled_result_can_be_shown_where_nothing_else_was_asked_for(result, tmp_path):
    (tmp_path / "result").write_bytes(pickle.dumps(result))
    code = "import pickle, sys; print(pickle.load(open(sys.argv[1], 'rb')).report())"
    done = subprocess.run([sys.executable, "-c", code, str(tmp_path / "result")], capture_output=True, text=True, check=True)
    assert "lifts off by 24.3 mm" in done.stdout


def test_importing_and_solving_loads_neither_matplotlib_nor_rich():
    code = (
        "import gapbeam, sys; scene = {'beam': {'spans': [1.0], 'EI': 1.0}, 'supports': [{'node': 0}, {'node': 1}]};"
        "gapbeam.solve(scene).reactions;"
        "print([name for name in ('matplotlib', 'rich', 'pandas') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
