"""Energy that is set free where the load cannot go on, beside the potential of the two states."""

import itertools

import gapbeam
import numpy as np
import pytest
from scenes import at, scene


def potential(result, step, made, factor):
    """Of the beam, the polylines and a uniform load: moments are of degree 2 along a span, deflections of degree 4."""
    at, weights = np.polynomial.legendre.leggauss(3)
    starts = np.arange(len(made["supports"]) - 1.0)
    x = (starts[:, None] + (at + 1.0) / 2).ravel()
    weights = np.tile(weights / 2, len(starts))
    fields = result.at_state(step, x)
    energy = weights @ (fields.moment**2 / (2.0 * made["beam"]["EI"]) - factor * made["loads"][0]["q"] * fields.deflection)
    for support, w in zip(made["supports"], step.deflection, strict=True):
        d, f = np.array([[0.0, 0.0], *support["law"]]).T
        points = np.append(d[d < w], max(w, 0.0))
        energy += np.trapezoid(np.interp(points, d, f), points)
    return energy


@pytest.mark.parametrize("seed", [3, 5])
def test_energy_that_is_set_free_where_laws_rise_and_fall_by_turns(seed):
    """The path becomes stable again at load factors above some of its limits: it does not land there."""
    draw = np.random.default_rng(seed)
    supports = []
    for node in range(12):
        law, d, f = [], 0.0, 0.0
        for _ in range(3):
            d, f = d + draw.uniform(0.004, 0.008), f + draw.uniform(2.0, 4.0)
            law.append([d, f])
            d, f = d + draw.uniform(0.003, 0.006), f * draw.uniform(0.6, 0.9)
            law.append([d, f])
        supports.append(at(node, side="below", law=[*law, [d + 0.01, f + 200.0]]))
    made = scene([1.0] * 11, supports, [{"type": "uniform", "q": 8.0}], EI=1e3)
    result = gapbeam.solve(made | {"analysis": {"follow": "events", "at_limit": "follow"}})
    landed = [limit for limit in result.limits if limit.landing is not None]
    assert len(landed) > 8
    before = {segment.stop: segment for segment in result.segments}
    for limit in landed:
        step = result.path.step(before[limit.factor], limit.factor)
        lost = np.subtract(*(potential(result, one, made, limit.factor) for one in (step, limit.landing)))
        assert limit.released == pytest.approx(lost, rel=1e-9, abs=1e-12)
    # A jump goes to the first of them
    jumped = gapbeam.solve(made | {"analysis": {"follow": "events", "at_limit": "jump"}})
    assert jumped.limits[0].landing.deflection == pytest.approx(landed[0].landing.deflection, rel=1e-12)
    ends = [(segment.start, segment.stop) for segment in jumped.segments]
    assert all(one[1] == other[0] for one, other in itertools.pairwise(ends))
    for segment in jumped.segments:
        assert jumped.path.begin(segment).reaction.sum() == pytest.approx(88.0 * segment.start, rel=1e-12)
