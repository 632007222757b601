"""Where memory ends, calls end in MemoryError: all of them under limits of the address space, each in a process of its own."""

import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
from collections import Counter
from contextlib import suppress
from pathlib import Path

import gapbeam
import numpy as np
import pytest
from gapbeam.base.errors import Status, check_status
from gapbeam.base.memory import available
from gapbeam.cli import main as cli
from gapbeam.scene import read_scene

resource = pytest.importorskip("resource")

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="limits of the address space cannot be set here")

SPANS, FEWER = 5_000, 1_000
RIGHT, REFUSED, WRONG = 0, 15, 1
"""How a process ends; anything else is not its own doing."""
TWO_SPRINGS = {  # quadruple precision decides which one bears
    "beam": {"spans": [5.0], "EI": 1e4, "EA": 1e5},
    "supports": [
        {"node": 0, "side": "below", "stiffness": 1e15, "settlement": 0.04},
        {"node": 0, "stiffness": 100.0},
        {"node": 1},
        {"node": 1, "direction": "axial"},
    ],
    "loads": [{"type": "force", "node": 0, "F": 3.9}, {"type": "axial", "node": 0, "F": 2.0}],
}
SEESAW = {  # turns at factor 0.5, which is followed in quadruple precision
    "beam": {"spans": [4.0, 4.0], "EI": 1e4},
    "supports": [{"node": 1}, {"node": 0, "side": "below"}, {"node": 2, "side": "below", "gap": 0.1}],
    "loads": [{"type": "force", "node": 0, "F": 10.0, "case": "dead"}, {"type": "force", "node": 2, "F": 20.0}],
    "analysis": {"follow": "events"},
}


def long_beam(follow, stiffness=50.0, at=SPANS / 2 + 0.25):
    """A beam on one-sided supports, pressed down at one place."""
    return {
        "beam": {"spans": [1.0] * SPANS, "EI": 1e4},
        "supports": [{"node": i, "side": "below", "stiffness": stiffness} for i in range(SPANS + 1)],
        "loads": [{"type": "uniform", "q": 0.1, "case": "dead"}, {"type": "force", "x": at, "F": 40.0}],
        "analysis": {"follow": follow},
    }


def beam_on_laws(law):
    """A beam on supports with a law each, pressed down at one place."""
    return {
        **long_beam("steps"),
        "beam": {"spans": [1.0] * FEWER, "EI": 1e4},
        "supports": [{"node": i, "side": "below", "law": law} for i in range(FEWER + 1)],
        "loads": [{"type": "uniform", "q": 0.1, "case": "dead"}, {"type": "force", "x": FEWER / 2 + 0.25, "F": 40.0}],
    }


GROUND = {
    "beam": {"spans": [6.0] * 10, "EI": 1e4},
    "foundation": [{"law": {"type": "tanh", "stiffness": 500.0, "limit": 30.0}, "side": "below"}],
    "loads": [{"type": "uniform", "q": 2.0, "case": "dead"}, {"type": "force", "x": 30.1, "F": 50.0}],
}


def every_answer(scene):
    """Solve a scene and ask for all that there is."""
    result = gapbeam.solve(scene)
    step = result.steps[-1]
    fields = result.at([0.3, 1.7, 2.0])
    extremes = [pair for pairs in result._pairs_of_extremes().values() for pair in pairs.values()]
    return [step.reaction, fields.deflection, fields.moment, extremes, list(step.certificate.values())]


def cases(scene):
    """Solve load cases of a beam that is prepared."""
    found = gapbeam.prepare(scene).solve([[1.0, factor] for factor in (0.0, 0.5, 1.0)])
    return [found.reaction, found.deflection]


def read_again(scene):
    """Check a scene that was built in Python."""
    return [read_scene(scene).beam.spans]


