"""Exact paths and states of beams whose supports follow polylines, in rational numbers (see `cells.py`).

The path goes from cell to cell, and at every kink all cells around it are tried, so ties need no special care.

Conventions where the documents leave the choice open:

* Leg 0 brings up dead loads, settlements and lacks of fit (negative gaps) together, from an unstressed beam; leg 1
  the other loads. Positive gaps are there from the start. A leg without loads is skipped.
* The index of a segment counts the negative eigenvalues of the tangent stiffness, supports on vertical pieces held,
  plus one for every vertical drop that is being passed; `drops` says how many these are.
* The sense of a path is 1 where the load rises at an even index and falls at an odd one, else -1: away from ties it
  never changes (index theorem), and a path that keeps it at ties, too, does not turn back.
* Of several ways on: index 0 with the load rising first; then those that keep the sense; of these the least index;
  then the load rising before standing still before falling; then the way on which the first of the supports at a
  kink (order of the scene) goes forward.
  At the beginning of a leg ways with a falling load come last, and are no ways at all where they are stable (they
  belong to the reversed load), nor motions at constant load along which the new load does no work.
* Where a whole family of motions is possible at once ("loose") and no stable way with rising load leads on, the path
  goes on from the state just above the factor, if there is exactly one of index 0 (in all cells, compared as pairs of
  value and rate); the motion between is a segment without a way.
"""

from dataclasses import dataclass, field
from fractions import Fraction

from .cells import Problem
from .curves import ONE, ZERO


@dataclass
class State:
    """A state of equilibrium.

    Attributes
    ----------
    factor : Fraction
        Load factor of the leg.
    weights : (Fraction, Fraction)
        What acts of the dead and of the live loads.
    points : list of (Fraction, Fraction)
        (d, r) of the supports of `Problem.which`, in the direction of their sides.
    w, reaction : list of Fraction
        Deflections (down) and reactions (up) of the same supports.
    pieces : tuple of int
        Branch labels (0 = open); at a kink, of one of its two sides.
    index, drops, null : int or None
        See `cells.Way`; None where the state is not part of a path.
    """

    factor: Fraction
    weights: tuple
    points: list
    w: list
    reaction: list
    pieces: tuple
    index: int | None = None
    drops: int | None = None
    null: int | None = None


@dataclass
class Segment:
    """A straight part of the path; `rate` is the sign of the rate of the load factor."""

    leg: int
    start: State
    end: State | None
    rate: int
    index: int
    drops: int
    null: int
    way: object = field(repr=False)

    @property
    def stable(self):
        """Whether it is stable under load control."""
        return self.index == 0


@dataclass
class Special:
    """A point of the path that is a limit or has several ways on.

    Attributes
    ----------
    leg : int
    state : State
    kind : str
        "mechanism" (the path ends in a motion at constant load, or nothing leads on), "bifurcation" (several ways
        on), "limit".
    turn : str
        "max" (load rising, then falling), "min" (the reverse), "none".
    loses : bool
        Whether stability is lost here: index 0 before, not after.
    segment : int
        Number of the segment that leaves it.
    ways : list of Way
        All ways on, the one taken first.
    landing : State or None
        Of a point where stability is lost: the first point with index 0 of the path that goes on, at the same
        factor, load rising.
    """

    leg: int
    state: State
    kind: str
    turn: str
    loses: bool
    segment: int
    ways: list = field(repr=False)
    landing: State | None = None


@dataclass
class Path:
    """A path.

    Its `status` is "solved", "ray" (load falling without end), "mechanism", "end", "loose",
    "loop" (back at the beginning of its leg: a closed curve of states) or "long" (given up).

    `end` is the state at factor 1 of the last leg that got there. `loose_points` counts kinks with cells of several
    directions ("loose": where no stable way with rising load led on, so the path stops without an answer).
    """

    problem: Problem = field(repr=False)
    status: str = "solved"
    segments: list = field(default_factory=list)
    specials: list = field(default_factory=list)
    loose_points: int = 0
    end: State | None = None

    @property
    def limits(self):
        """Points where stability is lost or the load turns."""
        return [s for s in self.specials if s.loses or s.turn != "none" or s.kind == "mechanism"]

    def crossings(self, factor, leg=1):
        """States of the path at a load factor of a leg, with their index; one per segment, joints counted once."""
        found = []
        for segment in self.segments:
            state = crossing(self.problem, segment, factor) if segment.leg == leg else None
            if state and (not found or found[-1].points != state.points):
                found.append(state)
        return found


def crossing(problem, segment, factor):
    """State on a segment at a load factor, or None."""
    a, b, way = segment.start, segment.end, segment.way
    if way is None or way.rate == 0:
        return a if a.factor == factor else None
    s = (factor - a.factor) / way.rate
    if s < 0 or (b is not None and (factor - b.factor) * way.rate > 0):
        return None
    places = [(k, t + s * x) for k, t, x in zip(way.pieces, way.places, way.rates, strict=True)]
    return make_state(problem, problem.curves, places, factor, segment.leg, way)


