"""Links that hold both ways and yield, beside springs with sliders moved step by step in rational numbers."""

import itertools
import random
from fractions import Fraction

import gapbeam
import numpy as np
import pytest
from scenes import at, force, scene

EVENTS = {"follow": "events"}


def solve(spans, supports, loads, history, EI):
    return gapbeam.solve({**scene(spans, supports, loads, EI=EI), "analysis": EVENTS | {"history": history}})


def link(node, law, **keys):
    return at(node, law=law, unloading="plastic", **keys)


class Sliders:
    """A simple beam on links at its inner nodes, each springs with sliders side by side; all in rational numbers.

    Parameters
    ----------
    spans, EI, laws, live, dead
        Of the beam, of the links, and the forces at the inner nodes.
    """

    def __init__(self, spans, EI, laws, live, dead):
        end = sum(map(Fraction, spans))
        x = list(itertools.accumulate(map(Fraction, spans)))[:-1]
        self.live, self.dead = live, dead
        self.soft = [[self._influence(a, b, end) / Fraction(EI) for b in x] for a in x]
        self.last, self.sliders = [], []  # slope that stays; (link, stiffness, limit)
        for k, law in enumerate(laws):
            points = [(Fraction(0), Fraction(0)), *((Fraction(d), Fraction(f)) for d, f in law)]
            slopes = [(b[1] - a[1]) / (b[0] - a[0]) for a, b in itertools.pairwise(points)]
            self.last.append(slopes[-1])
            for i, (one, two) in enumerate(itertools.pairwise(slopes)):
                if one > two:
                    self.sliders.append((k, one - two, (one - two) * points[i + 1][0]))
        self.slip = [Fraction(0)] * len(self.sliders)
        self.w = [Fraction(0)] * len(x)

    @staticmethod
    def _influence(a, b, end):
        a, b = min(a, b), max(a, b)
        return a * (end - b) * (2 * end * b - b * b - a * a) / (6 * end)

    def forces(self):
        """Reactions of the links."""
        found = [slope * w for slope, w in zip(self.last, self.w, strict=True)]
        for (k, stiffness, _), slip in zip(self.sliders, self.slip, strict=True):
            found[k] += stiffness * (self.w[k] - slip)
        return found

    def rates(self, load, sliding):
        """Deflections over the load while some sliders slide."""
        n = len(self.w)
        slope = list(self.last)
        for j, (k, stiffness, _) in enumerate(self.sliders):
            if j not in sliding:
                slope[k] += stiffness
        rows = [[Fraction(i == j) + self.soft[i][j] * slope[j] for j in range(n)] for i in range(n)]
        right = [sum(f * p for f, p in zip(row, load, strict=True)) for row in self.soft]
        for i in range(n):
            for j in range(i + 1, n):
                ratio = rows[j][i] / rows[i][i]
                rows[j] = [b - ratio * a for a, b in zip(rows[i], rows[j], strict=True)]
                right[j] -= ratio * right[i]
        v = [Fraction(0)] * n
        for i in range(n - 1, -1, -1):
            v[i] = (right[i] - sum(rows[i][j] * v[j] for j in range(i + 1, n))) / rows[i][i]
        return v

    def go(self, load, way):
        """Add a load step by step; shares of it at which a slider begins or ends to slide."""
        done, changes, before = Fraction(0), [], None
        while done < way:
            pulled = [stiffness * (self.w[k] - slip) for (k, stiffness, _), slip in zip(self.sliders, self.slip, strict=True)]
            full = [j for j, (_, _, limit) in enumerate(self.sliders) if abs(pulled[j]) == limit]
            for count in range(len(full), -1, -1):
                fitting = [
                    (set(sliding), v)
                    for sliding in itertools.combinations(full, count)
                    for v in [self.rates(load, sliding)]
                    if all((v[self.sliders[j][0]] * pulled[j] >= 0) == (j in sliding) or v[self.sliders[j][0]] == 0 for j in full)
                ]
                if fitting:
                    break
            sliding, v = fitting[0]
            if before is not None and sliding != before:
                changes.append(done)
            before = sliding
            step = way - done
            for j, (k, stiffness, limit) in enumerate(self.sliders):
                rate = stiffness * v[k]
                if j not in sliding and rate:
                    room = ((limit if rate > 0 else -limit) - pulled[j]) / rate
                    if room > 0:
                        step = min(step, room)
            self.w = [w + step * one for w, one in zip(self.w, v, strict=True)]
            for j in sliding:
                self.slip[j] += step * v[self.sliders[j][0]]
            done += step
        return changes