CALLS = {
    "structs": (read_again, read_scene(long_beam("steps")), 30_000_000, 26),
    "two springs": (every_answer, TWO_SPRINGS, 3_000_000, 17),
    "seesaw": (every_answer, SEESAW, 3_000_000, 17),
    "two springs as cases": (cases, TWO_SPRINGS, 3_000_000, 17),
    "steps": (every_answer, long_beam("steps"), 80_000_000, 13),
    "events": (every_answer, long_beam("events"), 120_000_000, 12),
    "ties": (every_answer, long_beam("steps", float("inf"), SPANS / 2), 80_000_000, 13),
    "smooth laws": (every_answer, beam_on_laws({"type": "tanh", "stiffness": 50.0, "limit": 30.0}), 80_000_000, 13),
    "polylines": (every_answer, beam_on_laws([[0.01, 5.0], [0.1, 20.0], [1.0, 30.0]]), 40_000_000, 13),
    "ground": (every_answer, GROUND, 4_000_000, 17),
    "cases": (cases, long_beam("steps"), 60_000_000, 13),
}
"""What is called, with what, and the limits: up to so many bytes more than at first, and how many of them."""
SMALL = ("two springs", "seesaw", "two springs as cases", "ground")
"""Those that take little; Python may want another mebibyte at once for it, so their limits lie the closer the lower they are."""


def digits(name):
    """Call it, and digest its numbers."""
    call, scene, *_ = CALLS[name]
    return hashlib.sha256(b"".join(np.asarray(part, dtype=float).tobytes() for part in call(scene))).hexdigest()


def attempt(name, room, right):
    """Call it when all memory is taken but so many bytes; how the process is to end."""
    with open("/proc/self/statm", encoding="ascii") as file:
        in_use = int(file.read().split()[0]) * os.sysconf("SC_PAGESIZE")
    resource.setrlimit(resource.RLIMIT_AS, (in_use, resource.RLIM_INFINITY))
    taken = []
    for size in (2**20, 2**16, 2**12, 2**10):
        with suppress(MemoryError):
            while True:
                taken.append(bytearray(size))
    resource.setrlimit(resource.RLIMIT_AS, (in_use + room, resource.RLIM_INFINITY))
    try:
        return RIGHT if digits(name) == right else WRONG
    except MemoryError:
        return REFUSED
    except SystemError as error:
        if "without" not in str(error):  # returned NULL without setting an exception; error return without exception set
            raise
        return REFUSED  # numpy does not always say why it refuses


