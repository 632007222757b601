"""Ctrl-C ends a long call within a second, with nothing written in part, and the next call is as any other."""

import _thread
import json
import os
import signal
import subprocess
import sys
import threading
import time
from functools import partial
from types import SimpleNamespace

import gapbeam
import numpy as np
import pytest
from gapbeam import _yardsticks
from gapbeam.cli import main
from gapbeam.engine import calls
from gapbeam.engine.blocks import Block
from gapbeam.studies.meshes import gapped_spans
from languages.installation import TOP
from scenes import random_scene

pytestmark = pytest.mark.alone
SECOND = 1.0


def interrupt(call, after=0.3, signals=lambda: os.kill(os.getpid(), signal.SIGINT)):
    """Ctrl-C while a call goes on, again and again if it is short; it has to end within a second from then.

    Python drops a KeyboardInterrupt that comes while it frees objects, so Ctrl-C comes once more after two seconds.
    """
    times, ended = [], threading.Event()

    def press():
        time.sleep(after)
        while not ended.is_set():
            times.append(time.perf_counter())
            signals()
            ended.wait(2.0)

    old = signal.signal(signal.SIGINT, signal.default_int_handler)
    thread = threading.Thread(target=press)
    try:
        thread.start()
        while True:
            call()
    except KeyboardInterrupt:
        took = time.perf_counter() - times[-1]
    finally:
        ended.set()
        thread.join()
        signal.signal(signal.SIGINT, old)
    assert took < SECOND
    assert len(times) < 4


# Calls of the library


def test_one_call_of_the_engine():
    """Some seconds of eliminations in one call."""
    count = 100_000
    each, supports = np.ones(count), np.full(count + 1, np.inf)
    solve = calls.interruptible(_yardsticks.yskern)
    interrupt(lambda: solve(each, each, each, supports, np.zeros(count + 1), 0, 3000))
    w, _, status = solve(each, each, each, supports, np.zeros(count + 1), 0, 1)
    assert status == 0
    assert not w.any()


def test_millions_of_cases():
    beam = gapbeam.prepare(gapped_spans(3))
    factors = np.random.default_rng(1).uniform(0.0, 9.0, (3_000_000, 3))
    interrupt(lambda: beam.solve(factors))
    assert np.array_equal(beam.solve(factors[:9]).reaction, [beam.solve(row).reaction for row in factors[:9]])


def test_many_steps():
    interrupt(lambda: gapbeam.solve({**gapped_spans(300), "analysis": {"steps": 10**5}}))


def test_a_large_scene():
    """Reading, lowering, condensing: whatever it is at."""
    scene = gapped_spans(100_000)
    for after in (0.1, 0.4, 0.7):
        interrupt(lambda: gapbeam.solve(scene), after)


def test_tables_of_long_beams():
    result = gapbeam.solve(gapped_spans(20_000))
    for write in (gapbeam.report.to_json, gapbeam.report.to_csv, gapbeam.report.report_text):
        interrupt(lambda write=write: write(result))


def test_pictures_of_long_beams():
    from gapbeam.plots import figure
    from gapbeam.plots.save import picture

    result = gapbeam.solve(gapped_spans(20_000))
    for after in (0.2, 1.2, 2.2):
        interrupt(lambda: picture(figure(result), ".png"), after)


def test_events(monkeypatch):
    """Calls for events are interruptible however short the beam is: what they take is not known beforehand."""
    monkeypatch.setattr(gapbeam.engine.beam._engine, "gbpath", calls.interruptible(lambda *_: time.sleep(60)))
    interrupt(lambda: gapbeam.solve({**gapped_spans(3), "analysis": {"follow": "events"}}))


@pytest.mark.parametrize("signals", [_thread.interrupt_main, lambda: signal.raise_signal(signal.SIGINT)])
def test_signals_that_another_thread_got(signals):
    interrupt(lambda: calls.interruptible(time.sleep)(60), signals=signals)


def test_what_another_handler_raises_ends_a_call_too():
    class Late(Exception):
        pass

    def late(*_):
        raise Late

    old = signal.signal(signal.SIGALRM, late)
    signal.setitimer(signal.ITIMER_REAL, 0.1)
    with pytest.raises(Late):
        calls.interruptible(time.sleep)(60)
    signal.signal(signal.SIGALRM, old)


