"""The tasks of designers in examples/tasks: each runs, is short, and its numbers are those of a displacement method."""

import itertools
import runpy
from pathlib import Path

import numpy as np
import pytest

TASKS = Path(__file__).resolve().parents[2] / "examples" / "tasks"
NAMES = ["pipe_rack", "crane_runway", "footing", "bridge", "shaft", "stops", "pile", "slab", "tolerances"]
MOST_LINES = 15


def run(name, folder, monkeypatch, capsys):
    """Names that a script leaves, and what it has printed."""
    monkeypatch.chdir(folder)
    return runpy.run_path(str(TASKS / f"{name}.py")), capsys.readouterr().out


def by_displacements(x, EI, q, forces, springs):
    """Deflections at nodes (positive down) and reactions (positive up) of a prismatic beam: Hermite elements, no gapbeam.

    `q` by number or by place; `forces` by place; `springs` by place: (stiffness, seat).
    """
    x = np.array(sorted({*x, *forces, *springs}))
    n = len(x)
    K, f = np.zeros((2 * n, 2 * n)), np.zeros(2 * n)
    for i, L in enumerate(np.diff(x)):
        k = EI / L**3 * np.array([[12, 6 * L, -12, 6 * L], [6 * L, 4 * L**2, -6 * L, 2 * L**2],
                                  [-12, -6 * L, 12, -6 * L], [6 * L, 2 * L**2, -6 * L, 4 * L**2]])  # fmt: skip
        K[2 * i : 2 * i + 4, 2 * i : 2 * i + 4] += k
        f[2 * i : 2 * i + 4] += (q(x[i] + L / 2) if callable(q) else q) * L / 2 * np.array([1, L / 6, 1, -L / 6])
    at = {place: int(np.flatnonzero(x == place)[0]) for place in (*forces, *springs)}
    for place, force in forces.items():
        f[2 * at[place]] += force
    for place, (stiffness, seat) in springs.items():
        K[2 * at[place], 2 * at[place]] += stiffness
        f[2 * at[place]] += stiffness * seat
    w = np.linalg.solve(K, f)
    deflection = dict(zip(x.tolist(), w[::2].tolist(), strict=True))
    return deflection, {place: stiffness * (deflection[place] - seat) for place, (stiffness, seat) in springs.items()}


def held(states, seats, rigid):
    """Springs for the supports that act."""
    return {x: (rigid, seat) for (x, seat), state in zip(seats.items(), states, strict=True) if state != "open"}


@pytest.mark.parametrize("name", NAMES)
def test_a_task_is_short(name):
    text = (TASKS / f"{name}.py").read_text(encoding="utf-8")
    assert text.startswith('"""')
    described, _, asked = text.partition("# What a designer asks\n")
    lines = [line for line in asked.splitlines() if line.strip()]
    assert 4 <= len(lines) <= MOST_LINES
    described = described.rpartition('"""\n')[2] if described.count('"""') == 2 else described
    assert len([line for line in described.splitlines() if line.strip()]) <= MOST_LINES
    assert sorted(path.stem for path in TASKS.glob("*.py")) == sorted(NAMES)


def test_pipe_rack(tmp_path, monkeypatch, capsys):
    names, out = run("pipe_rack", tmp_path, monkeypatch, capsys)
    result = names["result"]
    x = [0.0, 6.0, 12.0, 18.0, 24.0, 28.0]
    for case, q, rise in (("cold", 0.85, 0.0), ("hot", 0.85, -0.045), ("hydrotest", 1.2, 0.0)):
        springs = held(result.states[case], dict(zip(x, [rise, *[0.0] * 5], strict=True)), 1e10)
        # The clamped end: the beam goes on beyond it, mirrored, so that it does not turn there
        mirrored = {56.0 - place: spring for place, spring in springs.items()}
        deflection, reactions = by_displacements([0.0, 56.0], 7.8e3, q, {}, springs | mirrored)
        for name, place in zip(names["RACKS"], x, strict=True):
            half = 0.5 if place == 28.0 else 1.0
            assert result.reactions[case][name] == pytest.approx(half * reactions.get(place, 0.0), rel=1e-5, abs=1e-6)
    assert [(names["RACKS"][one.support], one.combination) for one in result.lifted] == [("R1", "hot")]
    springs = {p: (1e10, -0.045 if p in (0, 56) else 0.0) for p in (0, 12, 18, 24, 28, 32, 38, 44, 56)}
    deflection, _ = by_displacements([6.0, 50.0], 7.8e3, 0.85, {}, springs)
    assert result.lifted[0].opening == pytest.approx(-deflection[6.0], rel=1e-4)
    assert "0 \u21910.375" in out
    assert "Limit of moment     85% used" in out
    assert (tmp_path / "pipe_rack.svg").stat().st_size > 10_000


