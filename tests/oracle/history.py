"""Exact histories of load factors with supports that do not go back the way they came, in rational numbers.

At any time such a support has a polyline of its own: back from the point it has got to, on along its law. It is made
anew after every step of the path, and the ways on are those of `cells.py`; so between two events everything
is linear, and nothing is stepped.

What the documents leave open is read as follows.

* "plastic" (one-sided laws whose first piece is the steepest, no falling pieces): back along a line parallel to the
  first piece down to force 0 (there is the set), then a gap opens; again forward along the same line to the point
  left, then along the law. With a vertical first piece the line back is vertical, too.
* "broken" (laws with one vertical drop to 0): back along the law as long as the bottom of the drop has not been
  reached; from then on the support never acts again.
* Dead loads first, then the factors of the history in turn; the path goes through limits ("follow"), so a
  support that breaks sheds its force while the load goes back, and the leg ends where its factor is reached from the
  side of its beginning.
"""

from dataclasses import dataclass, field
from fractions import Fraction

from .cells import Problem
from .curves import ONE, ZERO, Curve
from .laws import Segment, first, make_state


@dataclass
class History:
    """A history; `status` is "solved", "mechanism", "ray", "end", "loose" or "heals" (a support that
    has shed part of its force in a drop would get it back, because others broke meanwhile: no meaning is given to that).

    Attributes
    ----------
    steps : list of State
        One at the end of every leg that was reached, without that of the dead loads.
    sets : list of list of Fraction
        Set of every support of `Problem.which` at these steps (0 for elastic ones), to its side.
    broken : list of list of bool
    segments : list of Segment
        `leg` is 0 for the dead loads, then the number of the factor in the history from 1; `rate` that of the leg.
    """

    problem: Problem = field(repr=False)
    status: str = "solved"
    steps: list = field(default_factory=list)
    sets: list = field(default_factory=list)
    broken: list = field(default_factory=list)
    segments: list = field(default_factory=list)


class Elastic:
    """A support that goes back along its law: its curve never changes."""

    set, broken = ZERO, False

    def __init__(self, curve):
        self.curve = curve

    def moved(self, place):
        """Take note of the place got to on the present curve; returns it on the new one."""
        return place


class Plastic(Elastic):
    """A support that goes back parallel to the first piece of its law, `virgin`."""

    def __init__(self, curve):
        super().__init__(curve)
        self.virgin = curve
        slopes = [curve.slope(k) for k in range(1, curve.last + 1)]
        if slopes != sorted(slopes, reverse=True) or slopes[-1] < 0 or curve.labels[0] != 0:
            raise ValueError("plastic unloading: one-sided laws with decreasing slopes only")

    def moved(self, place):
        """Make the line back where the support has gone beyond the end of it."""
        k, t = place
        if k < 2 or t == 0:
            return place
        label, virgin = self.curve.labels[k], self.virgin
        d, r = self.curve.at(place)
        u, v = virgin.pieces[1][1]
        self.set = d - r * u / v - virgin.pieces[1][0][0]
        ahead = [virgin.pieces[j][0] for j in range(label + 1, virgin.last + 1)]
        labels = [label, *range(label + 1, virgin.last + 1)]
        if ahead and ahead[0] == (d, r):
            ahead, labels = ahead[1:], labels[1:]
        points = [(d - r * u / v, ZERO), (d, r), *ahead]
        self.curve = Curve(points, (ONE, ZERO), virgin.pieces[-1][1], [0, 1, *labels])
        return 1, ONE


class Brittle(Elastic):
    """A support that never acts again once it has dropped to 0."""

    def __init__(self, curve):
        super().__init__(curve)
        drops = [k for k in range(1, curve.last) if curve.slope(k) < 0]
        if len(drops) != 1 or curve.slope(drops[0]) != float("-inf") or curve.at((drops[0], ONE))[1]:
            raise ValueError("broken: laws with one vertical drop to 0 only")
        self.drop = drops[0]

    def heals(self, k, rate):
        """Whether the support gets back force it has shed already."""
        return not self.broken and k == self.drop and rate < 0

    def moved(self, place):
        """Lay the support aside at the bottom of its drop."""
        k, t = place
        if self.broken or k < self.drop or (k == self.drop and t < 1):
            return place
        d, label = self.curve.at(place)[0], self.curve.labels[-1]
        self.curve, self.broken = Curve([(d, ZERO)], (ONE, ZERO), (ONE, ZERO), [label, label]), True
        return 1, ZERO


