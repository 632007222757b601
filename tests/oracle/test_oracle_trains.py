"""The reference solution of trains against closed forms, and against the reference solution of single states."""

import random
from fractions import Fraction

import mpmath
import pytest
from scenes import at, force, mirrored, scene, uniform
from scenes.train import NAMES, differences, exact_envelope, frozen, passages_of, random_scene, ties

import oracle

from . import envelope
from .polynomials import Place, roots
from .trains import Passage


def same(actual, expected, digits=40):
    """Equality to 40 digits."""
    with mpmath.workdps(60):
        assert abs(oracle.to_mpf(Fraction(actual)) - expected) <= mpmath.mpf(10) ** -digits * max(1, abs(expected))


def below(count):
    """Supports below at the first nodes."""
    return [at(i, side="below") for i in range(count)]


def test_roots_with_their_multiplicities():
    def product(*zeros):
        p = [Fraction(1)]
        for zero in zeros:
            p = [a - zero * b for a, b in zip([Fraction(0), *p], [*p, Fraction(0)], strict=True)]
        return p

    third = Fraction(1, 3)
    found = roots(product(third, third, Fraction(1, 2), Fraction(2)), Fraction(0), Fraction(2))
    assert [(round(float(place), 12), m) for place, m in found] == [(0.333333333333, 2), (0.5, 1)]
    assert found[1][0].same(Place.exact(Fraction(1, 2)))
    assert not found[0][0].same(Place.exact(third + Fraction(1, 10**60)))
    assert found[0][0] < Place.exact(third + Fraction(1, 10**60))
    assert roots([Fraction(1), Fraction(0), Fraction(1)], Fraction(-1), Fraction(1)) == []


def test_far_end_lifts():
    """D1 of the reference problems."""
    passage = Passage(scene([1.0, 1.0], below(3), [uniform(1.0)]), {"axles": [[0.0, 8.0]], "to": 1.0})
    opens, closes = passage.events
    assert [(e.support, e.event) for e in (opens, closes)] == [(2, "opens"), (2, "closes")]
    with mpmath.workdps(60):
        same(opens.place.middle, mpmath.findroot(lambda s: 16 * s * (1 - s**2) - 3, 0.1949))
        same(closes.place.middle, mpmath.findroot(lambda s: 16 * s * (1 - s**2) - 3, 0.8882))
        largest = envelope.opening(passage, 2)["max"]
        same(largest.places[0].position, 1 / mpmath.sqrt(3))
        same(largest.value, 8 * 2 / (18 * mpmath.sqrt(3)) - mpmath.mpf(1) / 4)
    light = scene([1.0, 1.0], below(3), [uniform(1.0)])
    assert not Passage(light, {"axles": [[0.0, 3.89]], "to": 1.0}).events  # 9 sqrt(3) / 4 = 3.897
    assert len(Passage(light, {"axles": [[0.0, 3.9]], "to": 1.0}).events) == 2


def test_stop_is_worst_where_it_is_reached():
    """D2 of the reference problems: the largest moment is not at the end of the load factors."""
    made = scene([2.0], [at(0), at(1), {"x": 1.0, "side": "below", "gap": 0.25}], [uniform(1.0)], EI=5.0)
    q = 76.8 * 5 * 0.25 / 16
    moments = [oracle.solve(made, factor).at(1.0).moment for factor in (0.99 * q, q, 1.01 * q)]
    same(Fraction(3), moments[1], 14)
    assert max(moments) == moments[1]