@pytest.mark.parametrize("kind", ["handle", "block"])
def test_it_is_heard_where_objects_are_freed(monkeypatch, kind):
    """What frees them is compiled, so no signal is heard inside, where Python would print it and go on."""

    class Pressed(calls.Owned):
        __del__ = property(partial(partial, _thread.interrupt_main))

    def work():
        if kind == "handle":
            held = Pressed(signal.SIGINT)
        else:
            held = Block(np.empty(3), SimpleNamespace(append=partial(next, map(_thread.interrupt_main, [signal.SIGINT]))))
        del held
        time.sleep(0)  # here

    printed = []
    monkeypatch.setattr(sys, "unraisablehook", printed.append)
    old = signal.signal(signal.SIGINT, signal.default_int_handler)
    with pytest.raises(KeyboardInterrupt):
        work()
    signal.signal(signal.SIGINT, old)
    assert not printed


# What ends between two linear solves


def test_the_engine_hears_signals_itself(monkeypatch):
    """In one call, in the main thread; then the beam is as it was."""
    monkeypatch.setattr(calls, "FEW_NODES", 10**12)
    monkeypatch.setattr(calls._BESIDE, "make", None)
    beam = gapbeam.prepare(gapped_spans(3))
    factors = np.random.default_rng(1).uniform(0.0, 9.0, (1_000_000, 3))
    before = beam.solve(factors[:9]).reaction
    interrupt(lambda: beam.solve(factors))
    assert np.array_equal(beam.solve(factors[:9]).reaction, before)


def test_handlers_that_raise_nothing_let_calls_go_on(monkeypatch):
    monkeypatch.setattr(calls, "FEW_NODES", 10**12)
    heard, begun = [], time.perf_counter()
    old = signal.signal(signal.SIGALRM, lambda *_: heard.append(time.perf_counter()))
    beam = gapbeam.prepare(gapped_spans(3))
    factors = np.random.default_rng(1).uniform(0.0, 9.0, (1_000_000, 3))
    signal.setitimer(signal.ITIMER_REAL, 0.005, 0.005)
    found = beam.solve(factors)
    signal.setitimer(signal.ITIMER_REAL, 0.0)
    signal.signal(signal.SIGALRM, old)
    assert (found.status == 0).all()
    assert len(heard) > 2
    assert np.diff([begun, *heard]).max() < SECOND


def test_what_goes_on_beside_is_ended_too(monkeypatch):
    """The thread has ended its call, long before it was done, and takes the next one."""
    monkeypatch.setattr(calls, "NODES_AT_A_TIME", 10**12)
    ended, direct = [], calls._Call.end
    monkeypatch.setattr(calls._Call, "end", lambda call: ended.append(direct(call)) or ended[-1])
    beam = gapbeam.prepare(gapped_spans(3))
    factors = np.random.default_rng(1).uniform(0.0, 9.0, (1_000_000, 3))
    before = beam.solve(factors[:9]).reaction
    interrupt(lambda: beam.solve(factors))
    assert ended in ([True], [])  # or Python itself was at work
    assert np.array_equal(beam.solve(factors[:9]).reaction, before)


def test_a_lock_that_ctrl_c_has_kept_holds_up_no_later_call():
    """Ctrl-C may come between that the lock of a call that is left is there and that anybody knows."""
    handle, over = gapbeam.prepare(gapped_spans(3))._solver.beam.handle, calls._Over()
    over.tell()
    assert over.lock.acquire(timeout=0.0)
    handle.left = os.getpid(), over
    assert calls.interruptible(lambda _: 7)(handle) == 7
    assert handle.left is None


def test_small_beams_on_ground_are_interrupted(monkeypatch):
    """On curves even a few nodes may take long between two solves, so they are solved beside."""
    made, make = [], calls._BESIDE.make
    monkeypatch.setattr(calls._BESIDE, "make", lambda *about: made.append(about[0]) or make(*about))
    scene = {
        "beam": {"spans": [6.0, 6.0], "EI": 1e4},
        "foundation": [{"law": {"type": "tanh", "stiffness": 500.0, "limit": 30.0}, "side": "below"}],
        "loads": [{"type": "uniform", "q": 2.0, "case": "dead"}, {"type": "force", "x": 4.1, "F": 50.0}],
    }
    assert gapbeam.solve(scene).status == "solved"
    assert calls._solve in made
    interrupt(lambda: gapbeam.solve({**scene, "analysis": {"steps": 200}}))