def test_crane_runway(tmp_path, monkeypatch, capsys):
    names, out = run("crane_runway", tmp_path, monkeypatch, capsys)
    result, seats = names["result"], {7.5 * k: 0.0 for k in range(7)}
    first = result.lifted[0]
    state = result.trains[first.train].state(first.position)
    forces = {first.position: 180.0, first.position - 3.6: 180.0}
    deflection, reactions = by_displacements(list(seats), 2.1e5, 3.0, forces, held(state.state, seats, 1e11))
    assert first.opening == pytest.approx(-deflection[0.0], rel=1e-5)
    assert min(reactions.values()) > 0.0
    assert all(deflection[7.5 * k] <= 0.0 for k in range(7) if state.state[k] == "open")
    assert f"C0 lifts off by {1e3 * first.opening:.2f} mm, crane 1 at {first.position:.2f} m" in out
    most = result.envelope().extremes["moment"]["max"]
    both = {most.position - d: F for d, F in ((0.0, 180.0), (3.6, 180.0), (5.5, 120.0), (8.7, 120.0))}
    state = result.trains["both"].state(most.position)
    _, reactions = by_displacements(list(seats), 2.1e5, 3.0, both, held(state.state, seats, 1e11))
    moment = sum(R * (most.x - x) for x, R in reactions.items() if x < most.x) - 1.5 * most.x**2
    moment -= sum(F * (most.x - x) for x, F in both.items() if x < most.x)
    assert most.value == pytest.approx(moment, rel=1e-4)
    assert sum(reactions.values()) == pytest.approx(135.0 + 600.0)


def test_footing(tmp_path, monkeypatch, capsys):
    names, out = run("footing", tmp_path, monkeypatch, capsys)
    result, k = names["result"], 3.0e4
    x, p = ground_pressure(result)
    np.testing.assert_allclose(p, k * np.maximum(result.at(x).deflection, 0.0), rtol=1e-9, atol=1e-6)
    assert np.trapezoid(p, x) == pytest.approx(600.0, rel=1e-5)
    assert np.trapezoid(p * x, x) == pytest.approx(25.0 * 8.0 + 500.0 * 0.8, rel=1e-5)
    cells = np.linspace(0.0, 4.0, 401)
    springs = {float(c): (k * 0.01 * (0.5 if c in (0.0, 4.0) else 1.0), 0.0) for c in cells if c < names["carries"]}
    deflection, _ = by_displacements([0.0, 4.0], 5.0e5, 25.0, {0.8: 500.0}, springs)
    assert deflection[0.0] == pytest.approx(float(result.at(0.0).deflection), rel=5e-3)
    assert deflection[4.0] == pytest.approx(float(result.at(4.0).deflection), rel=2e-2)
    assert names["pressure"].value == pytest.approx(k * float(result.at(0.0).deflection) / 1.5, rel=1e-9)
    assert f"3.001 m of 4 m carry; {names['pressure'].value:.1f} kPa" in out


def ground_pressure(result):
    """Line pressures of the ground at many places."""
    x = np.linspace(0.0, float(result.scene.span_ends()[-1]), 20_001)
    return x, result.at(x).pressure


def test_bridge(tmp_path, monkeypatch, capsys):
    names, _ = run("bridge", tmp_path, monkeypatch, capsys)
    result, seats = names["result"], {0.0: 0.0, 18.0: 0.0, 63.0: 0.0, 81.0: 0.0}
    first = result.lifted[0]
    assert (first.support, first.combination) == (0, "heavy [udl 010]")
    state = result.combinations[first.combination].trains["TS"].state(first.position)
    assert state.state[0] == "open"
    forces = {first.position: 1.35 * 600.0, first.position - 1.2: 1.35 * 600.0}

    def q(x):
        return 1.35 * (90.0 + 27.0 * (18.0 < x < 63.0))

    deflection, reactions = by_displacements(list(seats), 3.0e7, q, forces, held(state.state, seats, 1e12))
    assert first.opening == pytest.approx(-deflection[0.0], rel=1e-4)
    assert sum(reactions.values()) == pytest.approx(1.35 * (90.0 * 81.0 + 27.0 * 45.0 + 1200.0), rel=1e-6)
    assert result.lifted[1].opening == pytest.approx(first.opening, rel=1e-9)


def test_shaft(tmp_path, monkeypatch, capsys):
    names, out = run("shaft", tmp_path, monkeypatch, capsys)
    result = names["result"]
    reactions = np.array(list(result.reactions.to_dict().values()))
    x = np.array([0.0, 0.0, 500.0, 500.0, 1100.0, 1100.0])
    assert reactions.sum() == pytest.approx(0.15 * 1250.0 - 2500.0 + 900.0)
    assert reactions @ x == pytest.approx(0.15 * 1250.0 * 625.0 - 2500.0 * 250.0 + 900.0 * 1250.0)
    springs = {0.0: (1e11, -0.1), 500.0: (1e11, -0.1), 1100.0: (1e11, 0.15)}
    _, expected = by_displacements([0.0, 1250.0], 1.3e11, 0.15, {250.0: -2500.0, 1250.0: 900.0}, springs)
    assert reactions[[1, 3, 4]] == pytest.approx(list(expected.values()), rel=1e-4)
    assert "32.0% of the load: middle, upper shell closes" in out


