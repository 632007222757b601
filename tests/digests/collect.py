"""Digests of what one gapbeam makes of scenes; it knows nothing of the package but what users call.

    python tests/digests/collect.py [--numbers] SCENES FIRST LAST [LIBRARY [TESTS]]

Each line of SCENES is a name and a scene; those from FIRST to before LAST are solved. Each line printed is a name, the way that it
went, and a digest for every kind of number: `steps.supports.reaction` is one. With ``--numbers`` these are the numbers themselves.
LIBRARY is called by the `clibrary.py` of the folder TESTS: that of its own commit, for structures grow.
"""

import contextlib
import hashlib
import importlib
import itertools
import json
import sys
from collections import defaultdict
from pathlib import Path

import gapbeam
import numpy as np

# Words may change, and clocks do
NOT_NUMBERS = {
    "title", "reason", "message", "messages", "remarks", "hints", "warnings", "words", "seconds", "version", "gapbeam", "schema",
}  # fmt: skip
GROUND_LAWS = {"plastic", "hardening", "hyperbolic", "tanh", "cubic"}  # in C and Fortran 77
MOST_NODES = 200  # there
NO_EQUILIBRIUM = 1
WHOLE_ONLY = {"sections", "trains", "combinations", "envelopes"}


def spelled(value):
    """A value such that two of them are equal if all their bits are."""
    if isinstance(value, np.ndarray):
        return [str(value.dtype), value.shape, value.tobytes().hex()]
    if isinstance(value, (list, tuple)):
        return [spelled(item) for item in value]
    if isinstance(value, (float, np.floating)):
        return float(value).hex()
    return value.item() if isinstance(value, np.generic) else value


def sort_out(value, kind, found, written):
    """Put numbers to others of their kind: the keys that lead to them, whatever their place in lists of dicts."""
    if isinstance(value, dict):
        for key, item in value.items():
            if key not in NOT_NUMBERS:
                sort_out(item, f"{kind}.{key}" if kind else str(key), found, written)
    elif isinstance(value, (list, tuple)) and any(isinstance(item, dict) for item in value):
        found[f"{kind}#"].append(len(value))
        for item in value:
            sort_out(item, kind, found, written)
    else:
        found[kind].append(written(value))


def numbers(value):
    """All numbers of every kind in a value, and words that are no message; what has another shape has another number of them."""
    found = defaultdict(list)
    sort_out(value, "", found, flat)
    return found


def flat(value):
    """A value as numbers."""
    if isinstance(value, (list, tuple, np.ndarray)):
        return [flat(item) for item in value]
    return value.item() if isinstance(value, np.generic) else value


def digests(value):
    """The sha256 of every kind of number in a value."""
    found = defaultdict(list)
    sort_out(value, "", found, spelled)
    return {kind: hashlib.sha256(json.dumps(values).encode()).hexdigest() for kind, values in found.items()}


def arrays_of(found):
    """All arrays of an object."""
    values = {name: getattr(found, name) for name in dir(found) if not name.startswith("_")}
    return {name: value for name, value in values.items() if isinstance(value, np.ndarray)}


def in_python(made):
    """Everything of the JSON output."""
    return gapbeam.solve(gapbeam.read_scene(made)).to_dict(points=5)


def in_cases(made, cases):
    """Cases in lanes, with what is asked of them."""
    gaps = {int(k): values for k, values in cases["gaps"].items()}
    return arrays_of(gapbeam.prepare(made).solve(cases["factors"], **({"gap": gaps} if gaps else {})))


def in_c(made, library):
    """A solve, a path by events, fields and the certificate."""
    beam, message = library.prepare(made)
    if message:
        return beam
    try:
        ground = bool(made.get("foundation"))
        found = {"solve": beam.solve(1.0)[0]}
        if found["solve"] == NO_EQUILIBRIUM:
            found["motion"] = beam.motion()
        if found["solve"] == 0:
            found["supports"] = beam.at_supports()
            end = float(np.sum(made["beam"]["spans"]))
            found["fields"] = beam.fields(np.linspace(0.0, end, 9))
            found["extremes"] = beam.extremes()
            found["contact"] = beam.contact() if ground else []
        if not ground:
            found["events"] = beam.follow(1.0)[::2]
        elif not any(isinstance(item.get("law"), dict) for item in made["foundation"]):
            found["events"] = beam.follow_ground(1.0)   # over curves they take seconds
        return found
    finally:
        beam.close()


def in_fortran_77(made, library, beam_of):
    """A solve, values at supports and fields, or the motion."""
    beam = beam_of(library, made)
    if beam.info_:
        return beam.info_
    info = beam.solve(1.0)
    if info == NO_EQUILIBRIUM:
        return [info, beam.motion()]
    if info:
        return info
    x = np.linspace(0.0, float(np.sum(made["beam"]["spans"])), 9)
    found = {"supports": beam.at_supports(), "fields": beam.fields(x), "extremes": beam.extremes()}
    return found | {"contact": beam.contact() if made.get("foundation") else []}


def is_for_all(made):
    """Can the columns of the other languages hold the scene."""
    spans, supports, foundations = made["beam"]["spans"], made.get("supports", []), made.get("foundation", [])
    plain = isinstance(spans, list) and len(spans) <= MOST_NODES and not set(made) & WHOLE_ONLY
    plain = plain and not any(isinstance(support.get("law"), dict) for support in supports)
    laws = [item["law"] for item in foundations if isinstance(item.get("law"), dict)]
    numbers = [value for item in (*foundations, *laws) for key, value in item.items() if key != "profile"]
    tables = any(isinstance(value, list) and isinstance(value[0], dict) for value in numbers)
    tables |= any(isinstance(item["k"], list) and isinstance(item["k"][0], list) for item in foundations if "k" in item)
    tables |= any(isinstance(value, list) and isinstance(value[0], list) for law in laws for value in law.values())
    return plain and not tables and all(law["type"] in GROUND_LAWS for law in laws)


def attempt(call, *arguments):
    """What a call gives, or which kind of refusal it ends with."""
    try:
        return call(*arguments)
    except (gapbeam.SceneError, gapbeam.EngineError) as error:
        return type(error).__name__


def callers(library, tests):
    """The library as C and as Fortran 77 call it, by the classes of its own commit."""
    sys.path.insert(0, str(tests))
    for name in ("languages.clibrary", "clibrary"):
        with contextlib.suppress(ModuleNotFoundError):
            module = importlib.import_module(name)
            return module.Library(library), module.F77Beam
    raise SystemExit(f"{tests}: there is no clibrary.py")


def main(scenes, first, last, library=None, tests=None, made_of=digests):
    """Print the digests of scenes of a file, or what else is made of their numbers."""
    called = library and callers(library, tests or Path(__file__).resolve().parents[1])
    with open(scenes, encoding="utf-8") as lines:
        for line in itertools.islice(lines, int(first), int(last)):
            name, made = json.loads(line)
            cases = made.pop("cases", None) if isinstance(made.get("cases"), dict) and "factors" in made["cases"] else None
            calls = {"python": (in_python, made)}
            if cases:
                calls["cases"] = (in_cases, made, cases)
            if library and is_for_all(made):
                made = {"supports": [], "loads": [], **made}
                calls["C"] = (in_c, made, called[0])
                calls["Fortran 77"] = (in_fortran_77, made, *called)
            for what, call in calls.items():
                print(json.dumps([name, what, made_of(attempt(*call))]), flush=True)


if __name__ == "__main__":
    if sys.argv[1] == "--numbers":
        main(*sys.argv[2:], made_of=numbers)
    else:
        main(*sys.argv[1:])
