"""Axial forces that change along the beam: loads along it, as the weight of a pile, act on bending."""

import math
import random
from itertools import pairwise

import gapbeam
import numpy as np
import pytest
from mpmath import mp
from scenes import force, uniform

PINS = [{"node": 0}, {"node": 1}]
ALONG = {"node": 0, "direction": "axial"}


def along(q, **place):
    return {"type": "axial_uniform", "q": q, **place}


def simple(q, pull, k):
    """A simple beam of length, EI and load 1 under a load along it, pulled at its free end, perhaps on ground."""
    loads = [uniform(1.0), along(q), {"type": "axial", "node": 1, "F": pull}]
    scene = {"beam": {"spans": [1.0], "EI": 1.0}, "supports": [*PINS, ALONG], "loads": loads}
    return {**scene, "foundation": [{"k": k}]} if k else scene


def by_series(q, pull, k, x):
    """Its deflection, rotation, moment and transverse force by power series in 40 digits."""

    def series(start, load):
        w, psi, M, T = ([mp.mpf(value)] for value in start)
        for i in range(140):
            turned = (pull + q) * psi[i] - (q * psi[i - 1] if i else 0)
            w.append(psi[i] / (i + 1))
            psi.append(-M[i] / (i + 1))
            M.append((T[i] - turned) / (i + 1))
            T.append((k * w[i] - (load if i == 0 else 0)) / (i + 1))
        return w, psi, M, T

    with mp.workdps(40):
        q, pull, k = map(mp.mpf, (q, pull, k))
        turned, sheared, loaded = series((0, 1, 0, 0), 0), series((0, 0, 0, 1), 0), series((0, 0, 0, 0), 1)
        end = mp.matrix([[mp.fsum(one[row]) for one in (turned, sheared)] for row in (0, 2)])
        by = mp.lu_solve(end, mp.matrix([-mp.fsum(loaded[row]) for row in (0, 2)]))
        fields = zip(turned, sheared, loaded, strict=True)
        sums = [[a * by[0] + b * by[1] + c for a, b, c in zip(*series, strict=True)] for series in fields]
        return [float(mp.fsum(term * mp.mpf(x) ** i for i, term in enumerate(one))) for one in sums]


@pytest.mark.parametrize(
    ("q", "pull", "k"),
    [(10.0, 0.0, 0.0), (-8.0, 0.0, 0.0), (30.0, -5.0, 0.0), (10.0, 3.0, 50.0), (300.0, 0.0, 0.0), (-9.0, 4.0, 20.0)],
)
def test_a_simple_beam(q, pull, k):
    result = gapbeam.solve(simple(q, pull, k))
    places = np.linspace(0.0, 1.0, 9)
    exact = np.array([by_series(q, pull, k, x) for x in places]).T
    fields = result.at(places)
    for name, values in zip(("deflection", "rotation", "moment", "transverse"), exact, strict=True):
        np.testing.assert_allclose(getattr(fields, name), values, rtol=0, atol=3e-15 * np.abs(values).max(), err_msg=name)
    shear = exact[3] - (pull + q * (1.0 - places)) * exact[1]
    np.testing.assert_allclose(fields.shear, shear, rtol=0, atol=1e-14 * np.abs(exact[3]).max())
    dense = result.at(np.linspace(0.0, 1.0, 4001))
    for name in ("deflection", "rotation", "moment", "shear", "transverse"):
        found, values = result.extremes[name], getattr(dense, name)
        assert 0.0 <= found["max"].value - values.max() + 1e-15 <= 1e-5 * np.ptp(values)
        assert 0.0 <= values.min() - found["min"].value + 1e-15 <= 1e-5 * np.ptp(values)


def test_a_column_buckles_under_its_weight():
    """At 7.837... EI/L**3 (Greenhill 1881): 9/4 of the square of the first zero of a Bessel function of order -1/3."""
    with mp.workdps(30):
        critical = float(mp.mpf(9) / 4 * mp.findroot(lambda t: mp.besselj(-mp.mpf(1) / 3, t), 1.866) ** 2)
    mast = {"beam": {"spans": [1.0], "EI": 1.0}, "supports": [{"node": 0, "rotation": "fixed"}, ALONG], "loads": [along(-1.0)]}
    assert gapbeam.solve({**mast, "analysis": {"buckling": 1}}).buckling == (pytest.approx(critical, rel=1e-14),)
    for share, status in ((0.999, "solved"), (1.001, "buckles")):
        assert gapbeam.solve({**mast, "loads": [along(-share * critical), uniform(0.01)]}).status == status