# The thread beside the main one


def test_the_thread_that_is_left_ends_with_its_call():
    ended = threading.Event()

    def routine():
        time.sleep(1.5)
        ended.set()

    interrupt(calls.interruptible(routine), 0.1)
    assert calls._BESIDE.calls is None
    assert calls.interruptible(lambda: 7)() == 7
    assert not ended.is_set()
    assert ended.wait(5)


def test_the_next_call_with_a_beam_waits_for_the_one_that_is_left():
    """It would be ended with it, and told of a signal that is long past."""
    solution = gapbeam.solve(gapped_spans(300)).steps[-1].solution
    certified, begun, may_end, ended = solution.certify(), threading.Event(), threading.Event(), threading.Event()

    def stubborn(_):
        """Look at nothing until told."""
        begun.set()
        may_end.wait(60)
        ended.set()

    def interrupt():
        """Again where the signal came in a callback of Python's own, which swallows it."""
        begun.wait()
        while not left.is_set():
            _thread.interrupt_main()
            left.wait(5)

    left, interrupting = threading.Event(), threading.Thread(target=interrupt)
    # A shell lets what it starts in the background ignore the signal
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        interrupting.start()
        with pytest.raises(KeyboardInterrupt):
            calls.interruptible(stubborn)(solution.state.beam.handle)
        left.set()
        interrupting.join()
    finally:
        signal.signal(signal.SIGINT, before)
    assert not ended.is_set()
    threading.Timer(4 * calls.PATIENCE, may_end.set).start()
    again = solution.certify()
    assert ended.is_set()
    assert all(np.array_equal(one, other) for one, other in zip(certified, again, strict=True))
    assert solution.state.beam.handle.left is None


def test_errors_and_results_come_back():
    assert calls.interruptible(divmod)(7, 2) == (3, 1)
    with pytest.raises(ZeroDivisionError):
        calls.interruptible(divmod)(7, 0)


def test_nothing_is_kept():
    """The thread holds no arrays of the call before, which may be large."""

    class Large:
        pass

    import weakref

    large = Large()
    gone = weakref.ref(large)
    calls.interruptible(lambda _: None)(large)
    del large
    for _ in range(100):
        if gone() is None:
            break
        time.sleep(0.01)
    assert gone() is None


def test_short_calls_stay_in_the_main_thread(monkeypatch):
    monkeypatch.setattr(calls._BESIDE, "make", None)
    assert gapbeam.solve(gapped_spans(30)).status == "solved"
    assert gapbeam.prepare(gapped_spans(3)).solve(np.ones((10, 3))).status.tolist() == [0] * 10


def test_in_other_threads_and_processes():
    """Threads of a pool call for themselves; a forked process has a thread of its own."""
    scene = gapped_spans(2000)
    reaction = gapbeam.solve(scene).steps[-1].reaction
    found = []
    thread = threading.Thread(target=lambda: found.append(gapbeam.solve(scene).steps[-1].reaction))
    thread.start()
    thread.join()
    assert np.array_equal(found[0], reaction)
    child = os.fork()
    if child == 0:
        signal.alarm(20)
        os._exit(not np.array_equal(gapbeam.solve(scene).steps[-1].reaction, reaction))
    assert os.waitpid(child, 0)[1] == 0


# Cases in parts


@pytest.mark.parametrize("seed", range(20))
def test_parts_change_no_digit(monkeypatch, seed):
    import random

    rng = random.Random(seed)
    made = random_scene(rng, held=rng.choice((True, None)))
    beam = gapbeam.prepare({**made, "analysis": {}})
    factors = np.random.default_rng(seed).choice([0.0, 1.0, -1.0, 0.5, 3.0], (300, max(len(made["loads"]), 1)))
    whole = beam.solve(factors)
    monkeypatch.setattr(calls, "FEW_NODES", 0)
    monkeypatch.setattr(calls, "NODES_AT_A_TIME", 20)
    monkeypatch.setattr(calls, "SECONDS", 1e-5)
    parts = beam.solve(factors)
    for name in ("status", "closed", "reaction", "deflection", "moment_left", "moment_right", "solves"):
        assert np.array_equal(getattr(whole, name), getattr(parts, name), equal_nan=True), name