def test_stops(tmp_path, monkeypatch, capsys):
    names, out = run("stops", tmp_path, monkeypatch, capsys)
    result, limit = names["result"], names["limit"]

    def pin(F):
        """Reaction of the pin while it holds; the tip is on the rubber beyond its gap."""
        springs = {0.0: (1e12, 0.0), 3.0: (5.0e5, 0.0)}
        tip, reactions = by_displacements([5.0], 8.0e3, 0.0, {5.0: F}, springs)
        if tip[5.0] > 0.04:
            _, reactions = by_displacements([5.0], 8.0e3, 0.0, {5.0: F}, springs | {5.0: (400.0, 0.04)})
        return reactions[3.0]

    assert pin(80.0 * limit.factor) == pytest.approx(90.0, rel=1e-6)
    assert limit.landing.reaction[2] == pytest.approx(80.0 * limit.factor)  # without the pin the arm is a lever
    assert float(result.at(5.0).deflection) == pytest.approx(0.04 + 20.0 / 400.0 + (80.0 - 20.0) / 4.0e3)
    assert names["worst"].value == pytest.approx(-108.0)
    assert "Limit load at 70.15 % of the load: support pin (x = 3) breaks (90 kN)." in out


def test_pile(tmp_path, monkeypatch, capsys):
    names, _ = run("pile", tmp_path, monkeypatch, capsys)
    result = names["result"]
    x, p = ground_pressure(result)
    assert np.trapezoid(p, x) == pytest.approx(120.0, rel=1e-3)
    assert np.trapezoid(p * x, x) == pytest.approx(0.0, abs=0.1)
    w = result.at(x).deflection
    cu, y50 = 20.0 + 2.0 * x, 2.5 * 0.01 * 0.6
    most = np.minimum(3.0 * cu * 0.6 + 8.0 * x * 0.6 + 0.5 * cu * x, 9.0 * cu * 0.6)
    curve = 0.5 * most * np.minimum(np.cbrt(np.abs(w) / y50), 2.0)
    assert (np.abs(curve - np.abs(p)) < 0.005 * most).all()
    assert (p * w >= 0.0).all()
    assert names["again"].at(0.0).deflection > result.at(0.0).deflection


def test_slab(tmp_path, monkeypatch, capsys):
    names, _ = run("slab", tmp_path, monkeypatch, capsys)
    for (name, result), mound in zip(names["results"].items(), (names["EDGE"], names["CENTRE"]), strict=True):
        x, p = ground_pressure(result)
        gap = np.interp(x, *zip(*mound, strict=True))
        np.testing.assert_allclose(p, 1000.0 * np.maximum(result.at(x).deflection - gap, 0.0), rtol=1e-8, atol=1e-8)
        assert np.trapezoid(p, x) == pytest.approx(92.0, rel=1e-4), name
    assert not names["results"]["edge heave"].steps[-1].free_spans
    left, right = names["results"]["centre heave"].steps[-1].free_spans
    assert left.to == pytest.approx(12.0 - right.from_, abs=1e-9)
    assert (tmp_path / "centre_heave.svg").exists()


def test_tolerances(tmp_path, monkeypatch, capsys):
    names, out = run("tolerances", tmp_path, monkeypatch, capsys)
    done, seats = names["done"], [8.0 * k for k in range(6)]
    gaps = np.array([done.read([f"supports[{k}].gap"])[f"supports[{k}].gap"][:12] for k in range(1, 5)]).T
    found = np.array(list(done.read([f"reaction.B{k}" for k in range(6)]).values()))[:, :12].T
    for gap, reactions in zip(gaps, found, strict=True):
        levels = dict(zip(seats, [0.0, *gap, 0.0], strict=True))
        fits = []
        for acts in itertools.product((False, True), repeat=4):
            springs = {x: (1e10, level) for (x, level), on in zip(levels.items(), (True, *acts, True), strict=True) if on}
            w, R = by_displacements(seats, 2.0e5, 4.0, {4.0: 60.0}, springs)
            if all(R[x] >= 0.0 if x in R else w[x] <= levels[x] for x in seats[1:5]):
                fits.append([R.get(x, 0.0) for x in seats])
        assert len(fits) == 1
        np.testing.assert_allclose(reactions, fits[0], rtol=1e-4, atol=1e-3)
    assert "B2: no contact in 29.4% of the cases" in out