def in_a_process(call, *arguments):
    """Call in a copy of this process; its exit status, below 0 for a signal, and what it wrote."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        ended = WRONG
        try:
            found = call(*arguments)
            ended = found if isinstance(found, int) else RIGHT
            os.write(writing, str(found).encode())
        except BaseException as error:
            os.write(2, f"{type(error).__name__}: {error}\n".encode())
        finally:
            os._exit(ended)
    os.close(writing)
    with open(reading, encoding="ascii") as pipe:
        text = pipe.read()
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), text


def main(name):
    """Print how often each way a call ended under its limits."""
    for small in SMALL:
        digits(small)  # imports what is imported at first use
    _, _, above, count = CALLS[name]
    _, right = in_a_process(digits, name)
    limits = [int(above * (k / (count - 1)) ** (2 if name in SMALL else 1)) for k in range(count)]
    ends = (in_a_process(attempt, name, limit, right)[0] for limit in limits)
    print(json.dumps(Counter(ends)))


@pytest.mark.parametrize("limit", [123_456_789, resource.RLIM_INFINITY])
def test_no_more_can_be_had_than_the_address_space(monkeypatch, limit):
    """Without a limit, which is told as a number below zero, what the machine has."""
    unlimited = resource.RLIM_INFINITY
    monkeypatch.setattr(resource, "getrlimit", lambda _: (unlimited, unlimited))
    machine = available()
    assert machine > 10e6
    monkeypatch.setattr(resource, "getrlimit", lambda _: (limit, unlimited))
    assert available() == pytest.approx(machine if limit == unlimited else min(machine, limit), rel=0.5)


def test_the_status_is_a_memory_error():
    with pytest.raises(MemoryError, match=r"no more memory: .* or take fewer spans"):
        check_status(Status.NO_MEMORY)


@pytest.mark.parametrize("name", CALLS)
def test_every_limit(name):
    run = subprocess.run([sys.executable, __file__, name], capture_output=True, text=True, check=False)
    ended = json.loads(run.stdout)
    assert set(ended) <= {str(RIGHT), str(REFUSED)}, run.stderr
    assert ended[str(RIGHT)] > 2
    assert ended[str(REFUSED)] > 2


SCENE = {
    "beam": {"spans": [6.0, 6.0], "EI": 1e4},
    "supports": [{"node": 0}, {"node": 1, "side": "below", "gap": 0.01}, {"node": 2}],
    "loads": [{"type": "uniform", "q": 20.0}],
}
LIMITS = {  # megabytes; known to have ended otherwise are 63 to 121, 131, 140, 335, 440, 448
    "run scene.json --quiet --json a.json": (28, 40, 63, 85, 100, 121, 131, 140, 175, 190, 210, 225, 335, 900, 3600),
    "run scene.json --quiet --plot a.svg": (121, 190, 230, 260, 280, 300, 3600),
    "batch scene.json gaps.csv --out out --jobs 2 --quiet": (121, 225, 335, 400, 440, 448, 470, 500, 530, 900, 3600),
    "batch scene.json spans.csv --out out --jobs 2 --quiet": (225, 440, 500, 900, 3600),
    "batch --summary kept --quiet --json a.json": (225, 400, 448, 500, 3600),
}


def written():
    """What a command has written, but for the time that it took."""
    found = {one: (Path("out") / one).read_bytes() for one in os.listdir("out")} if os.path.isdir("out") else {}
    for name in ("a.json", "a.svg"):
        if os.path.exists(name):
            text = re.sub(r'"seconds": [^,\n]*|<dc:date>.*?</dc:date>', "", Path(name).read_text(encoding="utf-8"))
            found[name] = re.sub(r"\b[mp][0-9a-f]{10}\b", "id", text).encode()
    return found


@pytest.mark.parametrize("command", LIMITS)
def test_the_command_under_limits(tmp_path, monkeypatch, command):
    """The right result, or status 3 and one line; libraries that end the process where they get no memory are not let do so."""
    monkeypatch.chdir(tmp_path)
    Path("scene.json").write_text(json.dumps(SCENE))
    Path("gaps.csv").write_text("supports[1].gap\n" + "".join(f"{0.0001 * k}\n" for k in range(200)))
    Path("spans.csv").write_text("beam.spans[0]\n" + "".join(f"{6.0 + 0.001 * k}\n" for k in range(40)))
    if "kept" in command:
        gapbeam.batch("scene.json", "gaps.csv", "kept")
    ends, right = Counter(), None
    for limit in (None, *LIMITS[command]):
        for name in ("a.json", "a.svg"):
            Path(name).unlink(missing_ok=True)
        shutil.rmtree("out", ignore_errors=True)
        run = subprocess.run(
            [sys.executable, "-m", "gapbeam", *command.split()], capture_output=True, text=True, timeout=100,
            preexec_fn=lambda most=limit: most and resource.setrlimit(resource.RLIMIT_AS, (most * 2**20, most * 2**20)),
        )  # fmt: skip
        ends[run.returncode] += 1
        assert run.stdout == ""
        if run.returncode == 3:
            assert re.fullmatch(r"gapbeam: error: .*memory.*\n", run.stderr), (limit, run.stderr)
            assert not os.path.exists("a.json")
        else:
            assert (run.returncode, run.stderr) == (0, ""), limit
            right = right or written()
            assert written() == right, limit
    assert set(ends) == {0, 3}


def test_a_package_that_fails_to_load_is_not_missing(tmp_path, monkeypatch, capsys):
    """Where memory is short a package is there and cannot be loaded: that is no matter of installing it."""
    monkeypatch.chdir(tmp_path)
    Path("scene.json").write_text(json.dumps(SCENE))
    Path("gaps.csv").write_text("supports[1].gap\n0.0\n")
    (tmp_path / "broken" / "pyarrow").mkdir(parents=True)
    (tmp_path / "broken" / "pyarrow" / "__init__.py").write_text("raise ImportError('failed to map segment from shared object')")
    for name in [name for name in sys.modules if name.partition(".")[0] == "pyarrow"]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.syspath_prepend(tmp_path / "broken")
    assert cli(["batch", "scene.json", "gaps.csv", "--out", "out"]) == 3
    assert "cannot be loaded (failed to map segment from shared object); give it more memory" in capsys.readouterr().err


if __name__ == "__main__":
    main(sys.argv[1])
