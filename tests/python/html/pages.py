"""Pages that the tests look into, and their data."""

import json
import re

import gapbeam

SUPPORTS = [gapbeam.Support(node=i, side="below", gap=0.002 * (i == 2), name=name) for i, name in enumerate("ABCD")]
LOADS = [gapbeam.UniformLoad(q=2.0, case="dead"), gapbeam.ForceLoad(x=3.0, F=160.0, case="crane"),
         gapbeam.ForceLoad(node=3, F=-6.0, case="crane")]  # fmt: skip
UNITS = gapbeam.Units("kN", "m")
EVENTS = gapbeam.Analysis(follow="events")


def scene(**more):
    """Three spans whose third and fourth bearing lift off."""
    beam = gapbeam.Beam(spans=[6.0, 6.0, 6.0], EI=1e4)
    given = {"title": "Three spans", "units": UNITS, "beam": beam, "supports": SUPPORTS, "loads": LOADS, "analysis": EVENTS}
    return gapbeam.Scene(**(given | more))


def combined():
    """The same with two combinations."""
    rest, lift = {"dead": 1.0}, {"dead": 1.0, "crane": 1.5}
    return scene(combinations=[gapbeam.Combination(name="rest", factors=rest), gapbeam.Combination(name="lift", factors=lift)])


def train(**more):
    """The same with a crane that goes both ways: a spring, shear, a hinge, and a uniform load between its axles."""
    crane = gapbeam.Train(name="crane", axles=[(0.0, 100.0), (2.0, 60.0)], both_directions=True, q=5.0)
    beam = gapbeam.Beam(spans=[6.0, 6.0, 6.0], EI=[1e4, 2e4, 1e4], GA=3e4, hinges=[8.0])
    supports = [gapbeam.Support(node=0, stiffness=2e4), *SUPPORTS[1:]]
    given = {"beam": beam, "supports": supports, "loads": LOADS[:1], "trains": [crane], "analysis": gapbeam.Analysis()}
    return scene(**(given | more))


def on_ground():
    """A beam on ground that cannot pull."""
    return gapbeam.Scene(
        title="Footing", units=UNITS, beam=gapbeam.Beam(spans=[6.0], EI=1e5), foundation=[gapbeam.Foundation(k=6e4, side="below")],
        loads=[gapbeam.UniformLoad(q=30.0, case="dead"), gapbeam.MomentLoad(x=3.0, M=400.0)], analysis=EVENTS,
    )  # fmt: skip


def see_saw():
    """A beam that tips."""
    return scene(beam=gapbeam.Beam(spans=[4.0, 2.0], EI=1e4), supports=SUPPORTS[:2], loads=[gapbeam.ForceLoad(node=2, F=5.0)])


def fifty(gap=0.003):
    """Fifty bearings with small gaps, of which many open and close while the load grows."""
    supports = [gapbeam.Support(node=i, side="below", gap=gap * (i % 3), name=f"P{i}") for i in range(50)]
    loads = [gapbeam.ForceLoad(x=3.0 + 6.0 * i, F=40.0 + (37 * i) % 90 if i % 3 else -80.0) for i in range(48)]
    beam = gapbeam.Beam(spans=[6.0] * 49, EI=2.4e4)
    return scene(title="Fifty supports", beam=beam, supports=supports, loads=[LOADS[0], *loads])


def data_of(page):
    """The data that a page carries."""
    return json.loads(re.search(r'id="gapbeam-data">(.*?)</script>', page, re.DOTALL)[1])


def without_seconds(value):
    """A result as plain data without run times."""
    if isinstance(value, dict):
        return {key: without_seconds(one) for key, one in value.items() if key != "seconds"}
    return [without_seconds(one) for one in value] if isinstance(value, list) else value
