"""Scene files changed at random, in their text, their keys and their values, through Python and the command line."""

import contextlib
import copy
import io
import json
import random
import re
import resource
import sys
import tempfile
import tomllib
import warnings
from pathlib import Path

import gapbeam
import numpy as np
from gapbeam.cli import main

from . import draw
from .family import Family, Verdict

PROMISE = (
    "Whatever a scene file holds: the outcome is a result, a SceneError or an EngineError. The command ends with status 0, "
    "1 or 2, and with 2 writes one line on standard error. What is solved holds finite numbers only"
)
MEMORY = 4 << 30  # bytes of addresses that a case may have beside those in use
EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("*.toml"))

#: What values become; none asks for much work
VALUES = (
    *(None, True, False, 0, 1, -1, 2, 7, 2**31, 2**63, 10**20, 10**400),
    *(0.0, -0.0, 1.0, -1.0, 0.5, 5e-324, 1e-310, 1e-200, 1e200, 1e308, draw.INF, -draw.INF, float("nan")),
    *("", "inf", "nan", "free", "fixed", "both", "below", "above", "dead", "live", "axial", "normal", "events", "single"),
    *("1.0", "0,02", "1e5", "1979-05-27", "\x00", "\x1b[2J", "\ud800", "$\\frac$", "é" * 300, "x" * 10**5),
    *([], [1.0], [[1.0, 2.0]], [None], ["a"], [1.0] * 50, {}, {"": 1}, {"x": 1.0}, {"type": "force"}),
)
#: What keys become
KEYS = (
    *("x", "node", "from", "to", "law", "gap", "settlement", "stiffness", "rotation", "direction", "side", "type", "case"),
    *("q", "F", "M", "kappa", "EI", "GA", "EA", "hinges", "spans", "steps", "follow", "rule", "title", "units", "name"),
    *("foundation", "sections", "supports", "loads", "", "from_", "Gap", "a.b", "\ud800", "\x00", "$x$", "k" * 1000),
)
#: What is put into texts
PIECES = (
    *("[", "]", "{", "}", '"', "'", "#", "=", ",", ":", ".", "\n", "\r", "\t", " ", "-", "+", "e", "\\", '"""', "\x00", "\x1b"),
    *("inf", "nan", "1e400", "0x1F", "1_000", "null", "true", "1.7976931348623157e309", "1979-05-27T07:32:00Z", "9" * 400),
    *("[[supports]]", "[beam]", "title = 1", "x = 1", "\\u0000", "\\ud800", "\ufeff", "\u2028", "\xff"),
    *("[" * 3000, "{" * 3000, '"x":' * 20, "a." * 3000 + "b = 1"),
)
#: What files are besides
WHOLE = (
    *(b"", b"\n", b"[]", b"{}", b"null", b"1", b'"x"', b"a.b.c = 1", b"= 1", b"\x00", b"\xef\xbb\xbf{}"),
    *(b"[" * 10**5, b'{"beam":' * 10**4),
)
BYTES = (b"\xff", b"\x00", b"\xc3", b"\xed\xa0\x80", b"\xef\xbb\xbf", b"\xfe\xff", b"\x80")


def draw_case(seed):
    """Kind, and the suffix and bytes of a file."""
    rng = random.Random(seed)
    kind = rng.choices(("values", "keys", "text", "bytes", "whole"), (5, 3, 3, 1, 0.3))[0]
    if kind == "whole":
        return kind, (rng.choice((".toml", ".json")), rng.choice(WHOLE))
    suffix = rng.choice((".toml", ".json"))
    if kind in ("text", "bytes") and suffix == ".toml" and rng.random() < 0.6:
        text = rng.choice(EXAMPLES).read_text()
    else:
        made = tomllib.loads(rng.choice(EXAMPLES).read_text()) if rng.random() < 0.3 else drawn(rng)
        for _ in range(rng.choice((1, 1, 1, 2, 4)) if kind in ("values", "keys") else 0):
            (change_value if kind == "values" else change_key)(rng, made)
        text = json.dumps(made) if suffix == ".json" else toml(made)
    if kind == "text":
        for _ in range(rng.choice((1, 1, 2, 5))):
            text = change_text(rng, text)
    data = text.encode("utf-8", "surrogatepass")
    if kind == "bytes":
        at = rng.randrange(len(data))
        data = data[:at] + rng.choice(BYTES) + data[at + rng.randint(0, 3) :]
    return kind, (suffix, data)


