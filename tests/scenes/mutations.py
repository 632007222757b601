"""Scenes with something wrong in them: values, keys and nesting of all kinds, and texts with something wrong in their bytes."""

import copy
import json
import random
import tomllib
from datetime import date
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import gapbeam
import numpy as np

from .plain import random_scene

# The forty combinations of the bridge are the runway forty times, and some numbers make each of them, or the wagons, take seconds
SLOW = ("bridge_bearings", "rail_bogie_passes")
FILES = [path for path in sorted((Path(__file__).parents[2] / "examples").glob("*.toml")) if path.stem not in SLOW]
TEXTS = [path.read_bytes() for path in FILES]
EXAMPLES = [tomllib.loads(text.decode()) for text in TEXTS]


def _nested(kind, depth):
    value = 1.0
    for _ in range(depth):
        value = kind(value)
    return value


def _endless():
    value = {}
    value["x"] = [value]
    return value


NUMBERS = [0, -1, 1, 2**31, 2**64, 10**400, -(10**400), 10**5000, -0.0, 5e-324, 1e308, -1e308, float("nan"), float("inf"), 1 + 2j]
PYTHON = [None, True, b"ab", object(), set(), {1.0}, range(3), Decimal("1.5"), Fraction(10**400), date.min]
WORDS = ["", "0,02", "inf", "fixed", "both", "dead", "force", "\ud800", "\0", "\x1b[31m", "$x$", "a\nb", "x" * 10**5]
NESTED = [[], [[]], {}, {"": 1}, [None], [1, "a"], [1.0, 2.0], _endless()]
NESTED += [_nested(kind, depth) for kind in (lambda v: [v], lambda v: {"a": v}) for depth in (50, 10**5)]
NUMPY = [
    np.float32(2.0), np.longdouble(2.0), np.clongdouble(1), np.uint64(2**64 - 1), np.bool_(True), np.str_("both"), np.bytes_(b"x"),
    np.datetime64("2020"), np.timedelta64(1, "s"), np.ma.masked, np.ma.array([1.0, 2.0], mask=[0, 1]), np.array([]), np.array(1.0),
    np.ones((2, 2)), np.array([None]), np.array([{}]), np.zeros(2, dtype=[("a", float)]), np.ones(2, dtype=np.longdouble),
]  # fmt: skip
STRUCTS = [gapbeam.Beam([1.0], EI=1.0), gapbeam.Support(node=0), gapbeam.Support(node=np.ma.masked), gapbeam.Units(3, None)]
VALUES = [*NUMBERS, *PYTHON, *WORDS, *NESTED, *NUMPY, *STRUCTS]
KEYS = ["", "a.b", "\x1b[2J", "\ud800", " ", "x" * 1000, "spans", "from_", "EI", "node", "type", "\n", 1, None, (1,), b"x", "title"]
BYTES = [
    b"", b'"', b"'", b"[", b"]", b"{", b"}", b"=", b",", b"\n", b"\r", b"\0", b"\xff", b"\x1b[31m", b"\xef\xbb\xbf",
    b"\xed\xa0\x80", b"1e400", b"-inf", b"nan", b"Infinity", b"9" * 400, b"9" * 5000, b"a." * 300, b"[" * 3000,
    b'{"a":' * 3000, b"#", b"\\u0000", b"\\ud800", b"1979-05-27", b"true", b"null", b'"""', b"\xe2\x80\xa8", b"$",
    b"[[loads]]", b"[beam]", b'""=1\n', b'"a.b"=1\n',
]  # fmt: skip


def mutated_scene(seed: int):
    """A scene, as dicts and lists, with one thing or a few put in place of others; the same for the same seed."""
    rng = random.Random(seed)
    scene = copy.deepcopy(rng.choice(EXAMPLES)) if rng.random() < 0.5 else random_scene(rng, held=rng.choice((True, None)))
    if rng.random() < 0.1:
        scene["analysis"] = {"follow": "events"}
    holders = [(holder, key) for holder in _holders(scene) for key in (holder if isinstance(holder, dict) else range(len(holder)))]
    for holder, key in rng.sample(holders, rng.choice((1, 1, 1, 2))):
        kind, value = rng.random(), rng.choice(VALUES)
        if isinstance(holder, dict) and kind < 0.1:
            holder.pop(key, None)
        elif isinstance(holder, dict) and kind < 0.2:
            holder[rng.choice(KEYS)] = value
        elif isinstance(holder[key], int | float) and kind < 0.3:
            holder[key] *= rng.choice((-1, 1e-9, 1e9, 1e300, 1e-300, rng.uniform(-10, 30)))
        else:
            holder[key] = value
    return scene


def _holders(value):
    """All tables and lists of plain data."""
    if isinstance(value, dict | list):
        yield value
        for inner in value.values() if isinstance(value, dict) else value:
            yield from _holders(inner)


def mutated_text(seed: int) -> tuple[str, bytes]:
    """Suffix and bytes of a file with something wrong, the same for the same seed."""
    rng = random.Random(seed)
    suffix = rng.choice((".toml", ".json"))
    text = bytearray(rng.choice(TEXTS) if suffix == ".toml" else json.dumps(rng.choice(EXAMPLES), indent=1).encode())
    for _ in range(rng.choice((1, 1, 2, 4))):
        start = rng.randrange(len(text) + 1)
        stop = min(len(text), start + rng.choice((0, 0, 1, 3, 20)))
        text[start:stop] = rng.choice((rng.choice(BYTES), bytes([rng.randrange(256)]), text[: rng.randrange(60)]))
    return suffix, bytes(text)
