"""Largest and smallest values over all positions of a train, from states at some of them.

Between two changes values are smooth in the position, so around every state that may be near an extreme value parabolas through
three states lead to it: an error d of the position makes one of d**2 of the value; in the angle of `Unrolled` on the ground.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...engine.tolerances import MOST_TIES, TRAIN_EQUAL
from .states import Placed
from .tops import Straight, Unrolled, highest, nearer, vertex

if TYPE_CHECKING:
    from .sampled_traversal import Limit, Run, SampledTraversal

NEAREST = 7
"""States through which a polynomial goes at most."""
ALIKE = 1e-9
"""Share of the largest value by which a polynomial may be wrong at its top: the value there is better by half of the digits."""
MOST_STEPS = 60
"""Parabolas after which the best state is taken; five or so do."""
SETTLED = 2.0**-20
"""Share of the distance of two states by which the last parabola moves the place at most."""
GOLDEN = (3.0 - 5.0**0.5) / 2.0
"""Share of the longer part that is tried where a parabola leads nowhere."""


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


def find_peaks(traversal: SampledTraversal, value: Callable[[Placed], float], further: Sequence[Peak] = ()) -> list[Peak]:
    """Find the largest value over all positions.

    Parameters
    ----------
    traversal : SampledTraversal
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
    tables = [np.array([value(state) for state in run.states]) for run in traversal.runs]
    known = [one.value for one in further] + [float(np.nanmax(table)) for table in tables if not np.isnan(table).all()]
    if not known:
        return []
    best = max(known)
    scale = max(abs(float(np.nanmax(np.abs(table)))) for table in tables if not np.isnan(table).all())
    pairs = list(zip(traversal.runs, tables, strict=True))
    most = max((float(_bends(run, table).max()) for run, table in pairs if len(table) > 2), default=abs(best))
    step = _longest_step(traversal)
    found, promising = list(further), []
    beside = {(id(one.limit.state), one.limit.side): one.value for one in further if one.limit is not None}
    for run, table in pairs:
        if np.isnan(table).any():
            continue
        found += _tops(run, table, best - TRAIN_EQUAL * max(abs(best), scale))
        table = _with_limits(run, table, beside)
        width = run.states[-1].position - run.states[0].position
        hills = _hills(run, table, most * (min(width / step, 1.0) if step > 0.0 else 0.0), _ruler(traversal, run))
        promising += [(float(table[k]) + gain, run, table, k) for k, gain in hills if gain > 2.0**-46 * scale]
    for reach, run, table, k in sorted(promising, key=lambda one: -one[0]):
        if reach < best:
            break
        foretold = _foretell(traversal, run, table, k)
        if foretold is not None and foretold.height + foretold.doubt < best - TRAIN_EQUAL * max(abs(best), scale):
            continue
        top = _climb(traversal, run, table, k, value, foretold, ALIKE * scale)
        if (id(top.state), "right") in beside or (id(top.state), "left") in beside:
            continue  # it is one of those
        found.append(top)
        best = max(best, top.value)
    slack = TRAIN_EQUAL * max(abs(best), scale)
    ties = sorted((one for one in found if one.value >= best - slack), key=lambda one: one.state.position)
    return _apart(ties, traversal)[:MOST_TIES]


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


def _hills(run: Run, table: np.ndarray, most: float, ruler: Unrolled | Straight) -> list[tuple[int, float]]:
    """States around which values may be greater than there, and by how much at most, about; `most` where there are but two."""
    n = len(table)
    if n < 3:
        return [(int(table.argmax()), most)] if n == 2 else []
    rise, bend = np.diff(table), _bends(run, table)
    found = [(k, float(bend[k - 1])) for k in range(1, n - 1) if table[k] >= table[k - 1] and table[k] >= table[k + 1]]
    # At an end only where the way down from it does not begin at once; where zones are born three states do not tell
    for k, inward, curve in ((0, -rise[0], bend[0]), (n - 1, rise[-1], bend[-1])):
        if inward >= 0.0 and (ruler.bears_zones or inward <= curve):
            found.append((k, float(curve)))
    return found


class _Foretold(NamedTuple):
    """Where polynomials through states have their top: the place as the angle of a ruler."""

    place: float
    height: float
    doubt: float


def _foretell(traversal: SampledTraversal, run: Run, table: np.ndarray, k: int) -> _Foretold | None:
    """Top near a state of the polynomial through its neighbours; None where that has none.

    On foundations of two polynomials, one in the position and one in the angle: on one side of a change values are smooth in the
    position, on the other in its root, and what is right of that nobody knows beforehand.
    """
    ruler = _ruler(traversal, run)
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


def _ruler(traversal: SampledTraversal, run: Run) -> Unrolled | Straight:
    return traversal.ruler(run.states[0].position, run.states[-1].position)


def _climb(
    traversal: SampledTraversal, run: Run, table: np.ndarray, k: int, value: Callable[[Placed], float], foretold: _Foretold | None,
    alike: float,
) -> Peak:  # fmt: skip
    """Go to the top near a state by polynomials, by parabolas, or by golden sections where they lead nowhere."""
    low, high = max(k - 1, 0), min(k + 1, len(table) - 1)
    near = range(max(low - 1, 0), min(high + 2, len(table)))
    ruler = _ruler(traversal, run)
    places = {i: float(ruler.angle(run.states[i].position)) for i in near}
    heights = {places[i]: float(table[i]) for i in near}
    states = {places[i]: run.states[i] for i in near}
    left, right = places[low], places[high]
    width, best, last = right - left, places[k], np.inf
    acts = run.states[k].acts
    if foretold is not None and foretold.place not in states:
        state = traversal.loads.state(ruler.position(foretold.place), acts)
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
        state = traversal.loads.state(ruler.position(place), acts)
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


def _apart(ties: Sequence[Peak], traversal: SampledTraversal) -> list[Peak]:
    """Of ties at neighbouring states the one with the greatest value."""
    step = _longest_step(traversal)
    found: list[Peak] = []
    for one in ties:
        last = found[-1] if found else None
        if last is not None and last.limit is one.limit is None and one.state.position - last.state.position <= step:
            if one.value > last.value:
                found[-1] = one
            continue
        found.append(one)
    return found


def _longest_step(traversal: SampledTraversal) -> float:
    """The longest way between two states that follow each other."""
    pairs = ((a, b) for run in traversal.runs for a, b in zip(run.states, run.states[1:], strict=False))
    return max((b.position - a.position for a, b in pairs), default=0.0)
