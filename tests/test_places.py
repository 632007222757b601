"""Places along the beam: in long beams, and those that differ by rounding only; the same in Python and in the library."""

import math
import random
from bisect import bisect_left

import gapbeam
import numpy as np
import pytest
from clibrary import F77Beam
from gapbeam.base.errors import SceneError
from gapbeam.scene import POSITION_TOLERANCE
from gapbeam.scene.reading import read_beam, read_scene
from scenes import at, curvature, force, moment, scene, stretch, uniform


def at_nodes(spans):
    """Supports at all nodes."""
    return [at(i) for i in range(spans + 1)]


@pytest.mark.parametrize(("spans", "aside"), [(10, 1e-10), (10_000, 1e-8), (1_000_000, 1e-6)])
def test_a_force_far_from_the_left_end(library, spans, aside):
    x = 6.0 * (spans // 2) + 3.0
    made = scene([6.0] * spans, at_nodes(spans), [force(x, 5.0)], EI=1e4)
    result = gapbeam.solve(made)
    places = [x - aside, x, x + aside]
    shear = result.at(places).shear
    assert shear[0] - shear[1] == pytest.approx(5.0, rel=1e-9)
    assert shear[1] == pytest.approx(shear[2], rel=1e-9)
    assert result.at(x, side="left").shear == pytest.approx(shear[0], rel=1e-9)
    beam, _ = library.prepare(made)
    assert beam.solve(1.0) == (0, "")
    assert beam.fields(places)[3].tolist() == shear.tolist()
    beam.close()


def test_many_places_of_a_long_beam():
    """The offset in its span decides, wherever the span is: the fields of equal spans under equal loads, far from the ends."""
    spans, share = 200_000, np.array([0.0, 1e-8, 0.25, 0.5 - 1e-8, 0.5, 0.5 + 1e-8, 1.0 - 1e-8])
    loads = [uniform(1.0), *(force(i + 0.5, 2.0) for i in range(spans))]
    result = gapbeam.solve(scene([1.0] * spans, at_nodes(spans), loads))
    x = (np.arange(100, spans - 100)[:, None] + share).ravel()
    shear = result.at(x).shear.reshape(-1, len(share))
    expected = [1.5, 1.5 - 1e-8, 1.25, 1.0 + 1e-8, -1.0, -1.0 - 1e-8, -1.5 + 1e-8]
    assert np.abs(shear - expected).max() < 1e-9


def points_by_the_rule(ends, anchors, others):
    """The documented rule, one place after the other."""

    def near(x, y):
        return abs(x - y) <= POSITION_TOLERANCE * max(abs(x), abs(y))

    points = sorted(ends)
    for group in (sorted(anchors), sorted(others)):
        begun = []
        for x in group:
            found = [p for p in points if near(p, x)]
            if not found and not (begun and near(begun[-1], x)):
                begun.append(x)
        points = sorted(points + begun)
    return points


@pytest.mark.parametrize("seed", range(60))
def test_places_become_points_by_the_rule(seed):
    rng = random.Random(seed)
    spans = [rng.choice((1.0, 3.0, 0.7)) for _ in range(rng.randint(1, 3))]
    ends = read_scene(scene(spans, [at(0)])).span_ends().tolist()

    def cluster(count):
        """Places that stand near each other in chains."""
        x = rng.uniform(0.0, ends[-1])
        if rng.random() < 0.3:
            x = rng.choice(ends)
        unit = POSITION_TOLERANCE * max(x, 0.1)
        return [min(max(x + rng.uniform(-4.0, 4.0) * unit, 0.0), ends[-1]) for _ in range(count)]

    supports = [x for _ in range(2) for x in cluster(rng.randint(1, 5))]
    loads = cluster(20) + [x + rng.uniform(-2, 2) * POSITION_TOLERANCE * x for x in supports if x < ends[-1] - 1e-9]
    loads = [min(max(x, 0.0), ends[-1]) for x in loads]
    made = scene(spans, [at(x=x, stiffness=1.0) for x in supports], [force(x, 1.0) for x in loads])
    x = read_beam(made)[1].places.point_x
    assert x.tolist() == points_by_the_rule(ends, supports, loads)
    assert (np.diff(x) > POSITION_TOLERANCE * x[1:] * (1 - 1e-12)).all()
    for given in (*supports, *loads):
        point = x[np.abs(x - given).argmin()]
        assert abs(given - point) <= POSITION_TOLERANCE * max(given, point)


@pytest.mark.parametrize("seed", range(40))
def test_the_library_makes_the_same_points(library, seed):
    """Chains of supports and loads; what differs in one point differs in the digits."""
    rng = random.Random(seed)
    spans = [1.0, 0.7, 2.0]

    def chain(count):
        x = rng.choice((rng.uniform(0.1, 3.6), 1.0, 1.7))
        step = POSITION_TOLERANCE * x * rng.choice((0.2, 0.6, 0.9, 1.5))
        return [x + k * step for k in range(-count // 2, count // 2)]

    supports = [at(0), at(3), *(at(x=x, stiffness=rng.uniform(1.0, 9.0)) for x in chain(rng.choice((2, 6, 20))))]
    loads = [force(x, rng.uniform(-1.0, 1.0)) for _ in range(2) for x in chain(rng.choice((4, 40)))]
    start = chain(2)[0]
    loads += [uniform(2.0, **stretch(start, start + 0.05)), moment(start, 1.0)]
    made = scene(spans, supports, loads)
    result = gapbeam.solve(made)
    beam, _ = library.prepare(made)
    f77 = F77Beam(library, made)
    assert beam.solve(1.0) == (0, "")
    assert f77.solve(1.0) == 0
    x = result.beam.places.point_x
    x = np.clip(np.concatenate((x, x * (1 + 0.7 * POSITION_TOLERANCE), x * (1 - 0.7 * POSITION_TOLERANCE))), 0.0, 3.7)
    for left in (False, True):
        fields = result.at(x, side="left" if left else "right")
        for one in (beam, f77):
            for row, name in zip(one.fields(x, left), ("deflection", "rotation", "moment", "shear"), strict=False):
                np.testing.assert_array_equal(row, getattr(fields, name))
    beam.close()


def test_a_chain_of_forces_does_not_become_one():
    """2,000 forces, each 25 units in the last place from the one before: as many points as the tolerance asks for."""
    step = 25 * math.ulp(3.0)
    x = [3.0 + k * step for k in range(2000)]
    result = gapbeam.solve(scene([6.0], [at(0), at(1)], [force(place, 1.0) for place in x], EI=1e4))
    points = result.beam.places.point_x
    assert np.diff(points).min() > POSITION_TOLERANCE * 3.0
    assert all(abs(points[max(bisect_left(points, place) - 1, 0) :][:2] - place).min() <= POSITION_TOLERANCE * place for place in x)
    shear = result.at([3.0 - 1e-12, x[1000], x[-1] + 1e-12]).shear
    assert shear[0] - shear[2] == pytest.approx(2000.0)
    assert shear[0] - shear[1] == pytest.approx(1000.0, abs=5.0)


def test_a_long_chain_is_quick():
    step = 5 * math.ulp(3.0)
    made = scene([6.0], [at(0), at(1)], [force(3.0 + k * step, 1.0) for k in range(100_000)])
    assert 4_000 < len(read_beam(made)[1].places.point_x) < 6_000


NEAR = 3.0 * (1 + 0.7 * POSITION_TOLERANCE)
FARTHER = 3.0 * (1 + 1.4 * POSITION_TOLERANCE)


@pytest.mark.parametrize(
    ("supports", "hinges", "loads", "place"),
    [
        ([at(x=3.0), at(x=NEAR)], [], [], "supports[2]"),
        ([at(x=3.0), at(x=NEAR, stiffness=2.0), at(x=FARTHER)], [], [], None),
        ([at(x=NEAR, rotation=5.0)], [3.0], [], "supports[1].rotation"),
        ([at(x=3.0, stiffness=1.0), at(x=FARTHER, rotation=5.0)], [NEAR], [], None),
        ([], [3.0, NEAR], [], "beam.hinges[1]"),
        ([], [3.0, FARTHER], [], None),
        ([], [3.0], [moment(NEAR, 1.0)], "loads[0]"),
        ([], [3.0], [moment(FARTHER, 1.0)], None),
        ([], [], [uniform(1.0, **stretch(3.0, NEAR))], "loads[0]"),
        ([], [], [curvature(1.0, **stretch(3.0, FARTHER))], None),
        # Both ends are the hinge's point, though farther from each other than the tolerance
        ([], [NEAR], [uniform(1.0, **stretch(3.0, FARTHER))], "loads[0]"),
        ([], [NEAR], [moment(3.0, 1.0)], "loads[0]"),
        ([], [6.0 * POSITION_TOLERANCE], [], "beam.hinges[0]"),
        ([], [6.0 * (1 - POSITION_TOLERANCE)], [], "beam.hinges[0]"),
    ],
)
def test_what_is_at_the_same_point_is_refused_everywhere(library, supports, hinges, loads, place):
    made = scene([6.0], [at(0, rotation="fixed"), *supports], loads, hinges=hinges)
    if place is None:
        read_scene(made)
    else:
        with pytest.raises(SceneError) as caught:
            read_scene(made)
        assert caught.value.place == place
    beam, message = library.prepare(made)
    if place is None:
        assert not message
        beam.close()
    else:
        entry = int(place[place.index("[") + 1 : place.index("]")])
        kind = place.partition("[")[0].removeprefix("beam.").removesuffix("s")
        assert beam == 11
        assert message.startswith(f"{kind} {entry + 1} of ")
        assert F77Beam(library, made).info_ < 0
