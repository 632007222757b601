"""Vehicles of codes as trains of a scene: forces in kN, lengths in m."""

from __future__ import annotations

from collections.abc import Sequence
from math import sqrt
from typing import Any

import numpy as np

from ..base.errors import SceneError
from .given import check_above_zero, check_between, check_not_negative

LM1_TANDEM = {1: 300.0, 2: 200.0, 3: 100.0}
"""Axle loads (kN) by lane, two axles 1.2 m apart: EN 1991-2, 4.3.2, table 4.2. Quoted: "EU-TS300 - 2 axles 300kN each", "EU-TS200
- 2 axles 200kN each", "EU-TS100 - 2 axles 100kN each" (Oasys GSA 10.2, Eurocode Loading); L. Davaine, Bridge design with Eurocodes
(JRC), D1.8: "LM1 tandem systems 300/200/100 kN per axle", spacing 1.2 m."""
LM1_UNIFORM = {1: 9.0, 2: 2.5, 3: 2.5}
"""Uniform load (kN/m2) by lane, from the same: "Lane1 - UDL 9x(path width) kN/m", "Lane2 - UDL 2.5x(path width) kN/m", "normally
applied to 3m wide lanes"."""
TRACKS = {"standard": (2.16, 0.73, 2.0), "careful": (1.44, 0.82, 1.67)}
"""Dynamic factors a/(sqrt(length) - 0.2) + b with their most, EN 1991-2, (6.4) and (6.5). Quoted: "phi = 2.16/(sqrt(L_phi) - 0.2) +
0.73 ... 1.1079 for L_phi = 35 m" (standard maintenance, a program after a bridge report); for L = 15.3 "1.44/(sqrt L - 0.2) + 0.82
= 1.208" (zanotowane.pl, Steel railway bridge design); "Phi2 (carefully maintained track), Phi3 (standard maintenance)"."""
HOISTING = {"HC1": (1.05, 0.17), "HC2": (1.10, 0.34), "HC3": (1.15, 0.51), "HC4": (1.20, 0.68)}
"""Least factor and its growth with the hoisting speed (s/m): EN 1991-3, 2.6, table 2.5, the same as FEM 1.001, T.9.3.a. Quoted
from a program after FEM: "HC1: { beta2: 0.17, phi2Min: 1.05 }, HC2: { beta2: 0.34, phi2Min: 1.1 }, HC3: { beta2: 0.51, phi2Min:
1.15 }, HC4: { beta2: 0.68, phi2Min: 1.2 }", and from one after AS 5221.1:2021: "phi_2 = phi_2_min + beta_2 * v_h"."""


def lm1(lane: int | Sequence[int] = 1, *, alpha: float = 1.0) -> dict[str, Any]:
    """Give the tandem system of Load Model 1 of EN 1991-2 in a lane, or in lanes side by side.

    Its forces include the dynamic amplification (4.3.2), so that the train has no factor. Only whole tandem systems act, so it is
    ``inside``.

    Parameters
    ----------
    lane : {1, 2, 3} or sequence of them
        Number of the notional lane; of several the axles add up, for a beam that carries them all.
    alpha : float
        Adjustment factor alpha_Q of the national annex (no unit).

    Returns
    -------
    dict
        A train: two axles (kN), 1.2 m apart, in the case ``ts``.

    Examples
    --------
    >>> lm1()["axles"], lm1((1, 2, 3))["axles"]
    ([(0.0, 300.0), (1.2, 300.0)], [(0.0, 600.0), (1.2, 600.0)])
    """
    lanes = _lanes("lm1", lane)
    force = _alpha("lm1", alpha) * sum(LM1_TANDEM[one] for one in lanes)
    return {"name": f"LM1 lane {'+'.join(map(str, lanes))}", "axles": [(0.0, force), (1.2, force)], "case": "ts", "inside": True}


def lm1_lane(lane: int | Sequence[int] = 1, *, width: float = 3.0, alpha: float = 1.0) -> dict[str, Any]:
    """Give the uniform load of Load Model 1 of EN 1991-2 in a lane or in several, over the whole beam.

    Parameters
    ----------
    lane : {1, 2, 3} or sequence of them
        Number of the notional lane; of several the loads add up.
    width : float
        Of every lane (m), or of the part of it that the beam carries.
    alpha : float
        Adjustment factor alpha_q of the national annex (no unit).

    Returns
    -------
    dict
        A load (kN/m) in the case ``udl``; ``expand = {"udl": "spans"}`` of a combination places it by spans.

    Examples
    --------
    >>> lm1_lane()["q"], lm1_lane((1, 2))["q"]
    (27.0, 34.5)
    """
    check_not_negative("lm1_lane", width=width)
    q = width * sum(LM1_UNIFORM[one] for one in _lanes("lm1_lane", lane))
    return {"type": "uniform", "q": _alpha("lm1_lane", alpha) * q, "case": "udl"}


