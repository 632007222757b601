"""Exit statuses: 1 only where a structure cannot stand, 2 what is refused, 3 what failed; each with one line, never a traceback."""

import errno
import os
import re
import subprocess
import sys

import pytest
from gapbeam.base.errors import EngineError, SceneError, Status
from gapbeam.cli import main

FAULT = "this is a fault of gapbeam, not of the scene: please send this line, the scene and what gapbeam --version prints"

MEMORY = "not enough memory; ask for fewer load steps or files, or give it more"
BROKEN = "a part of gapbeam cannot be loaded (broken); give it more memory, or install it again"
HELD = '{"beam": {"spans": [6.0], "EI": 1.0}, "supports": [{"node": 0}, {"node": 1}]}'
FREE = '{"beam": {"spans": [6.0], "EI": 1.0}, "supports": [{"node": 0}], "loads": [{"type": "uniform", "q": 1}]}'


@pytest.fixture
def scene(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scene.json").write_text(HELD)
    return "scene.json"


def ended(capsys, *arguments):
    """Status and the one line of a command that ended before its time."""
    status = main(list(arguments))
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("\n") == 1
    assert err.startswith("gapbeam: ")
    return status, err.removeprefix("gapbeam: ").rstrip("\n")


PLACES = [
    ("gapbeam.scene.reading.read_scene", ["check", "scene.json"]),
    ("gapbeam.results.stepping.solve", ["run", "scene.json"]),
    ("gapbeam.report.json_csv.json_parts", ["run", "scene.json", "--json", "a.json"]),
    ("gapbeam.plots.result.figure", ["run", "scene.json", "--plot", "a.png"]),
    ("gapbeam.report.text.print_report", ["run", "scene.json"]),
    ("gapbeam.scene.schema.scene_schema", ["schema"]),
    ("gapbeam.studies.accuracy.families", ["study", "accuracy"]),
]


@pytest.fixture(params=PLACES, ids=[place for place, _ in PLACES])
def raising(request, scene, monkeypatch, capsys):
    """Run a command in which something raises an error."""
    place, arguments = request.param

    def run(error):
        def raises(*_, **__):
            raise error

        monkeypatch.setattr(place, raises)
        found = ended(capsys, *arguments)
        assert os.listdir() == ["scene.json"]
        return found

    return run


@pytest.mark.parametrize(
    ("error", "words"),
    [
        (ValueError("no\nsuch\x1bthing"), r"ValueError (no such\x1bthing)"),
        (RecursionError("too deep"), "RecursionError (too deep)"),
        (KeyError("x"), "KeyError ('x')"),
        (OSError("odd"), "OSError (odd)"),
        (AssertionError(), "AssertionError"),
        (ValueError("long " * 1000), "ValueError (" + "long " * 59 + "[...])"),
    ],
)
def test_a_fault_is_3_and_says_how_to_report_it(raising, error, words):
    status, line = raising(error)
    assert status == 3
    assert re.fullmatch(re.escape(f"internal error: {words} in ") + r"\w+\.py, line \d+; " + FAULT + ".*", line)


@pytest.mark.parametrize("error", [MemoryError(), MemoryError("9 GB"), EngineError("9 GB", Status.NO_MEMORY)])
def test_too_little_memory_is_3(raising, error):
    reason = " (9 GB)" if str(error) else ""
    assert raising(error) == (3, f"error: {MEMORY}".replace("memory", f"memory{reason}"))


@pytest.mark.parametrize(
    ("error", "line"),
    [
        (SceneError("beam", "wrong"), "error: beam: wrong"),
        (EngineError("no single answer", Status.INDETERMINATE), "error: no single answer"),
        (OSError(errno.EIO, "Input/output error", "a.json"), "error: a.json: Input/output error"),
    ],
)
def test_what_is_refused_is_2(raising, error, line):
    assert raising(error) == (2, line)


@pytest.mark.parametrize("command", [["run", "scene.json"], ["check", "scene.json"], ["schema"], ["study", "accuracy"]])
@pytest.mark.parametrize(
    ("content", "status", "line"),
    [
        ("raise ImportError('broken')", 3, f"error: {BROKEN}"),
        ("raise MemoryError", 3, f"error: {MEMORY}"),
        ("import os, signal; os.kill(os.getpid(), signal.SIGINT)", 130, "interrupted"),
    ],
)
def test_the_libraries_fail_to_load(scene, tmp_path, command, content, status, line):
    """Nothing of what may fail is imported before the command can say so."""
    (tmp_path / "numpy.py").write_text(content)
    run = subprocess.run(
        [sys.executable, "-c", "import signal; signal.signal(signal.SIGINT, signal.default_int_handler);"
         "from gapbeam.cli import main; raise SystemExit(main())", *command],
        env=os.environ | {"PYTHONPATH": str(tmp_path)}, capture_output=True, text=True,
    )  # fmt: skip
    assert (run.returncode, run.stdout, run.stderr) == (status, "", f"gapbeam: {line}\n")


def test_the_help_tells_the_statuses(capsys):
    with pytest.raises(SystemExit):
        main(["--help"])
    statuses = capsys.readouterr().out.partition("Exit status:\n")[2]
    assert re.findall(r"^ +(\d+) ", statuses, re.MULTILINE) == ["0", "1", "2", "3", "130", "143"]


def test_only_a_structure_that_cannot_stand_is_1(scene, tmp_path, capsys):
    (tmp_path / "scene.json").write_text(FREE)
    assert main(["run", "scene.json", "--quiet"]) == 1
    assert capsys.readouterr().err.startswith("gapbeam: no equilibrium at load factor 1: ")