def test_a_hanging_chain_swings():
    """Nearly without bending stiffness, as zeros of the Bessel function of order 0 say."""
    chain = {"beam": {"spans": [1.0], "EI": 1e-5, "mass": 1.0}, "supports": [{"node": 0}, ALONG], "loads": [along(1.0)]}
    found = gapbeam.solve({**chain, "analysis": {"frequencies": 2}}).frequencies
    np.testing.assert_allclose(found, [float(mp.besseljzero(0, k)) / 2.0 for k in (1, 2)], rtol=1e-3)


def drawn(seed, pieces=None):
    """A beam on one-sided supports and ground under loads along it; in pieces, with the forces in their middles instead."""
    draw = random.Random(seed)
    n = draw.randint(1, 3)
    spans = [draw.choice([1.0, 2.0]) for _ in range(n)]
    supports = [{"node": i, "side": draw.choice(["both", "below"])} for i in range(1, n)] + [{"node": 0}, {"node": n}]
    end = sum(spans)
    loads = [uniform(draw.uniform(1.0, 5.0)), force(draw.uniform(0.0, end), draw.uniform(-10.0, 10.0))]
    from_, to = sorted(round(draw.uniform(0.0, end), 1) for _ in "ab")
    q, pull = draw.uniform(-3.0, 20.0), draw.uniform(-1.0, 10.0)
    scene = {"beam": {"spans": spans, "EI": draw.choice([1.0, 5.0])}, "supports": supports, "loads": loads}
    if draw.random() < 0.5:
        scene["foundation"] = [{"k": draw.uniform(1.0, 50.0), "side": draw.choice(["both", "below"])}]
    if pieces is None:
        scene["loads"] += [along(q, **{"from": from_, "to": to + 0.1}), {"type": "axial", "node": n, "F": pull}]
        scene["supports"].append(ALONG)
        return scene
    to += 0.1
    cuts = np.linspace(from_, min(to, end), pieces + 1).tolist()
    scene["beam"]["N"] = pull
    scene["sections"] = [{"from": 0.0, "to": from_, "N": pull + q * (cuts[-1] - from_)}] if from_ > 0.0 else []
    scene["sections"] += [{"from": a, "to": b, "N": pull + q * (cuts[-1] - (a + b) / 2.0)} for a, b in pairwise(cuts)]
    return scene


@pytest.mark.parametrize("seed", range(24))
def test_random_beams_beside_short_pieces(seed):
    """With constant forces these converge with the square of their length: extrapolated (Richardson 1911)."""
    scene = drawn(seed)
    scene["loads"][-2]["to"] = min(scene["loads"][-2]["to"], sum(scene["beam"]["spans"]))
    result = gapbeam.solve(scene)
    assert result._beam.feels_axial_loads
    coarse, fine = (gapbeam.solve(drawn(seed, pieces)) for pieces in (24, 48))
    assert result.status == coarse.status == fine.status == "solved"
    # Where pieces of both end: inside of them errors are not smooth
    load = scene["loads"][-2]
    places = np.linspace(load["from"], load["to"], 25)
    for name in ("deflection", "moment", "transverse"):
        one, two = (getattr(other.at(places), name) for other in (coarse, fine))
        expected = (4.0 * two - one) / 3.0
        largest = max(abs(result.extremes[name][end].value) for end in ("max", "min"))
        np.testing.assert_allclose(getattr(result.at(places), name), expected, rtol=0, atol=5e-6 * largest, err_msg=name)
    assert "axial force N" not in result.report()
    sums = [line for line in result.report().splitlines() if line.startswith("Sum of ")]
    assert len({line.split("x = 0")[-1].split()[0] if "x = 0" in line else line.split()[-2] for line in sums}) <= 2


def test_in_first_order_beside_shear_and_rigid_ground():
    """Where series of it are not available."""
    scene = simple(10.0, 0.0, 0.0)
    assert gapbeam.solve(scene)._beam.feels_axial_loads
    assert not gapbeam.solve({**scene, "beam": {**scene["beam"], "GA": 100.0}})._beam.feels_axial_loads
    rigid = {"k": float("inf"), "side": "below", "gap": 0.1}
    assert not gapbeam.solve({**scene, "foundation": [rigid]})._beam.feels_axial_loads


def cubic(w, p):
    """The next term of 20 w + 3e5 w^3 from those of w."""
    i = len(p)
    square = [mp.fsum(w[j] * w[k - j] for j in range(k + 1)) for k in range(i + 1)]
    return 20 * w[i] + 300000 * mp.fsum(square[k] * w[i - k] for k in range(i + 1))


def tanh(w, p):
    """The same of 2 tanh(30 w), whose slope is 60 - 15 p^2."""
    i = len(p) - 1
    if i < 0:
        return 2 * mp.tanh(30 * w[0])
    slope = [(60 if k == 0 else 0) - 15 * mp.fsum(p[j] * p[k - j] for j in range(k + 1)) for k in range(i + 1)]
    return mp.fsum(slope[k] * (i - k + 1) * w[i - k + 1] for k in range(i + 1)) / (i + 1)


