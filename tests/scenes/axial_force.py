"""Random scenes with axial forces of second order, for comparison with `oracle/axial_force.py`.

Lengths are multiples of 1/8, all other numbers have three digits. Compressions are parts of a buckling factor, which the
oracle is asked for.
"""

import random

import oracle.axial_modes as modes

from .foundation import digits, eighths, part, rounded
from .plain import at, curvature, force, linear, moment, nodes_of, place, scene, stretch, uniform
from .tapered import taper


def random_scene(seed, *, compression=None, ground=None, u=(1e-6, 1e4), mass=False, tapers=False):
    """A scene of 1 to 5 spans under tension, or under some compression as well.

    Parameters
    ----------
    seed : int
    compression : float, optional
        None: tension only. Otherwise some spans are compressed, and all N have this part of the first buckling factor of the
        beam with all one-sided supports open; such a scene is held without them.
    ground : bool, optional
        Whether there are two-sided foundations, sometimes with `shear`; None: in one of four.
    u : (float, float)
        Bounds of sqrt(N L^2/EI) of a span.
    mass : bool
        Also a mass of the beam for every span.
    tapers : bool
        Also one or two sections whose EI changes.

    Returns
    -------
    dict
    """
    rng = random.Random(f"{seed} {compression} {ground}")
    spans = [eighths(rng, 1, 8) for _ in range(rng.choice((1, 1, 2, 2, 3, 4, 5)))]
    length, EI = sum(spans), rounded(rng, 1e-3, 1e6)
    one = rng.random() < 0.6
    made = scene(spans, [], EI=EI if one else [rounded(rng, EI / 30, EI * 30) for _ in spans])
    beam = made["beam"]
    rigidity = [EI] * len(spans) if one else beam["EI"]
    beam["N"] = [digits(rounded(rng, *u) ** 2 * B / L**2) for B, L in zip(rigidity, spans, strict=True)]
    if rng.random() < 0.5:
        beam["N"] = beam["N"][0]
    elif len(spans) > 2 and rng.random() < 0.3:
        beam["N"][rng.randrange(len(spans))] = 0.0
    if rng.random() < 0.3:
        beam["GA"] = digits(rounded(rng, 0.3, 300) * EI * 30 / length**2)
    if mass:
        beam["mass"] = [rounded(rng, 0.1, 10) for _ in spans]
    pull = max(beam["N"]) if isinstance(beam["N"], list) else beam["N"]
    span = max(spans)
    size = rounded(rng, 1e-3, 1e3)  # of forces
    depth = size / (48 * EI / span**3 + (0 if compression is not None else 4 * pull / span))  # and what they bend
    _supports(rng, made, EI / span**3, depth, held=compression is not None or rng.random() < 0.8)
    _parts(rng, made, EI, length)
    for _ in range(rng.choice((1, 1, 2)) if tapers else 0):
        made.setdefault("sections", []).append(stretch(*part(rng, length), EI=taper(rng, EI)))
    if ground or (ground is None and rng.random() < 0.25):
        _ground(rng, made, EI, length)
    made["loads"] = [_load(rng, made, length, size, EI) for _ in range(rng.randint(1, 5))]
    made["loads"].append(uniform(digits(size * rng.uniform(0.1, 1) / length), case="dead"))
    return made if compression is None else _compressed(rng, made, compression)