KINDS = {"elastic": Elastic, "plastic": Plastic, "broken": Brittle}


def supports_of(problem):
    """The supports of `Problem.which` with what they remember."""
    chosen = [problem.scene["supports"][i] for i in problem.which]
    kinds = [KINDS[s.get("unloading", "elastic") if "law" in s else "elastic"] for s in chosen]
    return [kind(curve) for kind, curve in zip(kinds, problem.curves, strict=True)]


def history(scene, factors=None, most=2000):
    """Go through a history of load factors.

    Parameters
    ----------
    scene : dict or Problem
    factors : list of float, optional
        Default: `analysis.history` of the scene, else [1.0].
    most : int
        Segments after which it gives up.

    Returns
    -------
    History
    """
    problem = scene if isinstance(scene, Problem) else Problem(scene)
    if factors is None:
        factors = problem.scene.get("analysis", {}).get("history", [1.0])
    found, supports = History(problem), supports_of(problem)
    places = [support.curve.find(ZERO, ZERO) for support in supports]
    now = ZERO
    for leg, target in enumerate([None, *map(Fraction, factors)]):
        size = ONE if leg == 0 else target - now
        load = [size * g for g in problem.g[leg > 0]]
        if any(load):
            places = run(found, supports, places, load, (leg, now, size), most)
            if found.status != "solved":
                return found
        if leg:
            now = target
            state = make_state(problem, [s.curve for s in supports], places, now, 1)
            found.steps.append(state)
            found.sets.append([s.set for s in supports])
            found.broken.append([s.broken for s in supports])
    return found


def run(found, supports, places, load, leg, most):
    """Go through one leg (number, first factor, change of the factor); returns the places at its end."""
    problem, part, back = found.problem, ZERO, None
    number, start, size = leg
    while part < 1:
        curves = [support.curve for support in supports]
        ways, loose = problem.ways(places, load, back, curves)
        if back is None:
            ways = problem.starts(ways, load)
        way = first(ways, back is None, 1) if ways else None
        if way is None or (loose and (way.index or way.rate <= 0)) or len(found.segments) >= most:
            found.status = "loose" if loose else "end"
            return places
        if any(
            isinstance(s, Brittle) and s.heals(*pair)
            for s, *pair in zip(supports, way.pieces, way.rates, strict=True)
        ):
            found.status = "heals"
            return places
        parts = list(zip(curves, way.pieces, way.places, way.rates, strict=True))
        lengths = [
            curve.room(k, t, x) / abs(x) for curve, k, t, x in parts if x and curve.room(k, t, x) is not None
        ]
        if way.rate > 0:
            lengths.append((ONE - part) / way.rate)
        here = state_on(problem, curves, way, ZERO, (number, start + part * size))
        sign = (way.rate > 0) - (way.rate < 0)
        found.segments.append(Segment(number, here, None, sign, way.index, way.drops, way.null, way))
        if not lengths:
            found.status = "ray" if way.rate else "mechanism"
            return places
        step = min(lengths)
        part += step * way.rate
        found.segments[-1].end = state_on(problem, curves, way, step, (number, start + part * size))
        places = [(k, t + step * x) for _, k, t, x in parts]
        places = [support.moved(place) for support, place in zip(supports, places, strict=True)]
        back = way.heading
    return places


def state_on(problem, curves, way, step, when):
    """The state a step along a way."""
    number, factor = when
    places = [(k, t + step * x) for k, t, x in zip(way.pieces, way.places, way.rates, strict=True)]
    return make_state(problem, curves, places, factor, min(number, 1), way)