def _lanes(place: str, lane: int | Sequence[int]) -> list[int]:
    """Lanes as a list, each of them once."""
    lanes = [lane] if isinstance(lane, int) else list(lane)
    if not lanes or not set(lanes) <= set(LM1_TANDEM) or len(set(lanes)) < len(lanes):
        raise SceneError(f"{place}: lane", f"there are the lanes 1, 2 and 3, each of them once, got {lane}")
    return lanes


def _alpha(place: str, alpha: float) -> float:
    check_not_negative(place, alpha=alpha)
    return alpha


def lm71(*, dynamic: float = 1.0, alpha: float = 1.0, ahead: float = 0.0, behind: float = 0.0) -> dict[str, Any]:
    """Give Load Model 71 of EN 1991-2, 6.3.2: four axles of 250 kN, 1.6 m apart, and 80 kN/m from 0.8 m beside them on.

    Quoted: "nAxes= 4, axleLoad= 250e3, xSpacing= 1.6" (XC, EC1_rail_load_models.py); a worked bridge of the Polish code, which has
    the same model, "locomotive 156 kN/m, a = 6.4 m", "wagons 80 kN/m": 6.4 m = 3*1.6 + 2*0.8, 156 kN/m = 1000 kN over them.

    Parameters
    ----------
    dynamic : float
        Dynamic factor (no unit), the ``factor`` of the train: `rail_dynamic_factor`. It is not a load factor.
    alpha : float
        Classification factor of the line (no unit).
    ahead, behind : float
        Lengths (m) of the uniform load before and behind the axles; default none.

    Returns
    -------
    dict
        A train (kN, m), whose place is that of its first axle.

    Examples
    --------
    >>> lm71()["axles"][1], lm71(ahead=10.0, behind=20.0)["q"]
    ((1.6, 250.0), [(-10.8, -0.8, 80.0), (5.6, 25.6, 80.0)])
    """
    check_above_zero("lm71", dynamic=dynamic, alpha=alpha)
    check_not_negative("lm71", ahead=ahead, behind=behind)
    axles = [(place, 250.0 * alpha) for place in (0.0, 1.6, 3.2, 4.8)]
    stretches = ((-0.8 - ahead, -0.8), (5.6, 5.6 + behind))
    q = [(first, last, 80.0 * alpha) for first, last in stretches if last > first]
    train: dict[str, Any] = {"name": "LM71", "axles": axles, "factor": dynamic}
    return train | {"q": q} if q else train


def rail_dynamic_factor(length: float, track: str = "standard") -> float:
    """Give the dynamic factor of EN 1991-2, 6.4.5.2, by the maintenance of the track; at least 1, at most as in `TRACKS`.

    Parameters
    ----------
    length : float
        Determinant length (m) of table 6.2.
    track : {"standard", "careful"}
        Track with standard maintenance, or carefully maintained track.

    Returns
    -------
    float

    Examples
    --------
    >>> round(rail_dynamic_factor(35.0), 4), round(rail_dynamic_factor(15.3, "careful"), 3)
    (1.1079, 1.208)
    """
    check_above_zero("rail_dynamic_factor", length=length)
    if track not in TRACKS:
        raise SceneError("rail_dynamic_factor: track", f"expected {' or '.join(map(repr, TRACKS))}, got {track!r}")
    growth, base, most = TRACKS[track]
    root = sqrt(length) - 0.2
    return min(max(growth / root + base, 1.0), most) if root > 0.0 else most


def hl93_truck(rear_spacing: float = 4.3, *, dynamic: float = 1.33) -> dict[str, Any]:
    """Give the design truck of AASHTO LRFD, 3.6.1.2.2: axles of 35, 145 and 145 kN, the first two 4.3 m apart.

    Quoted: "the spacing between the two 145 000-N axles shall be varied between 4300 and 9000 mm to produce extreme force effects"
    (AASHTO LRFD 2008, SI, figure 3.6.1.2.2-1).

    Parameters
    ----------
    rear_spacing : float
        Of the two rear axles (m), 4.3 to 9.0; `hl93_trucks` has the whole range.
    dynamic : float
        1 + IM of 3.6.2 (no unit), the ``factor`` of the train; default 1 + 33 %. It is not a load factor.

    Returns
    -------
    dict
        A train (kN, m), in both directions.

    Examples
    --------
    >>> hl93_truck(9.0)["axles"]
    [(0.0, 35.0), (4.3, 145.0), (13.3, 145.0)]
    """
    check_between("hl93_truck", "rear_spacing", rear_spacing, 4.3, 9.0)
    check_above_zero("hl93_truck", dynamic=dynamic)
    axles = [(0.0, 35.0), (4.3, 145.0), (4.3 + rear_spacing, 145.0)]
    return {"name": f"HL-93 truck {rear_spacing:g} m", "axles": axles, "factor": dynamic, "both_directions": True}


