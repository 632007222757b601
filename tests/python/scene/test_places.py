"""Places along the beam: in long beams, and those that differ by rounding only; the same in Python and in the library."""

import math
import random
from bisect import bisect_left

import gapbeam
import numpy as np
import pytest
from gapbeam.base.errors import SceneError
from gapbeam.scene import POSITION_TOLERANCE
from gapbeam.scene.places import locate
from gapbeam.scene.reading import read_beam, read_scene
from languages.clibrary import F77Beam
from scenes import at, curvature, force, linear, moment, scene, stretch, uniform


def at_nodes(spans):
    """Supports at all nodes."""
    return [at(i) for i in range(spans + 1)]


@pytest.mark.parametrize(("spans", "aside"), [(10, 1e-10), (10_000, 1e-8), (100_000, 1e-7)])
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
    # At the left end rounding is that of the whole beam
    anchors, others = ([0.0 if x <= POSITION_TOLERANCE * ends[-1] else x for x in group] for group in (anchors, others))
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
        assert abs(given - point) <= POSITION_TOLERANCE * (max(given, point) if point > 0.0 else ends[-1])


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
    x = result._beam.places.point_x
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
    points = result._beam.places.point_x
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
        ([], [], [uniform(1.0, **stretch(3.0, NEAR))], None),
        ([], [], [curvature(1.0, **stretch(3.0, FARTHER))], None),
        # Both ends are the hinge's point, though farther from each other than the tolerance
        ([], [NEAR], [uniform(1.0, **stretch(3.0, FARTHER))], None),
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


BEYOND = (1.0 + 9e-13, 1.0 + 3e-14, 1.0 + 2e-16, 1.0)


@pytest.mark.parametrize("x", [1.7763568394002505e-15, -1.7763568394002505e-15, 1e-13])
def test_what_is_left_of_a_distance_from_the_right_end_is_at_the_left_end(x):
    """As 4.23 + 6.05 - 10.28 is: a piece as short lost all reactions in rounding."""
    supports = [{"x": 10.28}, {"x": x, "side": "below", "gap": 0.009}]
    loads = [{"type": "uniform", "q": 6.6, "from": x}, {"type": "force", "x": x, "F": 1.0}]
    made = {"beam": {"spans": [4.23, 6.05], "EI": 2343.79}, "supports": supports, "loads": loads}
    result = gapbeam.solve(made)
    assert result.steps[-1].reaction == pytest.approx([6.6 * 10.28 / 2, 6.6 * 10.28 / 2 + 1.0], rel=1e-13)


@pytest.mark.parametrize("x", BEYOND)
def test_what_lies_beyond_the_end_by_rounding_is_at_the_end(x):
    """Sums of spans are off by more than the last digits: ten thousand tenths by 1e-13 of their sum and more."""
    begin = 1.0 - x
    made = scene(
        [0.25] * 4, [at(x=begin), at(x=x)],
        [uniform(2.0, **stretch(begin, x)), force(x, 3.0), force(begin, 4.0), moment(x, 0.5), curvature(0.1, **stretch(0.5, x))],
        sections=[{**stretch(0.5, x), "EI": 2.0}],
    )  # fmt: skip
    made["foundation"] = [{**stretch(0.75, x), "k": 1e-3}]
    right = scene(
        [0.25] * 4, [at(x=0.0), at(x=1.0)],
        [uniform(2.0), force(1.0, 3.0), force(0.0, 4.0), moment(1.0, 0.5), curvature(0.1, **stretch(0.5, 1.0))],
        sections=[{**stretch(0.5, 1.0), "EI": 2.0}],
    )  # fmt: skip
    right["foundation"] = [{**stretch(0.75, 1.0), "k": 1e-3}]
    found, known = (gapbeam.solve(one) for one in (made, right))
    assert found.steps[-1].reaction.tolist() == known.steps[-1].reaction.tolist()
    assert found._pairs_of_extremes() == known._pairs_of_extremes()
    assert found.at([begin, x], side="left").moment.tolist() == known.at([0.0, 1.0], side="left").moment.tolist()


def test_a_sum_in_doubles_is_the_end():
    spans = [0.1] * 10_000
    x = sum(spans)
    assert x - 1000.0 > 64 * np.finfo(float).eps * 1000.0
    result = gapbeam.solve(scene(spans, [at(0), at(x=x)], [uniform(1.0, to=x)], EI=1e6))
    assert result.steps[-1].reaction == pytest.approx([500.0, 500.0], rel=1e-12)


@pytest.mark.parametrize("x", [1.0 + 2e-12, -2e-12])
def test_what_lies_farther_out_is_refused(x):
    for made in (
        scene([0.5, 0.5], [at(0), at(x=x)]),
        scene([0.5, 0.5], [at(0), at(2)], [force(x, 1.0)]),
        scene([0.5, 0.5], [at(0), at(2)], [uniform(1.0, **(stretch(x, 0.5) if x < 0.0 else stretch(0.5, x)))]),
    ):
        with pytest.raises(SceneError, match="is outside the beam, which runs from x = 0 to x = 1"):
            gapbeam.solve(made)