def _supports(rng, made, k, depth, held):
    """Most nodes, and a few other places; no more than six one-sided supports."""
    length, count = nodes_of(made)[-1], len(made["beam"]["spans"])
    places = [{"node": i} for i in range(count + 1) if rng.random() < 0.8 or (held and i in (0, count))]
    places += [{"x": eighths(rng, 0.125, length - 0.125)} for _ in range(rng.choice((0, 1, 1, 2)))]
    seen, sided = [], 0
    for where in places:
        x = place(made, where)
        if x in seen:
            continue
        seen.append(x)
        kept = held and where.get("node") in (0, count)
        side = "both" if kept or sided > 5 else rng.choice(("both", "below", "below", "above", "pair"))
        values = {"stiffness": k * rounded(rng, 1e-2, 1e4)} if rng.random() < 0.3 and not kept else {}
        if rng.random() < 0.2:
            values["settlement"] = digits(depth * rng.uniform(-1, 1))
        if rng.random() < 0.2:
            values["rotation"] = rng.choice(("fixed", digits(k * length**2 * rng.uniform(0.01, 10))))
        values = {key: v if isinstance(v, str) else digits(v) for key, v in values.items()}
        gaps = [digits(depth * rng.uniform(-0.3, 1)) if rng.random() < 0.6 else 0.0 for _ in range(2)]
        if side == "pair":
            made["supports"].append({**where, **values, "side": "below", "gap": abs(gaps[0])})
            values.pop("rotation", None)
            made["supports"].append({**where, **values, "side": "above", "gap": abs(gaps[1]) or digits(depth / 3)})
            sided += 2
        elif side == "both":
            made["supports"].append({**where, **values})
        else:
            made["supports"].append({**where, **values, "side": side, "gap": gaps[0]})
            sided += 1
    if not seen:
        made["supports"] = [at(0, rotation="fixed")]
    rng.shuffle(made["supports"])


def _parts(rng, made, EI, length):
    """Sections, also of other N, and hinges where no support turns with the beam."""
    if rng.random() < 0.25:
        section = {"EI": rounded(rng, EI / 30, EI * 30)}
        if rng.random() < 0.5:
            numbers = made["beam"]["N"]
            section["N"] = digits((numbers if isinstance(numbers, float) else max(numbers)) * rng.uniform(0, 2))
        made["sections"] = [stretch(*part(rng, length), **section)]
    turned = {place(made, s) for s in made["supports"] if "rotation" in s}
    places = {eighths(rng, 0.125, length - 0.125) for _ in range(rng.choice((0, 0, 1, 2)))} - turned
    if places:
        made["beam"]["hinges"] = sorted(places)


def _ground(rng, made, EI, length):
    """One or two foundations that hold both ways."""
    made["foundation"] = []
    for _ in range(rng.choice((1, 1, 2))):
        k = digits(4 * EI * (rounded(rng, 0.3, 20) / length) ** 4)
        one = {"k": k if rng.random() < 0.7 else [digits(k * rng.uniform(0, 2)), k]}
        if rng.random() < 0.5:
            one |= stretch(*part(rng, length))
        if rng.random() < 0.4:
            one["shear"] = digits(rounded(rng, 1e-2, 1e2) * EI / length**2)
        made["foundation"].append(one)


def _load(rng, made, length, size, EI):
    """A load of any kind."""
    case = rng.choice(({}, {}, {"case": "dead"}))
    F, kind = digits(rng.choice((1, 1, 1, -1)) * rounded(rng, size / 5, size)), rng.random()
    if kind < 0.35:
        return {"type": "force", "node": rng.randrange(len(made["beam"]["spans"]) + 1), "F": F, **case} if kind < 0.1 else force(
            eighths(rng, 0, length), F, **case)  # fmt: skip
    if kind < 0.5:
        x = eighths(rng, 0, length)
        if x not in made["beam"].get("hinges", ()):
            return moment(x, digits(F * length * rng.uniform(0.01, 0.2)), **case)
    a, b = part(rng, length)
    q, case = digits(F / (b - a)), case | (stretch(a, b) if rng.random() < 0.7 else {})
    if kind < 0.7:
        return uniform(q, **case)
    if kind < 0.9:
        return linear(q, digits(q * rng.uniform(-1, 2)), **case)
    return curvature(digits(F * length / EI / 30), **case)