def test_influence_lines_of_a_simple_beam():
    P, a, L = 3, 2, 8
    made, train = scene([float(L)], [at(0), at(1)]), {"axles": [[0.0, float(P)], [float(a), float(P)]]}
    passage = Passage(made, train, at=[2.0])
    same(envelope.curve(passage, "moment", 2.0)["max"].value, Fraction(P * 2 * 6 + P * 2 * 4, L))
    same(envelope.curve(passage, "shear", 2.0)["max"].value, Fraction(P * 6 + P * 4, L))
    same(envelope.curve(passage, "shear", 2.0)["min"].value, Fraction(-P * 2, L))
    largest = envelope.extremes(passage, "moment")["max"]
    same(largest.value, Fraction(P * (2 * L - a) ** 2, 8 * L))  # the first or second axle a quarter of a off the middle
    assert sorted((w.position, w.x) for w in largest.places) == [(4.5, 4.5), (5.5, 3.5)]
    same(envelope.reaction(passage, 0)["max"].value, P + Fraction(P * (L - a), L))
    single = Passage(made, {"axles": [[0.0, 48.0]]})
    largest = envelope.deflection(single)["max"]
    assert float(largest.value) == pytest.approx(L**3, rel=1e-12)
    assert [float(w.x) for w in largest.places] == pytest.approx([4.0], abs=1e-5)


def test_influence_lines_of_two_spans():
    passage = Passage(scene([1.0, 1.0], [at(0), at(1), at(2)]), {"axles": [[0.0, 1.0]]}, at=[1.0])
    hogging = envelope.curve(passage, "moment", 1.0)["min"]
    with mpmath.workdps(60):
        root = mpmath.sqrt(3)
        same(hogging.value, -1 / (6 * root))
        same(hogging.places[0].position, 1 / root)
    same(hogging.places[1].position + hogging.places[0].position, 2)
    same(envelope.reaction(passage, 1)["max"].value, 1)


def test_uniform_load_of_a_train():
    passage = Passage(scene([4.0], [at(0), at(1)]), {"axles": [[0.0, 0.0], [1.0, 0.0]], "q": 6.0, "factor": 0.5})
    same(envelope.extremes(passage, "moment")["max"].value, 3 * (2 * 4 - 1) / Fraction(8))
    same(envelope.reaction(passage, 0)["max"].value, 3 * Fraction(7, 8))


def test_beam_tips_under_the_train():
    """Weight 6 at 3, supports at 0 and 4: an axle of 4 beyond 5.5 tips it, until it leaves at 6."""
    made = scene([4.0, 2.0], below(2), [uniform(1.0)])
    passage = Passage(made, {"axles": [[0.0, 4.0], [10.0, 1.0]]})
    assert [(a.middle, b.middle) for a, b in passage.gaps] == [(Fraction(11, 2), 6)]
    assert passage.gaps[0][1].same(Place.exact(6))
    same(envelope.reaction(passage, 0)["min"].value, 0)
    assert [(float(e.place), e.support) for e in passage.events] == []
    loose = Passage(scene([4.0, 2.0], below(2)), {"axles": [[0.0, 4.0]]})
    assert [s.status for s in loose.stretches][-1] == "no-equilibrium"


def test_values_jump_at_a_free_end():
    made = scene([2.0], [at(0, rotation="fixed")], [force(1.0, 1.0)])
    passage = Passage(made, {"axles": [[0.0, 5.0], [1.0, 5.0]], "to": 3.0})
    moments = envelope.extremes(passage, "moment")["min"]
    same(moments.value, -16)
    assert [(w.position, w.x) for w in moments.places] == [(2, 0)]
    gap = Passage(scene([2.0], [at(0, rotation="fixed"), at(1, side="below", gap=1.0)]), {"axles": [[0.0, 1.0]], "to": 2.5})
    assert [(float(e.place), e.event) for e in gap.events][-1] == (2.0, "opens")


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("touches", []),
        ("hardly closes", [(2, "closes"), (2, "opens")]),
        ("changes sides", [(0, "opens"), (0, "closes"), (3, "opens"), (3, "closes")]),
        ("touches all along", []),
        ("overhangs at both ends", []),
        ("leaves a free end", [(1, "closes"), (1, "opens"), (1, "closes")]),
    ],
)
def test_ties(name, expected):
    ahead, *back = passages_of(ties()[name])
    assert [(e.support, e.event) for e in ahead.events] == expected
    turned = {"opens": "closes", "closes": "opens"}
    if name == "changes sides":
        assert ahead.events[1].place.same(ahead.events[2].place)
    for passage in back:
        assert [(e.support, turned[e.event]) for e in reversed(passage.events)] in (expected, [])