def drawn(rng):
    """A scene with titles, units and an analysis."""
    made = draw.draw_beam(rng, draw.ORDINARY, spans=(1, 3))
    made["loads"] = draw.draw_loads(rng, draw.ORDINARY, made, most=2)
    made |= {"title": "A beam", "units": {"force": "kN", "length": "m"}}
    made["analysis"] = rng.choice(({}, {"steps": rng.randint(1, 4)}, {"follow": "events"}, {"rule": "single"}))
    return made


def places(value):
    """Every table and list inside a value, with all keys or indices."""
    items = list(value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ())
    found = [(value, key) for key, _ in items]
    for _, inner in items:
        found += places(inner)
    return found


def change_value(rng, made):
    """Put another value somewhere, or swap two."""
    spots = places(made)
    numbers = [(owner, key) for owner, key in spots if isinstance(owner[key], float)]
    owner, key = rng.choice(numbers if numbers and rng.random() < 0.5 else spots)
    if rng.random() < 0.15:
        other, name = rng.choice(spots)
        owner[key], other[name] = copy.deepcopy(other[name]), copy.deepcopy(owner[key])
    elif isinstance(owner[key], float) and rng.random() < 0.7:
        owner[key] *= rng.choice((-1.0, 0.0, 1e-300, 1e-20, 1e-6, 1e6, 1e20, 1e300, 1.0 + 2.0**-52))
    else:
        owner[key] = copy.deepcopy(rng.choice(VALUES))


def change_key(rng, made):
    """Leave a key out, call it otherwise, add one, or repeat an entry of a list."""
    owner, key = rng.choice(places(made))
    if isinstance(owner, list):
        if rng.random() < 0.5:
            owner.pop(key)
        else:
            owner.insert(key, copy.deepcopy(owner[key]))
    elif rng.random() < 0.4:
        del owner[key]
    elif rng.random() < 0.5:
        owner[rng.choice(KEYS)] = owner.pop(key)
    else:
        owner[rng.choice(KEYS)] = copy.deepcopy(rng.choice(VALUES))


def change_text(rng, text):
    """Put something in, leave something out, repeat a line, or exchange a number."""
    at, kind = rng.randrange(len(text) + 1), rng.random()
    if kind < 0.4:
        return text[:at] + rng.choice(PIECES) + text[at:]
    if kind < 0.6:
        return text[:at] + text[at + rng.choice((1, 1, 3, 20)) :]
    lines = text.split("\n")
    line = rng.randrange(len(lines))
    if kind < 0.7:
        return "\n".join([*lines[: line + 1], *lines[line:]])
    if kind < 0.75:
        return text[:at]
    numbers = list(re.finditer(r"-?\d[\d.e+-]*", text))
    if not numbers:
        return text + rng.choice(PIECES)
    found = rng.choice(numbers)
    return text[: found.start()] + rng.choice((*PIECES, "1e-310", "1e308", "-1", "0", "1e18", "0.1", "1e-9")) + text[found.end() :]


def toml(made):
    """A scene as TOML, all tables in one line; what TOML has no word for is written as JSON has it."""
    return "".join(f"{toml_key(key)} = {toml_value(value)}\n" for key, value in made.items())


def toml_key(key):
    return key if re.fullmatch(r"\w+", key, re.ASCII) else json.dumps(key)


def toml_value(value):
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{toml_key(key)} = {toml_value(inner)}" for key, inner in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml_value, value)) + "]"
    if isinstance(value, float):
        return repr(value)
    return json.dumps(value)