def with_imposed(rng, made):
    """The scene with rotations imposed on supports, couples beside hinges and curvatures that change, of the size of its loads.

    Parameters
    ----------
    rng : random.Random
    made : dict

    Returns
    -------
    dict
        A new one.
    """
    beam, length = made["beam"], nodes_of(made)[-1]
    EI = max(beam["EI"]) if isinstance(beam["EI"], list) else beam["EI"]
    F = max([abs(load.get("F", 0.0)) for load in made["loads"]] + [1e-9 * EI / length**2])
    loads = list(made["loads"])
    for k, support in enumerate(made["supports"]):
        alone = sum(place(made, other) == place(made, support) for other in made["supports"]) == 1
        if "rotation" in support and alone and rng.random() < 0.8:
            turn = {"type": "movement", "support": k, "rotation": digits(F * length**2 / EI * rng.uniform(-0.1, 0.1))}
            loads.append(turn | rng.choice(({}, {"case": "dead"})))
    for x in beam.get("hinges", ()):
        sides = [side for side in ("left", "right") if rng.random() < 0.6]
        loads += [moment(x, digits(F * length * rng.uniform(-0.2, 0.2)), at_hinge=side) for side in sides]
    if rng.random() < 0.7:
        ends = [digits(F * length / EI * rng.uniform(-0.1, 0.1)) for _ in range(2)]
        loads.append({"type": "curvature", "kappa": ends, **(stretch(*part(rng, length)) if rng.random() < 0.6 else {})})
    return made | {"loads": loads}


def _compressed(rng, made, share):
    """Some spans compressed, and all N scaled to a part of the first buckling factor."""
    beam, count = made["beam"], len(made["beam"]["spans"])
    if rng.random() < 0.6:
        beam["N"] = -1.0
    else:
        beam["N"] = [rng.choice((-1, -1, 0, 1)) * rounded(rng, 0.2, 1) for _ in range(count)]
        beam["N"][rng.randrange(count)] = -1.0
    for section in made.get("sections", ()):
        if "N" in section:
            section["N"] = -rounded(rng, 0.1, 1)
    if "hinges" in beam and modes.unstable(made):  # not held without its one-sided supports
        del beam["hinges"]
    factor = _buckling(made) * share

    def scaled(value):
        return digits(value * factor)

    beam["N"] = list(map(scaled, beam["N"])) if isinstance(beam["N"], list) else scaled(beam["N"])
    for section in made.get("sections", ()):
        if "N" in section:
            section["N"] = scaled(section["N"])
    return made


def _buckling(made, active=()):
    """The first factor; on stiff ground a beam may have none up to that at which N reaches GA."""
    found = modes.buckling(made, active) or [made["beam"]["GA"] / max(-n for n in axial_forces(made))]
    return float(found[0])


def axial_forces(made):
    """All axial forces of a scene."""
    given = made["beam"]["N"]
    return [*(given if isinstance(given, list) else [given]), *(s["N"] for s in made.get("sections", ()) if "N" in s)]


def column(seed, share=None):
    """A column with stops at a distance, compressed up to beyond its first Euler load.

    Parameters
    ----------
    seed : int
    share : float, optional
        Compression in parts of the first buckling factor with all stops open; default: drawn, from 0.3 to the factor with all stops
        acting.

    Returns
    -------
    dict
        There may be several states, or none that is stable.
    """
    rng = random.Random(f"column {seed}")
    length, EI = eighths(rng, 1, 10), rounded(rng, 1e-2, 1e5)
    ends = [at(node, **({"rotation": "fixed"} if rng.random() < 0.2 else {})) for node in (0, 1)]
    size = rounded(rng, 1e-2, 1e2)
    depth = 5 * size * length**3 / (384 * EI)
    stops = []
    for eighth in sorted(rng.sample(range(1, 8), rng.choice((1, 1, 2, 3)))):
        side, soft = rng.choice(("below", "below", "above", "pair")), rng.random() < 0.2
        values = {"stiffness": digits(rounded(rng, 10, 1e4) * EI / length**3)} if soft else {}
        for one in ("below", "above") if side == "pair" else (side,):
            stops.append(at(x=length * eighth / 8.0, side=one, gap=digits(depth * rng.uniform(0.2, 4)), **values))
    q = digits(size / length)
    loads = [rng.choice((uniform(q), linear(q, digits(q * rng.uniform(-1, 1))), force(eighths(rng, 0.125, length - 0.125), size)))]
    made = scene([length], [*ends, *stops], loads, EI=EI, N=-1.0)
    if rng.random() < 0.2:
        made["beam"]["GA"] = digits(rounded(rng, 50, 1e4) * EI / length**2)
    first = _buckling(made)
    last = _buckling(made, tuple(range(2, 2 + len(stops)))) / first
    drawn = rng.uniform(0.3, min(last, 6))
    made["beam"]["N"] = -digits(first * (drawn if share is None else share))
    return made