def test_parts_take_a_fraction_of_a_second(monkeypatch):
    sizes, direct = [], calls._long_cases

    def timed(*arguments):
        begin = time.perf_counter()
        found = direct(*arguments)
        sizes.append((arguments[-3].shape[1], time.perf_counter() - begin))
        return found

    monkeypatch.setattr(calls, "_long_cases", timed)
    gapbeam.prepare(gapped_spans(30)).solve(np.ones((60_000, 30)))
    assert sum(size for size, _ in sizes) == 60_000
    assert max(seconds for _, seconds in sizes) < SECOND
    assert len(sizes) > 2


# The command

AT_IMPORTS = """
import os, signal, sys
signal.signal(signal.{name}, signal.{handler})
count = -1

def press(event, about):
    global count
    if event == "import":
        count += about[0] == "gapbeam.cli" or count >= 0
        if count == {after}:
            os.kill(os.getpid(), signal.{name})

sys.addaudithook(press)
try:
    from gapbeam.cli import main
except KeyboardInterrupt:
    os._exit(77)  # the import of the package itself, which is no line of the command yet
sys.argv[1:] = ["run", "scene.json", "--quiet"]
sys.exit(main())
"""
ENDINGS = {"SIGINT": (130, "gapbeam: interrupted\n"), "SIGTERM": (143, "gapbeam: ended by SIGTERM\n")}


@pytest.mark.parametrize(("name", "handler"), [("SIGINT", "default_int_handler"), ("SIGTERM", "SIG_DFL")])
def test_the_command_is_ended_from_its_first_line_on(tmp_path, monkeypatch, name, handler):
    """A signal at the first imports, at all others now and then, while the command loads itself."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scene.json").write_text(json.dumps(gapped_spans(3)))
    for after in (2, 3, 4, 5, 10, 30, 60, 100, 200):
        words = [sys.executable, "-c", AT_IMPORTS.format(name=name, handler=handler, after=after)]
        run = subprocess.run(words, capture_output=True, text=True, timeout=50)
        assert (run.returncode, run.stderr) == ENDINGS[name], after
        assert run.stdout == ""


@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM"])
def test_the_command_is_ended_while_python_ends(tmp_path, monkeypatch, name):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scene.json").write_text(json.dumps(gapped_spans(3)))
    ending = f"import atexit, os, signal, sys; signal.signal(signal.SIGINT, signal.default_int_handler);" \
        f"atexit.register(os.kill, os.getpid(), signal.{name}); from gapbeam.cli import main; sys.exit(main())"
    run = subprocess.run([sys.executable, "-c", ending, "check", "scene.json"], capture_output=True, text=True, timeout=50)
    assert (run.returncode, run.stderr) == ENDINGS[name]
    assert run.stdout.startswith("scene.json: valid")


def test_importing_gapbeam_changes_no_handler():
    words = "import signal; before = [signal.getsignal(k) for k in (2, 15)]; import gapbeam, gapbeam.cli; gapbeam.solve;" \
        "gapbeam.cli.main(['schema']); assert before == [signal.getsignal(k) for k in (2, 15)]"
    assert subprocess.run([sys.executable, "-c", words], capture_output=True, timeout=50).returncode == 0


def test_signals_that_are_ignored_stay_so(tmp_path, monkeypatch):
    """As under nohup."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scene.json").write_text(json.dumps(gapped_spans(3)))
    words = "import os, signal, sys; signal.signal(signal.SIGHUP, signal.SIG_IGN); import gapbeam.cli as cli;" \
        "cli.see_to_signals(); os.kill(os.getpid(), signal.SIGHUP); sys.exit(cli.main())"
    assert subprocess.run([sys.executable, "-c", words, "check", "scene.json"], capture_output=True, timeout=50).returncode == 0