def judge(case, seed=0):
    """Read, check and solve a file in every way.

    Parameters
    ----------
    case : (str, bytes)
        Suffix and contents of a file.
    seed : int
        Not used.

    Returns
    -------
    Verdict
    """
    suffix, data = case
    verdict = Verdict("refused")
    limit_memory()
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        path = Path(folder) / f"scene{suffix}"
        path.write_bytes(data)
        found = [attempt("solve(file)", lambda: gapbeam.solve(path), verdict)]
        if isinstance(made := plain(suffix, data), dict):
            found.append(attempt("solve(dict)", lambda: gapbeam.solve(made), verdict))
        for result in found:
            if result is not None:
                verdict.outcome = result.status
                attempt("reading the result", lambda result=result: check_result(result, verdict), verdict)
        check_command(["check", str(path)], b"", verdict)
        check_command(["run", str(path), "--json", str(Path(folder) / "out.json")], b"", verdict)
        check_command(["run", "-", "--csv", "-"], data, verdict)
        if (Path(folder) / "out.json").exists() and verdict.outcome == "refused":
            verdict.wrong.append("a file was written for a scene that was refused")
    verdict.wrong += [f"warned: {warning.message}" for warning in warned]
    verdict.wrong = list(dict.fromkeys(verdict.wrong))
    return verdict


def limit_memory():
    """Keep a scene that asks for too much from taking the machine's memory."""
    used = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (used + MEMORY, resource.getrlimit(resource.RLIMIT_AS)[1]))


def plain(suffix, data):
    """The data of a file as the standard library reads them, or None."""
    try:
        text = data.decode()
        return tomllib.loads(text) if suffix == ".toml" else json.loads(text)
    except (ValueError, RecursionError):
        return None


def attempt(what, call, verdict):
    """The result of a call, None where it ends in an exception that is promised."""
    try:
        return call()
    except (gapbeam.SceneError, gapbeam.EngineError) as error:
        if not str(error).strip():
            verdict.wrong.append(f"{what}: an empty message")
        return None
    except MemoryError:
        verdict.outcome = "no memory"
        return None
    except Exception as error:
        verdict.wrong.append(f"{what}: {type(error).__name__}: {str(error)[:200]}")
        return None


def check_result(result, verdict):
    """Numbers that are none in what is solved."""
    for step in result.steps[:3]:
        for name in ("reaction", "deflection", "opening", "couple"):
            if not np.all(np.isfinite(getattr(step, name))):
                verdict.wrong.append(f"solved, with {name} {getattr(step, name).tolist()[:6]}")
    if result.steps and not all(np.isfinite(list(row.values())).all() for row in result._pairs_of_extremes().values()):
        verdict.wrong.append("solved, with extremes that are no numbers")


def check_command(arguments, data, verdict):
    """Exit status and standard error of the command."""
    out, err = Stream(), Stream()
    stdin = io.TextIOWrapper(io.BytesIO(data), encoding="utf-8", errors="strict")
    with contextlib.ExitStack() as stack:
        stack.enter_context(contextlib.redirect_stdout(out))
        stack.enter_context(contextlib.redirect_stderr(err))
        stack.callback(setattr, sys, "stdin", sys.stdin)
        sys.stdin = stdin
        try:
            status = main(arguments)
        except SystemExit as error:
            status = error.code
        except BaseException as error:
            verdict.wrong.append(f"{arguments[0]}: {type(error).__name__}: {str(error)[:200]}")
            return
    errors = err.text()
    if status not in (0, 1, 2):
        verdict.wrong.append(f"{arguments[0]}: exit status {status}: {errors[:200]}")
    if status == 2 and not (errors and all(line.startswith("gapbeam: error: ") for line in errors.splitlines())):
        verdict.wrong.append(f"{arguments[0]}: exit status 2 with: {errors[:200]!r}")
    if status == 2 and out.text():
        verdict.wrong.append(f"{arguments[0]}: exit status 2 with {len(out.text())} characters on standard output")
    if any(ord(c) < 32 and c not in "\n\t" for c in errors):
        verdict.wrong.append(f"{arguments[0]}: control characters on standard error: {errors[:200]!r}")


class Stream(io.TextIOWrapper):
    """Standard output or error as a terminal in UTF-8 has it, kept."""

    def __init__(self):
        super().__init__(io.BytesIO(), encoding="utf-8", write_through=True, newline="\n")

    def text(self):
        self.flush()
        return self.buffer.getvalue().decode()


def write(case, title):
    """The file itself; what is wrong with it stands in the command's output only."""
    return case


def read(path):
    return (path.suffix, path.read_bytes()), 0


FAMILY = Family("mutants", PROMISE, draw_case, judge, write, read, share=0.15)
