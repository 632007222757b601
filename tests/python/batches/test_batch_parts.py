"""Parts of a batch, as jobs of an array solve them into one folder."""

import os
import signal
import subprocess
import sys
import time
from itertools import pairwise

import gapbeam
import pytest
from gapbeam.batches.chunks import best_format
from gapbeam.batches.folder import Folder, locked
from gapbeam.cli import main

from .test_batch import SCENE, TOML, digests, table


def solve(path, part=None, cases=100, **options):
    return gapbeam.batch(SCENE, table(cases), path, chunk=7, part=part, **options)


def test_parts_make_the_files_of_the_whole(tmp_path):
    solve(tmp_path / "whole")
    for number in (3, 1, 4, 2):
        done = solve(tmp_path / "parts", (number, 4))
        assert done.statuses() == {"solved": done.done}
    assert digests(tmp_path / "parts") == digests(tmp_path / "whole")
    assert gapbeam.Batch(tmp_path / "parts").done == 100


def test_a_part_is_some_files_and_every_file_is_of_one_part(tmp_path):
    done = [solve(tmp_path / "out", (number, 4)) for number in range(1, 5)]
    cases = [one.read("case")["case"].tolist() for one in done]
    assert sum(cases, []) == list(range(100))  # noqa: RUF017
    assert {len(one) for one in cases} <= {21, 28, 30, 23}
    for count in (1, 2, 15, 40):
        ranges = [Folder(tmp_path, {"chunks": 15}, (number, count)).chunks() for number in range(1, count + 1)]
        assert (ranges[0].start, ranges[-1].stop) == (0, 15)
        assert all(one.stop == other.start for one, other in pairwise(ranges))
    empty = solve(tmp_path / "out", (1, 40))
    assert (empty.done, empty.read("case")["case"].size) == (0, 0)


def test_a_part_goes_on_and_touches_no_other(tmp_path):
    counted = []
    solve(tmp_path / "out", (2, 3))
    before = {one: os.stat(tmp_path / "out" / one).st_mtime_ns for one in os.listdir(tmp_path / "out") if one.startswith("part")}
    assert sorted(before) == [f"part-{k:06d}.{next(iter(before))[12:]}" for k in range(5, 10)]
    (tmp_path / "out" / sorted(before)[1]).unlink()
    left = [tmp_path / "out" / name for name in (".part-000006.npy.2-of-3", ".part-000001.npy.1-of-3")]
    for one in left:
        one.write_bytes(b"half")
    solve(tmp_path / "out", (2, 3), progress=lambda done, total: counted.append((done, total)))
    assert (counted[0], counted[-1]) == ((28, 35), (35, 35))
    assert [one.exists() for one in left] == [False, True]  # of the other part, which may be at work
    after = {one: os.stat(tmp_path / "out" / one).st_mtime_ns for one in before}
    assert [one for one in before if after[one] != before[one]] == sorted(before)[1:2]
    solve(tmp_path / "out")
    solve(tmp_path / "whole")
    assert digests(tmp_path / "out") == digests(tmp_path / "whole")


def test_what_is_at_work_keeps_others_out(tmp_path):
    with locked(tmp_path / "out", (1, 3)):
        with pytest.raises(gapbeam.SceneError, match="the same part is at work"):
            solve(tmp_path / "out", (1, 3))
        with pytest.raises(gapbeam.SceneError, match="another batch writes"):
            solve(tmp_path / "out")
        solve(tmp_path / "out", (2, 3))
        solve(tmp_path / "out", (1, 4))
    with locked(tmp_path / "out"), pytest.raises(gapbeam.SceneError, match="another batch writes"):
        solve(tmp_path / "out", (3, 3))
    solve(tmp_path / "out", (3, 3))


def test_parts_at_once_and_killed(tmp_path):
    program = (
        "import gapbeam, numpy, sys\n"
        "from batches_scene import SCENE\n"
        "place = numpy.random.default_rng(2).uniform(1.0, 16.0, 1200)\n"
        "part = tuple(map(int, sys.argv[2:])) or None\n"
        "gapbeam.batch(SCENE, {'loads[1].x': place}, sys.argv[1], chunk=20, part=part, jobs=1)\n"
    )
    (tmp_path / "batches_scene.py").write_text(f"SCENE = {SCENE!r}\n")

    def start(*words):
        return subprocess.Popen([sys.executable, "-c", program, *map(str, words)], cwd=tmp_path)

    jobs = [start(tmp_path / "out", number, 3) for number in (1, 2, 3)]
    killed = tmp_path / "out" / f"part-000022.{best_format()}"  # the third of its twenty
    while not killed.exists():
        assert jobs[1].poll() is None
        time.sleep(0.005)
    os.kill(jobs[1].pid, signal.SIGKILL)
    assert [job.wait() for job in jobs] == [0, -signal.SIGKILL, 0]
    assert 42 < len(list((tmp_path / "out").glob("part-*"))) < 60
    assert start(tmp_path / "out", 2, 3).wait() == 0
    assert start(tmp_path / "whole").wait() == 0
    assert digests(tmp_path / "out") == digests(tmp_path / "whole")


def test_command_tells_of_its_part(tmp_path, capsys):
    (tmp_path / "scene.toml").write_text(TOML)
    (tmp_path / "table.csv").write_text("supports[0].gap\n" + "0.01\n" * 20)
    words = ["batch", str(tmp_path / "scene.toml"), str(tmp_path / "table.csv"), "--out", str(tmp_path / "out"), "--part"]
    assert main([*words, "1/1"]) == 0
    assert capsys.readouterr().out.startswith(f"{tmp_path / 'out'}, part 1/1: 20 of 20 cases: 20 solved; 20 of them in ")
    for wrong in ("0/3", "4/3", "1", "1/", "a/b", "1/2/3", "-1/3"):
        assert main([*words[:-1], f"--part={wrong}"]) == 2
        assert f'--part: expected a number and how many parts there are, 1/64 to 64/64, got "{wrong}"' in capsys.readouterr().err


@pytest.mark.parametrize("part", [(0, 3), (4, 3), (1,), "1/3", (1.0, 3), 3, (True, 1)])
def test_other_parts_are_refused(tmp_path, part):
    with pytest.raises(gapbeam.SceneError, match="part: expected a number and how many parts"):
        solve(tmp_path / "out", part)
    assert not (tmp_path / "out").exists()