def test_cycles_close():
    """A link 1e4 that yields at 30 in the middle of a beam, under 100 to and fro: work of a leg 4.68, then 9.27 (by hand)."""
    law = [[0.003, 30.0], [1.0, 30.0]]
    result = solve([3.0, 3.0], [at(0), link(1, law), at(2)], [force(3.0, 100.0)], [1.0, -1.0, 1.0, -1.0], 2000.0)
    assert [one.event for one in result.events] == ["yields", *["unloads", "yields"] * 3]
    assert result.events[0].factor == pytest.approx(0.94 / 3.0, rel=1e-14)
    places = [(step.deflection[1], step.reaction[1]) for step in result.steps]
    work = [0.5 * (b[1] + a[1]) * (b[0] - a[0]) for a, b in itertools.pairwise([(0.0, 0.0), *places])]
    assert work[0] + work[1] == pytest.approx(4.68, rel=1e-13)
    assert [work[k] + work[k + 1] for k in (2, 4, 6)] == pytest.approx([9.27] * 3, rel=1e-13)


def test_it_yields_back():
    """Unloaded to 0, a link 100 that yielded at 1 under 4 yields the other way: w = 1/48 EI."""
    result = solve([0.5, 0.5], [at(0), link(1, [[0.01, 1.0], [1.0, 1.0]]), at(2)], [force(0.5, 4.0)], [1.0, 0.0], 1.0)
    assert result.state(0.0).deflection[1] == pytest.approx(1.0 / 48.0, rel=1e-14)
    assert result.state(0.0).reaction[1] == pytest.approx(-1.0, rel=1e-14)


@pytest.mark.parametrize("seed", range(120))
def test_random_histories(seed):
    rng = random.Random(seed)
    spans = [rng.randint(4, 24) / 8 for _ in range(rng.randint(2, 4))]
    n, EI = len(spans) - 1, float(rng.choice((64, 500, 4096)))
    laws = []
    for _ in range(n):
        places = sorted(rng.sample(range(1, 40), rng.randint(2, 5)))
        slopes = sorted((rng.randint(1, 64) for _ in places), reverse=True)
        slopes[-1] = rng.choice((0, slopes[-1]))
        points, d, f = [], 0, 0
        for place, slope in zip(places, slopes, strict=True):
            f += slope * (place - d)
            d = place
            points.append([d / 256.0, float(f)])
        laws.append(points)
    live = [rng.randint(-200, 200) * 4 for _ in range(n)]
    if rng.random() < 0.3:  # links that yield together
        spans, laws, live = [spans[0]] * (n + 1), [laws[0]] * n, [live[0] or 4] * n
    dead = [rng.choice((0, 0, rng.randint(-100, 100))) for _ in range(n)]
    history = [rng.randint(-16, 16) / 8 for _ in range(rng.randint(2, 6))]
    history = [one for one, before in zip(history, [0.0, *history], strict=False) if one != before] or [1.0]
    ends = list(itertools.accumulate(spans))
    rows = (("live", live), ("dead", dead))
    loads = [force(x, float(p), case=case) for case, row in rows for x, p in zip(ends, row, strict=False) if p]
    supports = [at(0), *(link(k + 1, law) for k, law in enumerate(laws)), at(n + 1)]
    result = solve(spans, supports, loads, history, EI)
    exact = Sliders(spans, EI, laws, live, dead)
    exact.go(list(map(Fraction, dead)), 1)
    factor, kinks, far = Fraction(0), [], Fraction(1, 10**6)
    for leg, goal in enumerate(map(Fraction, history)):
        way = 1 if goal > factor else -1
        changes = exact.go([way * Fraction(p) for p in live], abs(goal - factor))
        kinks += [(leg, float(factor + way * one)) for one in changes]
        factor = goal
        step = result.state(float(goal), leg)
        far, size = max(far, *map(abs, exact.w)), max(map(abs, (*exact.forces(), *live)))
        assert list(step.deflection[1:-1]) == pytest.approx(list(map(float, exact.w)), abs=float(1e-12 * far))
        assert list(step.reaction[1:-1]) == pytest.approx(list(map(float, exact.forces())), abs=float(1e-12 * size))
    found = sorted({round(one.factor, 10) for one in result.events} - set(history) - {0.0})
    true = sorted({round(one, 10) for _, one in kinks} - set(history) - {0.0})
    assert found == true