def make_state(problem, curves, places, factor, leg, way=None):
    """The state at given places on the curves."""
    weights = (factor, ZERO) if leg == 0 else (ONE, factor)
    points = [curve.at(place) for curve, place in zip(curves, places, strict=True)]
    pieces = tuple(curve.labels[k] for curve, (k, _) in zip(curves, places, strict=True))
    w = problem.displacements(points, weights)
    reaction = [s * r for s, (_, r) in zip(problem.sign, points, strict=True)]
    more = (way.index, way.drops, way.null) if way else ()
    return State(factor, weights, points, w, reaction, pieces, *more)


def order_of(way, start=False, sense=1):
    """Sort key of the choice between ways; `sense` is that of the path so far."""
    sign = (way.rate > 0) - (way.rate < 0)
    best, strange = way.index == 0 and sign > 0, sense_of(way, sense) != sense
    return (start and sign < 0, not best, strange, way.index, -sign, [-t for t in way.turns])


def sense_of(way, before=1):
    """1 where the load rises at an even index and falls at an odd one, else -1; `before` where it stands still."""
    return before if way is None or way.rate == 0 else (-1 if way.rate < 0 else 1) * (-1) ** way.index


def states(scene, factor, dead=ONE):
    """All states of equilibrium of a small scene at one load factor.

    Parameters
    ----------
    scene : dict or Problem
    factor, dead : Fraction
        Factors of the live and of the dead loads.

    Returns
    -------
    found : list of State
        With index where the state is inside a cell, that of one of the cells at a kink.
    singular : int
        Cells without a unique state; those that contain equilibria contain many, and these are not found.
    """
    problem = scene if isinstance(scene, Problem) else Problem(scene)
    load = [dead * a + Fraction(factor) * b for a, b in zip(*problem.g, strict=True)]
    curves = problem.curves
    found, singular = {}, 0
    for picked, columns in problem.cells(every_piece(curves), curves):
        chosen = [picked[i][0] for i in range(len(curves))]
        if any(pivot is None for pivot, _, _ in columns.steps):
            singular += 1
            continue
        values = in_order(picked, columns.solve(offset(problem, chosen, load)))
        places = list(zip(chosen, values, strict=True))
        if all(map(inside, curves, places)):
            index, null, drops = problem.inertia(chosen)
            state = make_state(problem, curves, places, Fraction(factor), 1)
            state.index, state.drops, state.null = index, drops, null
            found.setdefault(tuple(state.points), state)
    return list(found.values()), singular


def inside(curve, place, rate=ZERO):
    """Whether a parameter is within its piece, and stays there for a moment at this rate."""
    k, t = place
    low, high = (t, rate) >= (0, 0), (t - curve.end(k), rate) <= (0, 0)
    return (low or k == 0) and (high or k == curve.last)


def follow(scene, choose=None, most=2000):
    """The path from the unstressed beam to load factor 1, or to where it ends.

    Parameters
    ----------
    scene : dict or Problem
    choose : callable, optional
        (ways, start of a leg, sense) -> the way taken; default: the first in `order_of`.
    most : int
        Segments after which it gives up ("long").

    Returns
    -------
    Path
    """
    problem = scene if isinstance(scene, Problem) else Problem(scene)
    path = Path(problem)
    places = [curve.find(ZERO, ZERO) for curve in problem.curves]
    for leg in (0, 1):
        if any(problem.g[leg]):
            places = follow_leg(path, places, leg, choose or first, most)
            if path.status != "solved":
                break
        path.end = make_state(problem, problem.curves, places, ONE, leg)
    for special in path.specials:
        if special.loses:
            special.landing = landing(path, special)
    return path


def first(ways, start, sense):
    """The first way in the order of the module's conventions."""
    return min(ways, key=lambda way: order_of(way, start, sense))


def follow_leg(path, places, leg, choose, most):
    """Follow one leg from factor 0 to 1; returns the places at its end."""
    problem, curves, factor = path.problem, path.problem.curves, ZERO
    before, seen, turned, sense = None, set(), set(), 1
    while True:
        back = before.way.heading if before and before.way else None
        ways, loose = problem.ways(places, problem.g[leg], back)
        path.loose_points += loose
        here = make_state(problem, curves, places, factor, leg)
        if before is None:
            ways = problem.starts(ways, problem.g[leg])
        way = choose(ways, before is None, sense) if ways else None
        if loose and (way is None or way.index or way.rate <= 0):
            after = None if factor in turned else just_above(problem, factor, leg)
            if after is not None:
                turned.add(factor)
                end = make_state(problem, curves, after, factor, leg)
                path.segments.append(Segment(leg, here, end, 0, 0, 0, 1, None))
                places, before = after, path.segments[-1]
                continue
            note_special(path, leg, here, before, None, [])
            path.status = "loose"
            return places
        note_special(path, leg, here, before, way, ways)
        if way is None:
            path.status = "end"
            return places
        if (way.pieces, way.heading) in seen or len(path.segments) >= most:
            path.status = "loop" if (way.pieces, way.heading) in seen else "long"
            return places
        seen.add((way.pieces, way.heading))
        sense = sense_of(way, sense)
        places, factor, before = take(path, way, factor, leg)
        if places is None or factor == 1:
            return places