@pytest.mark.parametrize("seed", [0, 5, 17, 27])
def test_random_passages_against_single_states(seed):
    made, rng = random_scene(seed), random.Random(seed)
    passages = passages_of(made)
    found = exact_envelope(passages)
    for passage in passages:
        for stretch in rng.sample(passage.stretches, min(5, len(passage.stretches))):
            s = Fraction(float(stretch.inside))
            answer = oracle.solve(frozen(made, float(s), passage.mirrored))
            assert {"indifferent": "loose"}.get(answer.status, answer.status) == stretch.status
            if stretch.status != "solved":
                continue
            for i, limits in enumerate(found["supports"]):
                p = stretch.unknowns[passage.force_column + i]
                same(sum(c * s**k for k, c in enumerate(p)), answer.reaction[i], 30)
                assert stretch.state[i] in ("tied", answer.state[i]) or answer.tied[i]
                pushed, opening = (Fraction(float(number)) for number in (answer.reaction[i], answer.opening[i]))
                room = 1e-14 * max(1, abs(pushed))
                assert limits["reaction"]["min"].value - room <= pushed <= limits["reaction"]["max"].value + room
                assert opening <= limits["opening"]["max"].value + room
            for x in (rng.uniform(0, float(passage.length)) for _ in range(4)):
                for name, limits in found["extremes"].items():
                    number, room = getattr(answer.at(x), name), 1e-12 * abs(limits["max"].value - limits["min"].value)
                    assert limits["min"].value - room <= Fraction(float(number)) <= limits["max"].value + room


@pytest.mark.parametrize("seed", [12, 50])
def test_seen_from_behind(seed):
    made = random_scene(seed)
    train = {key: value for key, value in made.pop("trains")[0].items() if key not in ("from", "to")}
    ahead, behind = Passage(made, train), Passage(mirrored(made), train, mirrored=True)
    assert [(e.support, e.event) for e in ahead.events] == [(e.support, e.event) for e in behind.events]
    for one, other in zip(ahead.events, behind.events, strict=True):
        same(one.place.middle, oracle.to_mpf(ahead.length - other.place.middle))
    assert ahead.events


def test_comparison_finds_what_differs():
    made = scene([1.0, 1.0], below(3), [uniform(1.0)])
    made["trains"] = [{"axles": [[0.0, 8.0]], "to": 1.0}]
    passages, xs = passages_of(made, [0.5]), [0.5]
    exact = exact_envelope(passages, xs)

    def plain(limits):
        return {end: [float(limit.value), {"position": float(limit.places[0].position)}] for end, limit in limits.items()}

    def curves(name):
        return {end: [float(limits[end].value) for limits in exact["fields"][name]] for end in ("max", "min")}

    data = {
        "trains": [{"events": [{"position": 0.194903920083, "support": 2, "event": "opens"},
                               {"position": 0.888199776858, "support": 2, "event": "closes"}]}],
        "envelope": {"supports": [{name: plain(limits) for name, limits in support.items()} for support in exact["supports"]],
                     "extremes": {name: plain(limits) for name, limits in exact["extremes"].items()},
                     "fields": {"x": xs, **{name: curves(name) for name in NAMES}}},
    }
    assert differences(made, data, xs) == []
    data["envelope"]["supports"][2]["opening"]["max"][0] += 1e-8
    data["envelope"]["fields"]["moment"]["min"][0] += 1e-8
    data["trains"][0]["events"].pop()
    assert [words.split(":")[0] for words in differences(made, data, xs)] == [
        "running to the right", "max of opening 2", "min of moment at 0.5"]
