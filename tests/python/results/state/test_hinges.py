"""Hinges with a stiffness, beside closed forms and a stiffness method in rational numbers."""

import itertools
import json
import random
from fractions import Fraction

import gapbeam
import pytest
from mpmath import mp, mpf
from oracle.axial_chain import eliminate
from oracle.axial_ground import solve_on_ground
from scenes import at, force


def scene(spans, hinges, supports, loads, EI=100.0, **keys):
    return {"beam": {"spans": spans, "EI": EI}, "hinges": hinges, "supports": supports, "loads": loads} | keys


class Frame:
    """A beam of bending elements between nodes, with two rotations where a hinge is; all in rational numbers.

    Parameters
    ----------
    x, EI
        Places of the nodes, bending stiffness.
    hinges : dict of Fraction
        Stiffness of the hinge at some nodes.
    springs : dict of Fraction or None
        Stiffness of the supports that act at some nodes, None where they are rigid.
    forces : dict of Fraction
        Forces at some nodes, down.
    """

    def __init__(self, x, EI, hinges, springs, forces):
        self.x, self.hinges = x, hinges
        count = len(x)
        self.left = list(range(count, 2 * count))
        self.right = list(self.left)
        for k, node in enumerate(hinges):
            self.right[node] = 2 * count + k
        size = 2 * count + len(hinges)
        rows, load = [[Fraction(0)] * size for _ in range(size)], [Fraction(0)] * size
        for i, length in enumerate(b - a for a, b in itertools.pairwise(x)):
            where = [i, self.right[i], i + 1, self.left[i + 1]]
            a, b, c = 12 * EI / length**3, 6 * EI / length**2, 2 * EI / length
            element = [[a, b, -a, b], [b, 2 * c, -b, c], [-a, -b, a, -b], [b, c, -b, 2 * c]]
            for p, row in zip(where, element, strict=True):
                for q, value in zip(where, row, strict=True):
                    rows[p][q] += value
        for node, stiffness in hinges.items():
            p, q = self.left[node], self.right[node]
            for one, other in ((p, q), (q, p)):
                rows[one][one] += stiffness
                rows[one][other] -= stiffness
        for node, value in forces.items():
            load[node] += value
        full = [list(row) for row in rows]
        for node, stiffness in springs.items():
            if stiffness is None:
                rows[node], load[node] = [Fraction(j == node) for j in range(size)], Fraction(0)
            else:
                rows[node][node] += stiffness
        self.u = eliminate(rows, load)
        if self.u is not None:
            inside = [sum(a * b for a, b in zip(row, self.u, strict=True)) for row in full]
            self.reaction = {node: forces.get(node, Fraction(0)) - inside[node] for node in springs}

    def moment(self, node):
        """Moment at a hinge, sagging; rotations here are dw/dx, positive clockwise."""
        return self.hinges[node] * (self.u[self.left[node]] - self.u[self.right[node]])


def random_beam(draw):
    x = [Fraction(0), *itertools.accumulate(Fraction(draw.choice([1, 2, 3]), 2) for _ in range(draw.randint(4, 7)))]
    inner = draw.sample(range(1, len(x) - 1), draw.randint(1, 2))
    hinges = {node: Fraction(draw.choice(["1/1000", "1", "50", "3000", "1000000"])) for node in inner}
    held = sorted({0, len(x) - 1, *draw.sample(range(len(x)), 2)})
    one_sided = {node for node in held if draw.random() < 0.5}
    springs = {node: None if draw.random() < 0.6 else Fraction(draw.choice([20, 500])) for node in held}
    forces = {node: Fraction(draw.randint(-20, 30)) for node in draw.sample(range(len(x)), 3)}
    return x, hinges, springs, one_sided, forces