def polyline(rng):
    """A law that softens from piece to piece."""
    count, points, d, f, slope = rng.choice([1, 2, 2, 3]), [], 0.0, 0.0, rng.choice([500.0, 1000.0, 3000.0])
    for _ in range(count):
        width = rng.choice([0.004, 0.01, 0.02])
        d, f = d + width, f + slope * width
        points.append([round(d, 9), round(f, 9)])
        slope *= rng.choice([0.1, 0.3, 0.5])
    return [*points, [d + 1.0, f + (slope if rng.random() < 0.7 else 0.0)]]


def mixed_scene(rng):
    """A beam on plastic links of one side and of both, springs and bearings, and a history."""
    count, equal, supports = rng.choice([2, 3, 4, 6, 10, 25, 60]), rng.random() < 0.2, []
    for i in range(count + 1):
        kind, one = rng.random(), {"node": i}
        if kind < 0.55:
            one |= {"side": "both", "law": polyline(rng), "unloading": "plastic"}
        elif kind < 0.7:
            side = rng.choice(["below", "above"])
            one |= {"side": side, "law": polyline(rng), "unloading": "plastic", "gap": rng.choice([0.0, 0.003])}
        elif kind < 0.85:
            one |= {"side": "both", "stiffness": rng.choice([200.0, 2000.0])}
        else:
            one |= {"side": rng.choice(["below", "both"])}
        if rng.random() < 0.1:
            one["settlement"] = rng.choice([-0.005, 0.005])
        supports.append(one)
    if rng.random() < 0.5:
        supports[0] = {"node": 0, "rotation": "fixed"}
    loads = [{"type": "force", "node": i, "F": 20.0 if equal else rng.uniform(-30.0, 40.0)}
             for i in range(count + 1) if rng.random() < 0.6] or [{"type": "uniform", "q": 5.0}]  # fmt: skip
    if rng.random() < 0.3:
        loads.append({"type": "uniform", "q": rng.uniform(1.0, 6.0), "case": "dead"})
    history = [1.0, *(rng.choice([-1.0, 0.0, 0.5, 1.0, -0.5, 1.5]) for _ in range(rng.randint(1, 5)))]
    return {"beam": {"spans": [1.0] * count, "EI": rng.choice([5.0, 50.0, 500.0])}, "supports": supports, "loads": loads}, history


@pytest.mark.parametrize("seed", [*range(20), 588])
def test_stops_on_the_way_change_nothing(seed):
    """Between the ends of legs links slide and turn back by local updates; where a leg begins all of the beam is solved."""
    scene, ends = mixed_scene(random.Random(seed))
    stops, numbers = [], []
    for start, stop in itertools.pairwise([0.0, *ends]):
        stops += [start + (stop - start) * share for share in (0.31, 0.52, 0.77, 0.89, 1.0) if stop != start or share == 1.0]
        numbers.append(len(stops) - 1)
    once, often = (gapbeam.solve(scene | {"analysis": {"history": history, "follow": "events"}}) for history in (ends, stops))
    assert once.status == often.status
    if once.status != "solved":
        return
    for leg, number in enumerate(numbers):
        if ends[leg] == ([0.0, *ends])[leg]:
            continue
        for k in range(number - 4, number + 1):
            one, other = once.state(stops[k], leg=leg), often.state(stops[k], leg=k)
            for name in ("reaction", "deflection"):
                values = getattr(one, name)
                assert np.abs(values - getattr(other, name)).max() <= 1e-11 * max(1e-6, np.abs(values).max()), (leg, stops[k])


def test_what_does_not_move_does_not_unload():
    """Where the load presses the beam on a rigid stop, a yielding link beside it stands still: it keeps the piece that it has."""
    plastic = {"node": 1, "side": "both", "law": [[0.004, 4.0], [1.004, 104.0]], "unloading": "plastic", "settlement": 0.005}
    other = {"node": 3, "side": "above", "law": [[0.02, 20.0], [1.02, 520.0]], "unloading": "plastic", "gap": 0.003}
    below = [{"node": 2, "side": "below"}, {"node": 4, "side": "below"}]
    supports = [{"node": 0, "rotation": "fixed"}, *below, plastic, other]
    result = gapbeam.solve({"beam": {"spans": [1.0] * 4, "EI": 5.0}, "supports": supports,
                            "loads": [{"type": "force", "node": 2, "F": 20.0}],
                            "analysis": {"follow": "events", "history": [1.5, -1.0, 1.0]}})  # fmt: skip
    its = [(one.event, one.factor < 0.0) for one in result.events if one.support == 3]
    assert its[-2:] == [("unloads", True), ("yields", True)]
    still = [result.state(factor, leg=2) for factor in (0.1, 1.0)]
    assert still[0].deflection[3] == pytest.approx(still[1].deflection[3], rel=1e-14)
    assert still[0].state[3] == "branch 2"