def hl93_trucks(count: int = 6, *, dynamic: float = 1.33) -> list[dict[str, Any]]:
    """Give the design truck with the spacing of its rear axles from 4.3 to 9.0 m, both ends included.

    Parameters
    ----------
    count : int
        How many spacings, 2 or more, at equal distances.
    dynamic : float
        As of `hl93_truck`.

    Returns
    -------
    list of dict
        Trains, each with its spacing in its name.

    Examples
    --------
    >>> [truck["name"] for truck in hl93_trucks(3)]
    ['HL-93 truck 4.3 m', 'HL-93 truck 6.65 m', 'HL-93 truck 9 m']
    """
    if not isinstance(count, int) or count < 2:
        raise SceneError("hl93_trucks: count", f"expected 2 or more spacings, got {count!r}")
    return [hl93_truck(9.0 if k == count - 1 else 4.3 + 4.7 * k / (count - 1), dynamic=dynamic) for k in range(count)]


def hl93_tandem(*, dynamic: float = 1.33) -> dict[str, Any]:
    """Give the design tandem of AASHTO LRFD, 3.6.1.2.3.

    Quoted: "a pair of 110 000-N axles spaced 1200 mm apart" (AASHTO LRFD 2008, SI).

    Parameters
    ----------
    dynamic : float
        As of `hl93_truck`.

    Returns
    -------
    dict
        A train (kN, m).

    Examples
    --------
    >>> hl93_tandem()["axles"]
    [(0.0, 110.0), (1.2, 110.0)]
    """
    check_above_zero("hl93_tandem", dynamic=dynamic)
    return {"name": "HL-93 tandem", "axles": [(0.0, 110.0), (1.2, 110.0)], "factor": dynamic}


def hl93_lane() -> dict[str, Any]:
    """Give the design lane load of AASHTO LRFD, 3.6.1.2.4, over the whole beam.

    Quoted: "a load of 9.3 N/mm uniformly distributed in the longitudinal direction", "shall not be subject to a dynamic load
    allowance" (AASHTO LRFD 2008, SI).

    Returns
    -------
    dict
        A load (kN/m) in the case ``lane``.

    Examples
    --------
    >>> hl93_lane()
    {'type': 'uniform', 'q': 9.3, 'case': 'lane'}
    """
    return {"type": "uniform", "q": 9.3, "case": "lane"}


def crane_pair(
    first: Sequence[tuple[float, float]], second: Sequence[tuple[float, float]], distance: float, *, dynamic: float = 1.0
) -> list[dict[str, Any]]:
    """Give two cranes on one runway, each alone and both together; units are any.

    Parameters
    ----------
    first, second : sequence of (float, float)
        Wheels of each crane: distance behind its first one, and static force.
    distance : float
        From the first wheel of the first crane back to the first wheel of the second, buffer to buffer.
    dynamic : float
        Dynamic factor (no unit) of all wheels, the ``factor`` of both trains: `hoisting_factor`. It is not a load factor.

    Returns
    -------
    list of dict
        The trains ``crane 1``, ``crane 2`` and ``both``, which stay on the runway.

    Raises
    ------
    SceneError
        The second crane would stand in the first.

    Examples
    --------
    >>> trains = crane_pair([(0.0, 180.0), (3.6, 180.0)], [(0.0, 120.0), (3.2, 120.0)], 5.5)
    >>> trains[2]["together"]
    [('crane 1', 0.0), ('crane 2', 5.5)]
    """
    check_above_zero("crane_pair", dynamic=dynamic, distance=distance)
    for name, axles in (("first", first), ("second", second)):
        if np.asarray(axles, dtype=object).shape[1:] != (2,):
            raise SceneError(f"crane_pair: {name}", f"expected pairs of a distance and a force, got {axles!r}")
    length = max((place for place, _ in first), default=0.0)
    if not distance > length:
        problem = f"{distance:g} is within the first crane, whose wheels stand over {length:g}; give a greater one"
        raise SceneError("crane_pair: distance", problem)
    names = "crane 1", "crane 2"
    wheels = zip(names, (first, second), strict=True)
    alone: list[dict[str, Any]] = [{"name": n, "axles": list(axles), "factor": dynamic, "inside": True} for n, axles in wheels]
    return [*alone, {"name": "both", "together": list(zip(names, (0.0, distance), strict=True)), "inside": True}]


def hoisting_factor(speed: float, hoisting_class: str = "HC2") -> float:
    """Give the dynamic factor phi2 of EN 1991-3, 2.6, of a load that is hoisted from the ground: phi2min + beta2*speed.

    Parameters
    ----------
    speed : float
        Steady hoisting speed (m/s).
    hoisting_class : {"HC1", "HC2", "HC3", "HC4"}
        Hoisting class of the crane.

    Returns
    -------
    float

    Examples
    --------
    >>> round(hoisting_factor(20.0 / 60.0, "HC4"), 2)
    1.43
    """
    check_not_negative("hoisting_factor", speed=speed)
    if hoisting_class not in HOISTING:
        raise SceneError("hoisting_factor: hoisting_class", f"the classes are {', '.join(HOISTING)}, got {hoisting_class!r}")
    least, growth = HOISTING[hoisting_class]
    return least + growth * speed
