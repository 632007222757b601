"""Largest and smallest values over all positions of a train, from states at some of them.

Between two changes values are smooth in the position, so around every state that may be near an extreme value parabolas through
three states lead to it: an error d of the position makes one of d**2 of the value. Where a zone of contact is born they go like
the power 3/2 of the distance from there, which no polynomial in the position follows, but one in its root does (`Unrolled`).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from math import cos, pi, sin
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from .states import Placed

if TYPE_CHECKING:
    from .search import Limit, Run, SearchedWay

EQUAL = 2.0**-40
"""Share of a value by which ties differ at most."""
MOST_TIES = 16
"""As many are listed."""
NEAREST = 7
"""States through which a polynomial goes at most."""
ALIKE = 1e-9
"""Share of the largest value by which a polynomial may be wrong at its top: the value there is better by half of the digits."""
NEAREST_BIRTH = 2.0**-11
"""Share of the angle to the next state down to which is looked beside the birth of a zone: its square is that of the way, and what
is greater still nearer is so by less than one part in 1e9 of what values bend."""
MOST_STEPS = 60
"""Parabolas after which the best state is taken; five or so do."""
SETTLED = 2.0**-20
"""Share of the distance of two states by which the last parabola moves the place at most."""
GOLDEN = (3.0 - 5.0**0.5) / 2.0
"""Share of the longer part that is tried where a parabola leads nowhere."""


class Unrolled(NamedTuple):
    """Positions between two changes as an angle from 0 to pi, whose square is the distance from either end, next to it.

    Attributes
    ----------
    low, high : float
        The ends.

    Examples
    --------
    >>> way = Unrolled(2.0, 6.0)
    >>> way.angle(np.array([2.0, 4.0, 6.0])).round(6).tolist(), round(way.position(way.angle(2.5)), 12)
    ([0.0, 1.570796, 3.141593], 2.5)
    """

    low: float
    high: float

    def angle(self, position: Any) -> Any:
        """Give the angle of positions."""
        below, above = np.maximum(position - self.low, 0.0), np.maximum(self.high - position, 0.0)
        return 2.0 * np.arctan2(np.sqrt(below), np.sqrt(above))

    def position(self, angle: float) -> float:
        """Give the position of an angle."""
        if angle <= pi / 2:
            return self.low + (self.high - self.low) * sin(angle / 2) ** 2
        return self.high - (self.high - self.low) * cos(angle / 2) ** 2

    def begins(self, angle: float) -> bool:
        """Tell whether an angle is the first one."""
        return angle <= 0.0

    def ends(self, angle: float) -> bool:
        """Tell whether an angle is the last one."""
        return angle >= pi


class Straight(NamedTuple):
    """The same where there is nothing to be unrolled: the angle is the position."""

    def angle(self, position: Any) -> Any:
        """Give the position."""
        return position

    def position(self, angle: float) -> float:
        """Give the position."""
        return angle

    def begins(self, angle: float) -> bool:
        """Tell that no zone is born."""
        return False

    ends = begins


def ruler_of(way: SearchedWay, low: float, high: float) -> Unrolled | Straight:
    """Give what positions between two changes are measured by, so that values are smooth up to its ends.

    Parameters
    ----------
    way : SearchedWay
        The states.
    low, high : float
        First and last position.

    Returns
    -------
    Unrolled or Straight
        Zones of contact are there on foundations only.
    """
    return Unrolled(low, high) if way.loads.beam.ground_layers and high > low else Straight()


class Peak(NamedTuple):
    """An extreme value, and the state in which it is.

    Attributes
    ----------
    value : float
        The value.
    state : Placed
        Where it is.
    limit : Limit or None
        Where the value is only next to the state.
    """

    value: float
    state: Placed
    limit: Limit | None = None


def find_peaks(way: SearchedWay, value: Callable[[Placed], float], further: Sequence[Peak] = ()) -> list[Peak]:
    """Find the largest value over all positions.

    Parameters
    ----------
    way : SearchedWay
        The states.
    value : callable
        A value of a state, smooth in the position between two changes.
    further : sequence of Peak
        Values besides.

    Returns
    -------
    list of Peak
        All that tie, in ascending order of the position; none where no position is solved.
    """
    tables = [np.array([value(state) for state in run.states]) for run in way.runs]
    known = [one.value for one in further] + [float(np.nanmax(table)) for table in tables if not np.isnan(table).all()]
    if not known:
        return []
    best = max(known)
    scale = max(abs(float(np.nanmax(np.abs(table)))) for table in tables if not np.isnan(table).all())
    pairs = list(zip(way.runs, tables, strict=True))
    most = max((float(_bends(run, table).max()) for run, table in pairs if len(table) > 2), default=abs(best))
    step = _longest_step(way)
    found, promising = list(further), []
    beside = {(id(one.limit.state), one.limit.side): one.value for one in further if one.limit is not None}
    for run, table in pairs:
        if np.isnan(table).any():
            continue
        found += _tops(run, table, best - EQUAL * max(abs(best), scale))
        table = _with_limits(run, table, beside)
        width = run.states[-1].position - run.states[0].position
        hills = _hills(run, table, most * (min(width / step, 1.0) if step > 0.0 else 0.0), bool(way.loads.beam.ground_layers))
        promising += [(float(table[k]) + gain, run, table, k) for k, gain in hills if gain > 2.0**-46 * scale]
    for reach, run, table, k in sorted(promising, key=lambda one: -one[0]):
        if reach < best:
            break
        foretold = _foretell(way, run, table, k)
        if foretold is not None and foretold.height + foretold.doubt < best - EQUAL * max(abs(best), scale):
            continue
        top = _climb(way, run, table, k, value, foretold, ALIKE * scale)
        if (id(top.state), "right") in beside or (id(top.state), "left") in beside:
            continue  # it is one of those
        found.append(top)
        best = max(best, top.value)
    slack = EQUAL * max(abs(best), scale)
    ties = sorted((one for one in found if one.value >= best - slack), key=lambda one: one.state.position)
    return _apart(ties, way)[:MOST_TIES]


def _with_limits(run: Run, table: np.ndarray, beside: Mapping[tuple[int, str], float]) -> np.ndarray:
    """Values of a run that tend to a limit at its ends, which is not there when an axle has come."""
    table = table.copy()
    for k, side in ((0, "right"), (-1, "left")):
        table[k] = max(table[k], beside.get((id(run.states[k]), side), -np.inf))
    return table


def _tops(run: Run, table: np.ndarray, least: float) -> list[Peak]:
    """The states with values from `least` on, of those side by side the greatest."""
    found: list[Peak] = []
    before = -2
    for k in np.flatnonzero(table >= least).tolist():
        one = Peak(float(table[k]), run.states[k])
        if k == before + 1:
            found[-1] = max(found[-1], one, key=lambda top: top.value)
        else:
            found.append(one)
        before = k
    return found


def _bends(run: Run, table: np.ndarray) -> np.ndarray:
    """How far values are from straight lines, about, at all states but the ends."""
    widths = np.diff([state.position for state in run.states])
    return np.abs(np.diff(np.diff(table) / widths)) * np.maximum(widths[1:], widths[:-1])


def _hills(run: Run, table: np.ndarray, most: float, on_ground: bool) -> list[tuple[int, float]]:
    """States around which values may be greater than there, and by how much at most, about; `most` where there are but two."""
    n = len(table)
    if n < 3:
        return [(int(table.argmax()), most)] if n == 2 else []
    rise, bend = np.diff(table), _bends(run, table)
    found = [(k, float(bend[k - 1])) for k in range(1, n - 1) if table[k] >= table[k - 1] and table[k] >= table[k + 1]]
    # At an end only where the way down from it does not begin at once; where zones are born three states do not tell
    for k, inward, curve in ((0, -rise[0], bend[0]), (n - 1, rise[-1], bend[-1])):
        if inward >= 0.0 and (on_ground or inward <= curve):
            found.append((k, float(curve)))
    return found


class _Foretold(NamedTuple):
    """Where polynomials through states have their top: the place as the angle of a ruler."""

    place: float
    height: float
    doubt: float


def _foretell(way: SearchedWay, run: Run, table: np.ndarray, k: int) -> _Foretold | None:
    """Top near a state of the polynomial through its neighbours; None where that has none.

    On foundations of two polynomials, one in the position and one in the angle: on one side of a change values are smooth in the
    position, on the other in its root, and what is right of that nobody knows beforehand.
    """
    ruler = _ruler(way, run)
    found = [_top(run, table, k, one, ruler) for one in dict.fromkeys((ruler, Straight()))]
    if None in found:
        return None
    best = max(found, key=lambda one: one.height)
    apart = best.height - min(one.height for one in found)
    return best._replace(doubt=max(apart, *(one.doubt for one in found)))


def _top(run: Run, table: np.ndarray, k: int, measure: Unrolled | Straight, ruler: Unrolled | Straight) -> _Foretold | None:
    """Top near a state of the polynomial in one measure."""
    n = len(table)
    if n < NEAREST:
        return None
    first = min(max(k - NEAREST // 2, 0), n - NEAREST)
    at = measure.angle(np.array([state.position for state in run.states[first : first + NEAREST]]))
    heights, own = table[first : first + NEAREST], k - first
    left, right = at[max(own - 1, 0)], at[min(own + 1, NEAREST - 1)]
    place, height = highest(at, heights, left, right)
    if place is None:
        return None
    fewer = slice(1, -1) if 0 < own < NEAREST - 1 else slice(0, -2) if own == 0 else slice(2, None)
    _, other = highest(at[fewer], heights[fewer], left, right)
    return None if other is None else _Foretold(float(ruler.angle(measure.position(place))), height, 4.0 * abs(height - other))


def _ruler(way: SearchedWay, run: Run) -> Unrolled | Straight:
    return ruler_of(way, run.states[0].position, run.states[-1].position)


def _climb(
    way: SearchedWay, run: Run, table: np.ndarray, k: int, value: Callable[[Placed], float], foretold: _Foretold | None,
    alike: float,
) -> Peak:  # fmt: skip
    """Go to the top near a state by polynomials, by parabolas, or by golden sections where they lead nowhere."""
    low, high = max(k - 1, 0), min(k + 1, len(table) - 1)
    near = range(max(low - 1, 0), min(high + 2, len(table)))
    ruler = _ruler(way, run)
    places = {i: float(ruler.angle(run.states[i].position)) for i in near}
    heights = {places[i]: float(table[i]) for i in near}
    states = {places[i]: run.states[i] for i in near}
    left, right = places[low], places[high]
    width, best, last = right - left, places[k], np.inf
    acts = run.states[k].acts
    if foretold is not None and foretold.place not in states:
        state = way.loads.state(ruler.position(foretold.place), acts)
        if state.status == run.states[k].status:
            heights[foretold.place], states[foretold.place] = value(state), state
            if abs(heights[foretold.place] - foretold.height) <= alike:
                best = max((best, foretold.place), key=heights.get)
                return Peak(heights[best], states[best])
            if heights[foretold.place] >= heights[best]:
                left, right = (best, right) if foretold.place > best else (left, best)
                best = foretold.place
            else:
                left, right = (left, foretold.place) if foretold.place > best else (foretold.place, right)
    for _ in range(MOST_STEPS):
        place, _ = vertex(best, heights, left, right)
        if place is None and best in (left, right) and len(heights) > 2:
            # From an end of the run values fall, but what is nearer to the birth of a zone than any state may be greater
            place = nearer(best, left, right, width, ruler)
            if place is None:
                break
        elif place is None or abs(place - best) > last / 2:
            place = best + GOLDEN * ((right - best) if right - best > best - left else (left - best))
        last = abs(place - best)
        if place in states or last <= SETTLED**2 * width:
            break
        state = way.loads.state(ruler.position(place), acts)
        if state.status != run.states[k].status:
            break
        heights[place], states[place] = value(state), state
        if heights[place] >= heights[best]:
            left, right = (best, right) if place > best else (left, best)
            best = place
        else:
            left, right = (left, place) if place > best else (place, right)
        if last <= SETTLED * width:
            break
    return Peak(heights[best], states[best])


def nearer(best: float, left: float, right: float, width: float, ruler: Unrolled | Straight) -> float | None:
    """Give the angle to look at next where values fall from the end of a run on.

    Parameters
    ----------
    best, left, right : float
        That end, and the bounds.
    width : float
        Of the bounds at first.
    ruler : Unrolled or Straight
        What angles are of.

    Returns
    -------
    float or None
        None where nothing can be born, or what may still be greater is no more than rounding.
    """
    away = right + left - 2.0 * best
    born = ruler.begins(best) or ruler.ends(best)
    return best + away / 4.0 if born and abs(away) > NEAREST_BIRTH * width else None


def vertex(best: float, heights: Mapping[float, float], left: float, right: float) -> tuple[float | None, float]:
    """Find the top of the parabola through the highest point and the two nearest to it.

    Parameters
    ----------
    best : float
        Place of the highest point.
    heights : mapping of float to float
        Of all points, by their places.
    left, right : float
        Bounds.

    Returns
    -------
    place, height : float
        None, 0 where there is no top between the bounds.

    Examples
    --------
    >>> vertex(2.0, {0.0: 2.0, 2.0: 8.0, 3.0: 5.0}, 0.0, 3.0)
    (1.75, 8.125)
    """
    if len(heights) < 3:
        return None, 0.0
    a, b = sorted((at for at in heights if at != best), key=lambda at: abs(at - best))[:2]
    f = heights[best]
    da, db = a - best, b - best
    slope_a, slope_b = (heights[a] - f) / da, (heights[b] - f) / db
    bend = (slope_a - slope_b) / (da - db)
    if not bend < 0.0:
        return None, 0.0
    slope = slope_a - bend * da
    place = best - slope / (2.0 * bend)
    return (place, f - slope / (4.0 * bend) * slope) if left < place < right else (None, 0.0)


def _apart(ties: Sequence[Peak], way: SearchedWay) -> list[Peak]:
    """Of ties at neighbouring states the one with the greatest value."""
    step = _longest_step(way)
    found: list[Peak] = []
    for one in ties:
        last = found[-1] if found else None
        if last is not None and last.limit is one.limit is None and one.state.position - last.state.position <= step:
            if one.value > last.value:
                found[-1] = one
            continue
        found.append(one)
    return found


def _longest_step(way: SearchedWay) -> float:
    """The longest way between two states that follow each other."""
    return max((b.position - a.position for run in way.runs for a, b in zip(run.states, run.states[1:], strict=False)), default=0.0)


def highest(at: np.ndarray, heights: np.ndarray, left: float, right: float) -> tuple[float | None, float | None]:
    """Find the highest point between bounds of the polynomial through points, if it is a stationary one.

    Parameters
    ----------
    at, heights : numpy.ndarray
        The points.
    left, right : float
        Bounds.

    Returns
    -------
    place, height : float
        None, None where there is none.

    Examples
    --------
    >>> highest(np.array([0.0, 1.0, 3.0]), np.array([0.0, 3.0, 3.0]), 1.0, 3.0)
    (2.0, 4.0)
    """
    middle, half = (left + right) / 2, (right - left) / 2
    # A power of two: products of great numbers would be beyond all numbers
    size = 2.0 ** np.floor(np.log2(np.abs(heights).max(initial=1e-300)))
    lowest = (heights / size).min()
    factors = np.linalg.solve(np.vander((at - middle) / half), heights / size - lowest)
    roots = np.roots(np.polyder(factors))
    places = roots[(np.abs(roots.imag) <= 1e-9) & (np.abs(roots.real) <= 1.0)].real
    if not len(places):
        return None, None
    found = np.polyval(factors, places)
    best = int(found.argmax())
    return float(middle + half * places[best]), float((found[best] + lowest) * size)
