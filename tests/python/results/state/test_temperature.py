"""Temperatures over the depth of the beam: the curvatures that they are."""

import gapbeam
import pytest
from scenes import at, scene, uniform

GRADIENT, ALPHA, DEPTH = 10.0, 1.2e-5, 0.6


def made(*loads, **beam):
    found = scene([4.0, 4.0], [at(0), at(1), at(2)], [{"type": "temperature", "gradient": GRADIENT}, *loads], EI=2e4)
    return found | {"beam": found["beam"] | {"alpha": ALPHA, "depth": DEPTH} | beam}


def test_two_spans():
    """Warm below, the beam would sag; the middle support pushes it up: M = -3/2 EI alpha gradient/depth there (three moments), so
    it carries 3 EI alpha gradient/(depth L)."""
    result = gapbeam.solve(made())
    moment = 1.5 * 2e4 * ALPHA * GRADIENT / DEPTH
    assert result.at(4.0).moment == pytest.approx(-moment, rel=1e-13)
    assert result.steps[-1].reaction[1] == pytest.approx(2.0 * moment / 4.0, rel=1e-13)


def test_a_simple_span_sags():
    """Freely, by kappa L^2/8, without moments; downward where the lower side is the warmer one."""
    free = scene([6.0], [at(0), at(1)], [{"type": "temperature", "gradient": GRADIENT}])
    result = gapbeam.solve(free | {"beam": free["beam"] | {"alpha": ALPHA, "depth": DEPTH}})
    assert result.at(3.0).deflection == pytest.approx(ALPHA * GRADIENT / DEPTH * 6.0**2 / 8.0, rel=1e-13)
    assert result.at(3.0).moment == pytest.approx(0.0, abs=1e-12)


def test_factors_of_cases():
    hot = {"name": "hot", "factors": {"live": 1.5, "dead": 1.0}}
    result = gapbeam.solve(made(uniform(3.0, case="dead")) | {"combinations": [hot]})
    kappa = -1.5 * ALPHA * GRADIENT / DEPTH
    loads = [{"type": "curvature", "kappa": kappa}, uniform(3.0)]
    other = gapbeam.solve(scene([4.0, 4.0], [at(0), at(1), at(2)], loads, EI=2e4))
    assert result.combinations[0].at(4.0).moment == pytest.approx(other.at(4.0).moment, rel=1e-14)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"alpha": None}, "beam.alpha: is missing; loads\\[0\\] is a temperature and takes it"),
        ({"depth": 0.0}, "beam.depth: expected a finite number above 0"),
    ],
)
def test_what_it_takes(change, message):
    with pytest.raises(gapbeam.SceneError, match=message):
        gapbeam.solve(made(**change))


def test_an_elongation_is_refused():
    with pytest.raises(gapbeam.SceneError, match="elongation by temperature is not available"):
        gapbeam.solve(made({"type": "temperature", "dT": 20.0}))