def on_curve(q, pull, force, guess):
    """Fields at the eighths, on ground that pushes by a curve: series from rotation and transverse force at the left end."""

    def go_on(start, before):
        w, psi, M, T = ([value] for value in start)
        p = []
        for i in range(32):
            p.append(force(w, p))
            turned = (pull + q * (1 - before)) * psi[i] - (q * psi[i - 1] if i else 0)
            w.append(psi[i] / (i + 1))
            psi.append(-M[i] / (i + 1))
            M.append((T[i] - turned) / (i + 1))
            T.append((p[i] - (1 if i == 0 else 0)) / (i + 1))
        return [mp.fsum(term / mp.mpf(8) ** i for i, term in enumerate(one)) for one in (w, psi, M, T)]

    def fields(psi, T):
        found = [[mp.mpf(0), psi, mp.mpf(0), T]]
        for i in range(8):
            found.append(go_on(found[-1], mp.mpf(i) / 8))
        return found

    with mp.workdps(30):
        q, pull = mp.mpf(q), mp.mpf(pull)
        start = mp.findroot(lambda *start: fields(*start)[-1][0:3:2], [mp.mpf(one) for one in guess])
        return [[float(value) for value in one] for one in zip(*fields(*start), strict=True)]


@pytest.mark.parametrize(
    ("q", "pull", "law", "force"),
    [
        (40.0, 0.0, {"type": "cubic", "k1": 20.0, "k2": 0.0, "k3": 3e5}, cubic),
        (-30.0, 9.0, {"type": "tanh", "stiffness": 60.0, "limit": 2.0}, tanh),
    ],
)
def test_on_ground_that_pushes_by_a_curve(q, pull, law, force):
    result = gapbeam.solve({**simple(q, pull, 0.0), "foundation": [{"law": law}]})
    fields = result.at(np.linspace(0.0, 1.0, 9))
    exact = np.array(on_curve(q, pull, force, (fields.rotation[0], fields.transverse[0])))
    for name, values in zip(("deflection", "rotation", "moment", "transverse"), exact, strict=True):
        assert getattr(fields, name) == pytest.approx(values, rel=1e-12, abs=1e-12 * np.abs(values).max())


def test_modes_on_curves_are_those_on_their_tangents():
    """Next to no deflection: the slope of every law is that of the ground."""
    laws = [{"k": 50.0}, {"law": {"type": "tanh", "stiffness": 50.0, "limit": 1e9}}, {"law": [[1.0, 50.0], [2.0, 60.0]]}]
    found = []
    for law in laws:
        scene = {**simple(-30.0, 8.0, 0.0), "foundation": [law], "analysis": {"buckling": 2, "frequencies": 2}}
        scene["beam"] = {**scene["beam"], "mass": 1.0}
        result = gapbeam.solve(scene)
        found.append([*result.buckling, *result.frequencies])
    assert found[1] == pytest.approx(found[0], rel=1e-12)
    assert found[2] == pytest.approx(found[0], rel=1e-12)


def test_load_factors_events_and_cases():
    """The axial force grows with its loads."""
    scene = simple(-6.0, 2.0, 0.0)
    scene["supports"].append({"x": 0.5, "side": "below", "gap": 0.012})
    half = {**scene, "loads": [{**load, **{key: load[key] / 2.0 for key in ("q", "F") if key in load}} for load in scene["loads"]]}
    steps = gapbeam.solve({**scene, "analysis": {"steps": 2}})
    assert steps.at(0.3, factor=0.5).moment == pytest.approx(gapbeam.solve(half).at(0.3).moment, rel=1e-13)
    path = gapbeam.solve({**scene, "analysis": {"follow": "events"}})
    assert path.at(0.3).moment == pytest.approx(steps.at(0.3).moment, rel=1e-12)
    assert len(path.events) == 1
    at = path.events[0].factor
    assert path.at(0.5, factor=at).deflection == pytest.approx(0.012, rel=1e-9)
    cases = gapbeam.prepare(scene).solve([[0.5, 0.5, 0.5], [1.0, 1.0, 1.0]])
    assert cases.at(0.3).moment == pytest.approx([float(steps.at(0.3, factor=one).moment) for one in (0.5, 1.0)], rel=1e-13)
    assert math.isfinite(path.at(0.1).transverse)


def test_a_thread_is_refused():
    """Series would cross it in half a million steps."""
    thread = {**simple(1.0, 0.0, 0.0), "beam": {"spans": [1.0], "EI": 1e-12}}
    with pytest.raises(gapbeam.GapbeamError, match=r"500000 sqrt\(EI/N\).*give a greater EI"):
        gapbeam.solve(thread)