def just_above(problem, factor, leg):
    """Places of the only state of index 0 just above a factor, in the limit; None if there is none or several."""
    curves = problem.curves
    fixed = [ZERO] * len(curves) if leg == 0 else problem.g[0]
    load = [a + factor * b for a, b in zip(fixed, problem.g[leg], strict=True)]
    found = {}
    for picked, columns in problem.cells(every_piece(curves), curves):
        chosen = [picked[i][0] for i in range(len(curves))]
        if any(pivot is None for pivot, _, _ in columns.steps):
            continue
        values = in_order(picked, columns.solve(offset(problem, chosen, load)))
        rates = in_order(picked, columns.solve(problem.g[leg]))
        if (
            all(map(inside, curves, zip(chosen, values, strict=True), rates))
            and problem.inertia(chosen)[0] == 0
        ):
            places = list(zip(chosen, values, strict=True))
            found[tuple(curve.at(place) for curve, place in zip(curves, places, strict=True))] = places
    return next(iter(found.values())) if len(found) == 1 else None


def every_piece(curves):
    """All pieces of all curves, as choices for `Problem.cells`."""
    return [[(k, ZERO, 0) for k in range(len(curve.pieces))] for curve in curves]


def offset(problem, chosen, load):
    """Right side less what belongs to the base points of pieces."""
    rest = list(load)
    for i, (curve, k) in enumerate(zip(problem.curves, chosen, strict=True)):
        d, r = curve.pieces[k][0]
        rest = [x - d * p[i] - r * q[i] for x, p, q in zip(rest, problem.P, problem.Q, strict=True)]
    return rest


def in_order(picked, values):
    """Values in the order of elimination, brought into the order of the supports."""
    return [x for _, x in sorted(zip(picked, values, strict=True))]


def take(path, way, factor, leg):
    """Go along a way to the next kink or to factor 1; places are None where the path never ends."""
    problem = path.problem
    rooms = [
        (curve.room(k, t, x), abs(x))
        for curve, k, t, x in zip(problem.curves, way.pieces, way.places, way.rates, strict=True)
        if x
    ]
    lengths = [room / rate for room, rate in rooms if room is not None]
    if way.rate > 0:
        lengths.append((ONE - factor) / way.rate)
    here = make_state(
        problem, problem.curves, list(zip(way.pieces, way.places, strict=True)), factor, leg, way
    )
    sign = (way.rate > 0) - (way.rate < 0)
    segment = Segment(leg, here, None, sign, way.index, way.drops, way.null, way)
    path.segments.append(segment)
    if not lengths:
        path.status = "mechanism" if way.rate == 0 else "ray"
        return None, factor, segment
    step = min(lengths)
    places = [(k, t + step * x) for k, t, x in zip(way.pieces, way.places, way.rates, strict=True)]
    factor += step * way.rate
    segment.end = make_state(problem, problem.curves, places, factor, leg, way)
    return places, factor, segment


def note_special(path, leg, here, before, way, ways):
    """Record a limit, a bifurcation or a mechanism at a kink."""
    rate = (way.rate > 0) - (way.rate < 0) if way else 0
    came = before.rate if before else 1
    loses = (before is None or before.stable) and (way is None or way.index > 0)
    turn = "none" if rate * came >= 0 else ("max" if came > 0 else "min")
    endless = way is None or (rate == 0 and endless_motion(path.problem, way))
    moving = way is not None and way.rate != 0
    several = sum(w.rate > 0 if before is None else w.rate != 0 or not moving for w in ways) > 1
    kind = "mechanism" if endless else "bifurcation" if several else "limit"
    if endless or loses or turn != "none" or several:
        rest = sorted((w for w in ways if w is not way), key=order_of)
        ways = [way, *rest] if way else []
        path.specials.append(Special(leg, here, kind, turn, loses, len(path.segments), ways))


def endless_motion(problem, way):
    """Whether a way meets no kink any more."""
    parts = zip(problem.curves, way.pieces, way.places, way.rates, strict=True)
    return all(x == 0 or curve.room(k, t, x) is None for curve, k, t, x in parts)


def landing(path, special):
    """First point of index 0 of the path after a limit at the limit's factor, load rising, or None."""
    for segment in path.segments[special.segment :]:
        if segment.leg == special.leg and segment.stable and segment.rate > 0:
            state = crossing(path.problem, segment, special.state.factor)
            if state:
                return state
    return None