@pytest.mark.parametrize("seed", range(150))
def test_beside_a_stiffness_method_in_rationals(seed):
    """Reactions, deflections, moments at the hinges and their rotations, with the schemes tried one by one."""
    x, hinges, springs, one_sided, forces = random_beam(random.Random(seed))
    found = []
    for acting in itertools.product((True, False), repeat=len(one_sided)):
        open_ones = {node for node, acts in zip(sorted(one_sided), acting, strict=True) if not acts}
        frame = Frame(x, Fraction(100), hinges, {n: k for n, k in springs.items() if n not in open_ones}, forces)
        if frame.u is None:
            continue
        if all(frame.reaction[node] >= 0 for node in one_sided - open_ones) and all(frame.u[node] <= 0 for node in open_ones):
            found.append(frame)
    supports = [
        at(None, x=float(x[node]), side="below" if node in one_sided else "both", **({} if k is None else {"stiffness": float(k)}))
        for node, k in springs.items()
    ]
    tables = [{"x": float(x[node]), "stiffness": float(c)} for node, c in hinges.items()]
    loads = [force(float(x[node]), float(value)) for node, value in forces.items() if value]
    result = gapbeam.solve(scene([float(x[-1])], tables, supports, loads))
    if not found:
        assert result.status != "solved"
        return
    frame, step = found[0], result.steps[-1]
    largest = max(abs(float(value)) for value in frame.reaction.values()) or 1.0
    for node, reaction in zip(springs, step.reaction, strict=True):
        assert reaction == pytest.approx(float(frame.reaction.get(node, 0)), abs=1e-12 * largest)
    deep = max(abs(float(frame.u[node])) for node in range(len(x)))
    w = result.at([float(place) for place in x]).deflection
    assert w == pytest.approx([float(u) for u in frame.u[: len(x)]], abs=1e-11 * deep)
    for state, node in zip(step.hinges, sorted(hinges), strict=True):
        assert state.x == float(x[node])
        assert state.moment == pytest.approx(float(frame.moment(node)), abs=1e-12 * largest * float(x[-1]))
        turned = frame.u[frame.left[node]] - frame.u[frame.right[node]]
        assert state.rotation == pytest.approx(float(turned), abs=1e-11 * deep)
        sides = [result.at([state.x], side=side).rotation[0] for side in ("left", "right")]
        assert sides[0] - sides[1] == pytest.approx(float(turned), abs=1e-11 * deep)
    # Extremes of the rotation are on either side of a hinge, too
    rotations = [float(frame.u[k]) for k in (*frame.left, *frame.right)]
    assert result.extremes["rotation"]["max"].value >= max(rotations) - 1e-11 * deep
    assert result.extremes["rotation"]["min"].value <= min(rotations) + 1e-11 * deep


def test_semi_rigid_ends():
    """M = (q L^2/12)/(1 + 2 EI/(c L)) by restraints of the supports; a hinge in the middle of a clamped beam."""
    span, q, EI, c = 4.0, 3.0, 100.0, 60.0
    expected = q * span**2 / 12 / (1 + 2 * EI / (c * span))
    by_supports = gapbeam.solve(scene([span], [], [at(0, rotation=c), at(1, rotation=c)], [{"type": "uniform", "q": q}]))
    assert by_supports.at([0.0]).moment[0] == pytest.approx(-expected, rel=1e-13)
    middle = gapbeam.solve(scene([2.0, 2.0], [{"node": 1, "stiffness": c}], [at(0, rotation="fixed"), at(2, rotation="fixed")], [
        {"type": "uniform", "q": q}]))  # fmt: skip
    assert middle.steps[-1].hinges[0].moment == pytest.approx(q * span**2 / 24 / (1 + EI / (c * span)), rel=1e-13)


@pytest.mark.parametrize(("stiffness", "like"), [(0.0, "free"), (2e-9, "free"), (1e30, "none")])
def test_between_a_free_hinge_and_none(stiffness, like):
    supports, loads = [at(0), at(1), at(2, rotation="fixed")], [{"type": "uniform", "q": 2.0}, force(1.0, 5.0)]
    made = gapbeam.solve(scene([3.0, 2.0], [{"x": 4.0, "stiffness": stiffness}], supports, loads))
    beside = scene([3.0, 2.0], [], supports, loads)
    if like == "free":
        beside["beam"]["hinges"] = [4.0]
    assert made.steps[-1].reaction == pytest.approx(gapbeam.solve(beside).steps[-1].reaction, rel=1e-9)


@pytest.mark.parametrize("c", [0.1, 3.0, 1e3])
def test_a_strut_with_a_joint_buckles_as_its_closed_form_says(c):
    """Two halves that bend as sines: tan(k L/2) = 2 c/(k EI), and k L = 2 pi, where the joint does not turn."""
    strut = scene([3.0], [{"x": 1.5, "stiffness": c}], [at(0), at(1)], [force(1.0, 1.0)], EI=10.0)
    strut["beam"]["N"] = -0.01
    with mp.workdps(30):
        ends = mpf("1e-2"), mp.pi / 3
        k = mp.findroot(lambda k: 10 * k * mp.sin(1.5 * k) - 2 * c * mp.cos(1.5 * k), ends, solver="anderson")
        expected = [float(10 * k**2 / mpf(0.01)), float(10 * (2 * mp.pi / 3) ** 2 / mpf(0.01))]
    assert gapbeam.solve({**strut, "analysis": {"buckling": 2}}).buckling == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize("side", ["below", "above"])
@pytest.mark.parametrize("stiffness", [1e-3, 50.0, 1e6])
def test_over_one_sided_ground(side, stiffness):
    """Beside an independent solution in 90 digits: reactions, ends of contact, and what the hinges do."""
    ground = {"k": 300.0, "side": side, "gap": 1e-3}
    loads = [force(0.5, 4.0), force(3.5, -6.0), {"type": "uniform", "q": 2.0 if side == "below" else -2.0}]
    made = scene([3.0, 2.0], [{"x": 1.0, "stiffness": stiffness}, {"x": 4.25, "stiffness": stiffness}], [at(1)], loads)
    made["foundation"] = [ground]
    (exact, zones), step = solve_on_ground(made), gapbeam.solve(made).steps[-1]
    assert step.reaction == pytest.approx([float(value) for value in exact.reaction], rel=1e-13)
    found = [x for zone in step.contact for x in (zone.from_, zone.to)]
    assert found == pytest.approx([float(x) for zone in zones[0] for x in zone], rel=1e-12)
    for hinge in step.hinges:
        left, right = (exact.at(hinge.x, way) for way in ("left", "right"))
        assert hinge.moment == pytest.approx(float(left.moment), rel=1e-12)
        assert hinge.rotation == pytest.approx(float(left.rotation - right.rotation), rel=1e-11)