@pytest.mark.parametrize("seed", [105, 171, 225, 370])
def test_one_that_hardly_moves_turns_back_and_yields_again_at_its_factor(seed):
    """Far from what makes it turn; in units in which all is rounded otherwise the factor was another one, by up to 3e-4."""

    def row(unit):
        rng, count, supports = random.Random(seed), 22, [at(0)]
        for i in range(1, count + 1):
            d, slope, harder = rng.randint(1, 4) / 1024, rng.randint(500, 2000) * unit, rng.randint(100, 400) * unit
            supports.append(link(i, [[d, slope * d], [1.0 + d, slope * d + harder]], side="below"))
        dead = [{"type": "uniform", "q": 0.5 * unit, "case": "dead"}, {**force(19.0, 8.0 * unit), "case": "dead"}]
        loads = dead + [force(x, rng.randint(-4, 12) * unit) for x in (1.5, 2.5, 4.0)]
        return solve([1.0] * count, supports, loads, [1.0], 8.0 * unit).events

    one, other = row(1.0), row(3.0)
    assert [(event.support, event.event) for event in one] == [(event.support, event.event) for event in other]
    assert [event.factor for event in one] == pytest.approx([event.factor for event in other], rel=1e-12)


def test_solves_do_not_grow_with_the_links():
    """Two for the beginning, four where a leg begins: events between take local updates, however many links there are."""
    for count in (40, 120):
        rng = random.Random(count)
        laws = [[[d, 1000.0 * d], [1.0 + d, 1000.0 * d + 100.0]] for d in (rng.uniform(0.005, 0.015) for _ in range(count))]
        loads = [force(float(i), rng.uniform(5.0, 15.0)) for i in range(count)]
        result = solve([1.0] * (count - 1), [link(i, law) for i, law in enumerate(laws)], loads, [1.0, -1.0, 1.0, -1.0], 100.0)
        assert len(result.events) > 3 * count
        assert result.solves == 2 + 4 * 4


def test_solves_where_breakpoints_have_become_one():
    """Events took solves of the whole beam once a law had turned back beyond its second breakpoint."""
    rng, law = random.Random(1), [[0.001, 3.0], [0.002, 5.0], [0.004, 7.0], [0.008, 9.0], [1.0, 40.0]]
    supports = [link(i, law, side="below", gap=rng.uniform(0.0, 0.002)) for i in range(80)]
    dead = {"type": "uniform", "q": 0.5, "case": "dead"}
    loads = [dead, *(force(rng.uniform(0.0, 79.0), 15.0) for _ in range(8))]
    result = solve([1.0] * 79, supports, loads, [1.0, 0.0, 1.2], 100.0)
    assert result.solves < len(result.events) / 3


def test_a_brake_that_does_not_yield_comes_to_rest():
    """Rounding of the way back was an axial force of 1e-34, and pictures drew it."""
    result = gapbeam.solve({
        "beam": {"spans": [4.0, 4.0], "EI": 2000.0, "EA": 1e5, "alpha": 1e-5},
        "supports": [{"node": 0}, {"node": 1, "law": [[0.003, 30.0], [0.02, 45.0]], "unloading": "plastic"}, {"node": 2},
                     {"node": 0, "direction": "axial", "law": [[0.0005, 20.0], [0.003, 25.0]], "unloading": "plastic"},
                     {"node": 2, "direction": "axial", "stiffness": 2e3}],
        "loads": [{"type": "force", "x": 4.0, "F": 100.0}, {"type": "temperature", "dT": 60.0}],
        "analysis": {"follow": "events", "history": [1.0, -1.0, 1.0, 0.0]},
    })  # fmt: skip
    assert all(result.at(1.0, factor=0.0, leg=leg).axial_force == 0.0 for leg in (1, 2, 3))
    assert result.steps[-1].reaction[3:].tolist() == [0.0, 0.0]
    assert result.steps[-1].deflection[1] > 0.02
