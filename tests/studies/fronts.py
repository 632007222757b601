"""Beams on many one-sided supports close to each other, lifted here and there: fronts of contact, drawn at random."""

from __future__ import annotations

import random
from typing import Any

BASES = ("rigid", "rigid", "rigid", "stiff", "curved")
"""Bases, to be drawn from: rigid and flat, stiff springs, rigid and sagging."""
SPACINGS = ("equal", "equal", "graded", "jittered")
"""How the distances of the supports vary."""
LIFTS = ("end", "both ends", "inside", "couple", "end and inside", "eight forces")
"""What lifts the beam."""


def random_front(seed: int, count: int) -> tuple[str, dict[str, Any]]:
    """Draw a heavy beam on a base of many supports.

    Parameters
    ----------
    seed : int
        Of the random numbers; the same seed gives the same beam whatever the count.
    count : int
        Supports.

    Returns
    -------
    str
        What it is.
    dict
        The scene; the weight is dead load, what lifts the beam is live load.

    Examples
    --------
    >>> name, scene = random_front(2, 100)
    >>> name, len(scene["supports"])
    ('inside, rigid, equal', 100)
    """
    rng = random.Random(seed)
    length = rng.choice((5.0, 20.0, 20.0, 80.0, 300.0))
    spacing = rng.choice(SPACINGS)
    grade, EI, q, base = rng.choice((0.2, 5.0)), 10 ** rng.uniform(-2, 3), 10 ** rng.uniform(-1, 1), rng.choice(BASES)
    lift = rng.choice(LIFTS)
    loads = [{"type": "uniform", "q": q, "case": "dead"}, *_lift(rng, lift, q, length)]
    supports: list[dict[str, Any]] = [{"node": i, "side": "below"} for i in range(count)]
    decay, sag = 10 ** rng.uniform(-1, 1) * length / count, rng.uniform(0.0, 0.002) * q * length**2 / EI
    spans = [1.0] * (count - 1)
    if spacing == "graded":
        spans = [1.0 + (grade - 1.0) * i / (count - 1) for i in range(count - 1)]
    elif spacing == "jittered":
        spans = [rng.uniform(0.5, 1.5) for _ in spans]
    total, x = sum(spans), 0.0
    spans = [span * length / total for span in spans]
    for i, support in enumerate(supports):
        if base == "stiff":
            support["stiffness"] = 4.0 * EI / decay**4 * length / count
        elif base == "curved":
            support["gap"] = sag * x * (length - x)
            x = min(length, x + (spans[i] if i < count - 1 else 0.0))
    return f"{lift}, {base}, {spacing}", {"beam": {"spans": spans, "EI": EI}, "supports": supports, "loads": loads}


def _lift(rng: random.Random, lift: str, q: float, length: float) -> list[dict[str, Any]]:
    weight = q * length

    def force(x: float, share: float) -> dict[str, Any]:
        return {"type": "force", "x": x, "F": -share * weight}

    loads = []
    if lift in ("end", "both ends", "end and inside"):
        loads.append(force(0.0, rng.uniform(0.01, 0.2)))
    if lift == "both ends":
        loads.append(force(length, rng.uniform(0.01, 0.2)))
    if lift in ("inside", "end and inside"):
        loads.append(force(rng.uniform(0.4, 0.7) * length, rng.uniform(0.02, 0.2)))
    if lift == "couple":
        couple = weight * length * rng.uniform(0.0005, 0.01)
        loads.append({"type": "moment", "x": rng.uniform(0.3, 0.7) * length, "M": couple})
    if lift == "eight forces":
        loads += [force(rng.uniform(0.0, 1.0) * length, rng.uniform(-0.03, 0.03)) for _ in range(8)]
    return loads


def scaled(scene: dict[str, Any], share: float) -> dict[str, Any]:
    """Multiply the live loads of a scene.

    Parameters
    ----------
    scene : dict
        A scene of `random_front`; it is left as it is.
    share : float
        The factor.

    Returns
    -------
    dict
        The new scene.
    """
    loads = [load | {key: share * load[key] for key in ("F", "M") if key in load} for load in scene["loads"]]
    return scene | {"loads": loads}