def test_events_and_combinations_know_them():
    hinges, supports = [{"x": 5.0, "stiffness": 6e3}, {"x": 7.0, "stiffness": 6e3}], [at(0, side="below"), at(1), at(2)]
    loads = [{"type": "uniform", "q": 1.5, "case": "dead"}, {"type": "uniform", "q": 30.0, "from": 6.0, "to": 12.0}]
    followed = gapbeam.solve(scene([6.0, 6.0], hinges, supports, loads, EI=2.4e4, analysis={"follow": "events"}))
    (event,) = followed.path.events
    below, above = (gapbeam.solve(scene([6.0, 6.0], hinges, supports, [loads[0], loads[1] | {"q": 30.0 * f}], EI=2.4e4))
                    for f in (event.factor * (1 - 1e-9), event.factor * (1 + 1e-9)))  # fmt: skip
    assert (below.steps[-1].state[0], above.steps[-1].state[0]) == ("closed", "open")
    together = gapbeam.solve(scene([6.0, 6.0], hinges, supports, loads, EI=2.4e4,
                                   combinations=[{"name": "all", "factors": {"dead": 1.0, "live": 1.0}}]))  # fmt: skip
    assert together.combinations["all"].steps[-1].reaction == pytest.approx(followed.steps[-1].reaction, rel=1e-13)
    cases = gapbeam.prepare(scene([6.0, 6.0], hinges, supports, loads, EI=2.4e4)).solve([[1.0, 0.5], [1.0, 1.0]])
    assert cases.reaction[1] == pytest.approx(followed.steps[-1].reaction, rel=1e-13)


@pytest.mark.parametrize(
    ("hinge", "keys", "message"),
    [
        ({"x": 1.0, "stiffness": -1.0}, {}, r"hinges\[0\].stiffness: expected a finite number, 0 or more, got -1"),
        ({"x": 0.0, "stiffness": 1.0}, {}, r"hinges\[0\]: x = 0 is an end of the beam"),
        ({"node": 7, "stiffness": 1.0}, {}, r"hinges\[0\].node: there is no node 7; the nodes of the beam are 0 to 2"),
        ({"node": -1, "stiffness": 1.0}, {}, r"hinges\[0\].node: there is no node -1"),
        ({"stiffness": 1.0}, {}, r"hinges\[0\]: its position is missing; give node or x"),
        ({"x": 1.0, "stiffness": 1e-10}, {}, r"hinges\[0\].stiffness: it is so far below EI/length of the beam that it is a free"),
        ({"x": 9.0, "stiffness": 1.0}, {}, r"hinges\[0\].x: 9 is outside the beam"),
        ({"x": 1.0, "stiffness": 1.0}, {"EI": float("inf")}, "the beam is rigid beside it"),
        ({"x": 1.0, "stiffness": 1.0}, {"loads": [{"type": "moment", "x": 1.0, "M": 1.0}]}, "acts exactly at the hinge"),
    ],
)
def test_refusals(hinge, keys, message):
    made = scene([3.0, 2.0], [hinge], [at(0), at(1), at(2)], [force(1.0, 5.0)])
    if "EI" in keys:
        made["beam"]["EI"] = keys.pop("EI")
    with pytest.raises(gapbeam.SceneError, match=message):
        gapbeam.solve(made | keys)


def test_two_at_a_place_are_refused():
    hinges = [{"x": 1.0, "stiffness": 1.0}, {"x": 1.0, "stiffness": 2.0}]
    with pytest.raises(gapbeam.SceneError, match=r"hinges\[1\]: at x = 1 there is a hinge already"):
        gapbeam.solve(scene([3.0], hinges, [at(0), at(1)], [force(1.0, 5.0)]))


def test_report_json_proof_and_picture(tmp_path):
    made = scene([3.0, 2.0], [{"x": 4.0, "stiffness": 50.0}], [at(0), at(1), at(2, rotation="fixed")], [force(1.0, 5.0)])
    result = gapbeam.solve(made)
    assert "Hinges with a stiffness" in result.report()
    (hinge,) = json.loads(result.to_json())["steps"][-1]["hinges"]
    assert hinge["rotation"] == pytest.approx(hinge["moment"] / 50.0)
    result.plot(tmp_path / "one.svg")
    result.to_html(tmp_path / "one.html")
    assert gapbeam.Hinge(x=4.0, stiffness=50.0) == result.scene.hinges[0]