COMMAND = """
import os, signal, sys, threading, time
signal.signal(signal.SIGINT, signal.default_int_handler)
import gapbeam.plots, gapbeam.report, gapbeam.results.stepping
from gapbeam.cli import main

def press():
    while not {when}:
        time.sleep(0.01)
    with open("pressed", "w") as stream:
        stream.write(repr(time.time()))
    os.kill(os.getpid(), signal.{name})

begin = time.time()
threading.Thread(target=press, daemon=True).start()
sys.exit(main())
"""
LATER = "time.time() > begin + 0.5"
WRITING = "any(name.startswith('.gapbeam-') and os.stat(name).st_size for name in os.listdir())"


@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM"])
@pytest.mark.parametrize(
    ("spans", "analysis", "when"), [(300, {"steps": 10**5}, LATER), (100_000, {}, LATER), (20_000, {}, WRITING)]
)
def test_the_command_is_interrupted(tmp_path, monkeypatch, spans, analysis, when, name):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scene.json").write_text(json.dumps({**gapped_spans(spans), "analysis": analysis}))
    (tmp_path / "a.json").write_text("as it was")
    code = COMMAND.format(when=when, name=name)
    words = [sys.executable, "-c", code, "run", "scene.json", "--json", "a.json", "--csv", "a.csv"]
    run = subprocess.run(words, capture_output=True, text=True)
    ended = time.time()
    assert (run.returncode, run.stdout, run.stderr) == (ENDINGS[name][0], "", ENDINGS[name][1])
    assert ended - float((tmp_path / "pressed").read_text()) < SECOND
    assert (tmp_path / "a.json").read_text() == "as it was"
    assert sorted(os.listdir()) == ["a.json", "pressed", "scene.json"]


FREEING = """
import os, signal, sys, time, weakref
signal.signal(signal.SIGINT, signal.default_int_handler)
import gapbeam.scene.reading
from gapbeam.cli import main

class Held:
    pass

def press(_):
    os.kill(os.getpid(), signal.SIGINT)
    time.sleep(0.1)

def read_scene(_):
    held = Held()
    reference = weakref.ref(held, press)
    del held
    time.sleep(60)

gapbeam.scene.reading.read_scene = read_scene
sys.exit(main())
"""


def test_the_command_is_interrupted_while_objects_are_freed():
    """Where Python drops a KeyboardInterrupt."""
    run = subprocess.run([sys.executable, "-c", FREEING, "check", "scene.json"], capture_output=True, text=True, timeout=50)
    assert (run.returncode, run.stdout, run.stderr) == (130, "", "gapbeam: interrupted\n")


STUDIES = f"import runpy; main = lambda: runpy.run_path({str(TOP / 'tests' / 'studies')!r}, run_name='__main__')"


@pytest.mark.parametrize("study", ["extremes", "accuracy", "contact", "kernel", "schemes"])
def test_studies_are_interrupted(tmp_path, monkeypatch, study):
    monkeypatch.chdir(tmp_path)
    code, words = COMMAND.format(when="time.time() > begin + 1", name="SIGINT"), ["study", study]
    if study != "accuracy":
        code, words = code.replace("from gapbeam.cli import main", STUDIES), [study]
    run = subprocess.run([sys.executable, "-c", code, *words, "--markdown", "a.md"], capture_output=True, text=True)
    ended = time.time()
    assert (run.returncode, run.stdout, run.stderr) == (130, "", "gapbeam: interrupted\n")
    assert ended - float((tmp_path / "pressed").read_text()) < SECOND
    assert os.listdir() == ["pressed"]


def test_waiting_for_standard_input_is_interrupted(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    words = [sys.executable, "-c", COMMAND.format(when=LATER, name="SIGINT"), "check", "-"]
    with subprocess.Popen(words, stdin=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.wait() == 130
        assert process.stderr.read() == "gapbeam: interrupted\n"


def test_main_gives_the_status_to_its_caller(monkeypatch, capsys):
    monkeypatch.setattr("gapbeam.scene.reading.read_scene", lambda _: signal.raise_signal(signal.SIGINT))
    old = signal.signal(signal.SIGINT, signal.default_int_handler)
    assert main(["check", "scene.json"]) == 130
    signal.signal(signal.SIGINT, old)
    assert capsys.readouterr() == ("", "gapbeam: interrupted\n")
