"""Progress on a terminal after a second, and nowhere else."""

import io
import os
import subprocess
import sys
import time

import pytest
from gapbeam.base import progress

PROGRAM = """
import gapbeam, numpy, sys, time
from gapbeam.base import progress
from gapbeam.batches.scene_cases import SceneCases
before = SceneCases.solve_one
SceneCases.solve_one = lambda *arguments: time.sleep(0.05) or before(*arguments)
scene = {"beam": {"spans": [6.0], "EI": 1e4}, "supports": [{"node": 0}, {"node": 1}],
         "loads": [{"type": "force", "x": 1.0, "F": 1.0}]}
gapbeam.batch(scene, {"loads[0].x": numpy.linspace(1.0, 5.0, 40)}, sys.argv[1], chunk=2, jobs=1)
"""


class Terminal(io.StringIO):
    def isatty(self):
        return True


def worked(monkeypatch, stream, seconds, **options):
    monkeypatch.setattr(sys, "stderr", stream)
    monkeypatch.setattr(progress, "AFTER", 0.05)
    monkeypatch.setattr(progress, "EVERY", 0.01)
    with progress.shown_progress("cases", **options) as tell:
        if tell is not None:
            tell(10, 40)
            tell(20, 40)
        time.sleep(seconds)
    return stream.getvalue()


def test_a_line_on_a_terminal_that_is_gone_at_the_end(monkeypatch):
    shown = worked(monkeypatch, Terminal(), 0.3)
    assert "20 of 40 cases, " in shown
    assert shown.endswith(progress.CLEAR)
    assert "\n" not in shown


def test_what_is_short_shows_nothing(monkeypatch):
    assert worked(monkeypatch, Terminal(), 0.0) == ""


@pytest.mark.parametrize(("stream", "options"), [(io.StringIO(), {}), (Terminal(), {"wanted": False})])
def test_elsewhere_nothing(monkeypatch, stream, options):
    assert worked(monkeypatch, stream, 0.3, **options) == ""


def test_a_closed_standard_error_is_no_terminal(monkeypatch):
    monkeypatch.setattr(sys, "stderr", None)
    with progress.shown_progress("cases") as tell:
        assert tell is None


@pytest.mark.skipif(not hasattr(os, "openpty"), reason="there are no such terminals here")
def test_batches_of_python_show_it(tmp_path):
    terminal, other = os.openpty()
    command = [sys.executable, "-c", PROGRAM, tmp_path / "out"]
    subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=other, check=True)
    os.close(other)
    shown = b""
    try:
        while part := os.read(terminal, 65536):
            shown += part
    except OSError:  # the other end is closed
        pass
    os.close(terminal)
    assert b" of 40 cases, " in shown
    assert shown.endswith(b"\r\x1b[K")
    done = subprocess.run([*command[:-1], tmp_path / "piped"], capture_output=True, check=True)
    assert done.stderr == b""