@pytest.mark.parametrize("both", [False, True])
def test_axles_beyond_an_end_by_rounding_are_at_it(both):
    made = scene([0.5, 0.5], [at(0), at(2)])
    made["trains"] = [{"axles": [[0.0, 2.0], [0.25, 1.0]], "from": -9e-13, "to": 1.25 + 9e-13, "both_directions": both}]
    train = gapbeam.solve(made).trains["train 1"]
    assert train.state(1.0 + 1e-14).reaction == pytest.approx([0.25, 2.75])
    assert train.state(-1e-14).reaction == pytest.approx([2.0, 0.0])
    assert train.state(1.25 + 1e-14).reaction == pytest.approx([0.0, 1.0])
    made["trains"][0]["from"] = 1.25 + 9e-13
    made["trains"][0]["to"] = 1.25 + 9e-13
    envelope = gapbeam.solve(made).envelope()
    largest = envelope.supports[1]["reaction"]["max"].value
    assert largest == pytest.approx(1.0)


@pytest.mark.parametrize("ground", [False, True])
def test_trains_as_long_as_the_beam_but_for_rounding(ground):
    """Its length is a sum of the spans in another order: both ends act where it is inside, whichever way it goes."""
    made = scene([0.1] * 10, [at(0), at(10)], EI=10.0)
    made["trains"] = [{"axles": [[0.0, 1.0], [1.0 + 3e-13, 2.0]], "q": 3.0, "inside": True, "both_directions": True}]
    if ground:
        made["foundation"] = [{"k": 1e-9}]
    result = gapbeam.solve(made)
    for position, direction, ends in ((1.0, "right", [3.5, 2.5]), (0.0, "left", [2.5, 3.5])):
        assert result.trains["train 1"].state(position, direction).reaction == pytest.approx(ends, rel=1e-6)
    largest = [row["reaction"]["max"].value for row in result.envelope().supports]
    assert largest == pytest.approx([3.5, 3.5], rel=1e-6)
    made["trains"][0]["axles"][1][0] = 1.0 + 2e-12
    with pytest.raises(SceneError, match="is nowhere inside the beam"):
        gapbeam.solve(made)


def test_load_stretches_without_length_act_on_nothing():
    loads = [uniform(2.0)]
    idle = [
        uniform(7.0, **stretch(0.3, 0.3)), uniform(7.0, **stretch(1.0, 1.0 + 5e-13)), linear(5.0, -3.0, **stretch(0.0, 0.0)),
        linear(5.0, -3.0, **stretch(0.75, 0.75 * (1 + 2e-16))), curvature(4.0, **stretch(0.5, 0.5)),
    ]  # fmt: skip
    supports = [at(0), at(1, side="below", gap=0.001), at(2)]
    known = gapbeam.solve(scene([0.5, 0.5], supports, loads)).steps[-1].reaction
    made = scene([0.5, 0.5], supports, [*loads, *idle])
    assert gapbeam.solve(made).steps[-1].reaction == pytest.approx(known, rel=1e-12)
    beam = gapbeam.prepare(made)
    for count in (1, 3, 40):
        cases = beam.solve(np.ones((count, 6)))
        assert cases.reaction == pytest.approx(np.tile(known, (count, 1)), rel=1e-12)
        alone = beam.solve(np.tile([0.0, 1.0, 1.0, 1.0, 1.0, 1.0], (count, 1)))
        assert np.abs(alone.reaction).max() == 0.0
        assert np.abs(alone.extremes["moment"]["max"].value).max() == 0.0
    made["loads"].pop()  # patterns are of distributed loads
    made["combinations"] = [{"name": "all", "factors": {"live": 1.0}, "expand": {"live": "spans"}}]
    without = {**made, "loads": loads}
    largest, right = (gapbeam.solve(one).envelope().supports[0]["reaction"]["max"].value for one in (made, without))
    assert largest == pytest.approx(right, rel=1e-12)
    for key in ("sections", "foundation"):
        wrong = scene([0.5, 0.5], supports, loads) | {key: [{**stretch(0.3, 0.3), "EI" if key == "sections" else "k": 1.0}]}
        with pytest.raises(SceneError, match=r"the stretch from = 0\.3 to = 0\.3 has no length"):
            gapbeam.solve(wrong)
    with pytest.raises(SceneError, match="has no length; from must be less than to"):
        gapbeam.solve(scene([0.5, 0.5], supports, [uniform(1.0, **stretch(0.4, 0.3))]))


def test_the_end_of_a_span_is_the_beginning_of_the_next():
    """With no distance from it, also where places differ from it by rounding; at the end of the beam that span is not there."""
    ends, near = np.array([0.0, 6.0, 9.0]), 0.9 * POSITION_TOLERANCE
    x = [0.0, 1.5, 6.0 * (1 - 2 * POSITION_TOLERANCE), *(6.0 * (1 + k * near) for k in (-1, 0, 1)), 7.5, 9.0 * (1 - near), 9.0]
    span, offset = locate(np.array(x), ends)
    assert span.tolist() == [0, 0, 0, 1, 1, 1, 1, 2, 2]
    assert offset.tolist() == [0.0, 1.5, x[2], 0.0, 0.0, 0.0, 1.5, 0.0, 0.0]
