"""The command: two trees are built, both solve the same scenes, and what differs is printed."""

import argparse
import hashlib
import itertools
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path
from time import monotonic

from sabotage.workshop import Workshop

from .drawn import TOP, write_scenes

COLLECTOR = Path(__file__).with_name("collect.py")
MOST_SHOWN = 20
AT_A_TIME = 100  # scenes in a process
EVERY = 10.0  # seconds between two lines of progress


class Side(Workshop):
    """A tree with its builds, for speed as they are installed.

    Parameters
    ----------
    folder : Path
        Where it is, or comes to be. What a commit was built into is built once.
    commit : str
        Full name of a commit; empty for the tree as it lies here.
    """

    options = ("-Dbuildtype=release",)

    def __init__(self, folder, commit):
        self.commit, self.folder = commit, folder
        folder.mkdir(parents=True, exist_ok=True)
        stamp = folder / "built"
        if commit and stamp.exists() and stamp.read_text() == commit:
            self.top, self.site, self.programs = folder / "tree", folder / "site", folder / "programs"
            return
        super().__init__(folder)
        self.set_up(self.programs, "-Dtests=disabled")
        self.run("ninja", "-C", str(self.programs))
        stamp.write_text(commit)

    def copy_tree(self):
        """Take the files of the commit; those that are the same stay as they are, so that little is compiled."""
        if not self.commit:
            super().copy_tree()
            return
        with tempfile.TemporaryDirectory() as fresh:
            archive = Path(fresh) / "tree.tar"
            super().run("git", "-C", str(TOP), "archive", "-o", str(archive), self.commit)
            shutil.unpack_archive(archive, Path(fresh) / "tree", filter="data")
            archive.unlink()
            self.take_files(Path(fresh) / "tree")

    def take_files(self, tree):
        """Bring the copy into the state of another tree."""
        wanted = {path.relative_to(tree) for path in tree.rglob("*") if path.is_file()}
        for name in wanted:
            ours = self.top / name
            if not ours.exists() or ours.read_bytes() != (tree / name).read_bytes():
                ours.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(tree / name, ours)
        for path in [path for path in self.top.rglob("*") if path.is_file() and path.relative_to(self.top) not in wanted]:
            path.unlink()

    def run(self, *command):
        """Run a command of the build; of what compiles tell how far it is."""
        if command[0] != "ninja":
            super().run(*command)
            return
        where = os.pathsep.join([os.path.dirname(sys.executable), os.environ["PATH"]])
        progress, last = Progress(f"building {self.commit[:12] or 'this tree'}", "files"), []
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              env=dict(os.environ, PATH=where)) as process:  # fmt: skip
            for line in process.stdout:
                last = [*last[-30:], line]
                if step := re.match(r"\[(\d+)/(\d+)\]", line):
                    progress.tell(*map(int, step.groups()))
        if process.returncode:
            raise RuntimeError(f"ninja: {''.join(last)[-1500:]}")

    def collect(self, scenes, number, options):
        """Digests of all scenes, several processes at a time; of a commit those that were found before are kept."""
        made = hashlib.sha256(scenes.read_bytes() + COLLECTOR.read_bytes()).hexdigest()[:16]
        kept = self.folder / f"digests{''.join(options)}-{made}"
        if self.commit and kept.exists():
            return read_digests(kept)
        library = next((self.programs / "fortran").glob("libgapbeam.so"))
        keys = {"PYTHONPATH": str(self.site), "PYTHONDONTWRITEBYTECODE": "1"}
        progress = Progress(f"solving with {self.commit[:12] or 'this tree'}", "scenes")
        lines = collect(scenes, number, progress, library, self.top / "tests", options=options, **keys)
        kept.write_bytes(b"".join(lines))
        return read_digests(kept)


class Progress:
    """Lines that tell how far something is.

    Parameters
    ----------
    what, of : str
        What goes on, and what is counted.
    """

    def __init__(self, what, of):
        self._what, self._of, self._next = what, of, monotonic() + EVERY

    def tell(self, done, number):
        """Tell it, now and then."""
        if monotonic() >= self._next:
            self._next = monotonic() + EVERY
            print(f"... {self._what}: {done:,} of {number:,} {self._of}", flush=True)


def collect(scenes, number, progress, *library, options=(), **environment):
    """Solve all scenes with the gapbeam of an environment.

    Parameters
    ----------
    scenes : Path
        By `write_scenes`, so many.
    number : int
    progress : Progress
    library
        Path of the library, and folder of the tests that know how to call it; may be left out.
    options : tuple of str
        Of the collector.
    environment
        Variables.

    Returns
    -------
    list of bytes
        What the collectors print.
    """

    def some(first):
        command = [sys.executable, str(COLLECTOR), *options, str(scenes), str(first), str(first + AT_A_TIME), *map(str, library)]
        done = subprocess.run(command, env=dict(os.environ, **environment), capture_output=True, check=False)
        if done.returncode:
            raise SystemExit(f"the collector of scenes {first} and on ended with {done.returncode}: {done.stderr.decode()[-600:]}")
        return first, done.stdout

    found = {}
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for one in as_completed([pool.submit(some, first) for first in range(0, number, AT_A_TIME)]):
            first, printed = one.result()
            found[first] = printed
            progress.tell(min(len(found) * AT_A_TIME, number), number)
    return [found[first] for first in sorted(found)]


def read_digests(path):
    """Digests by scene, way and kind of number, as collectors have written them."""
    return {
        (name, what, kind): digest
        for name, what, found in map(json.loads, path.read_text().splitlines())
        for kind, digest in found.items()
    }


def alike(one, other, within):
    """Tell whether values differ by no more than a share of the largest of their kind in the scene.

    Parameters
    ----------
    one, other
        Digests, or lists of numbers and words.
    within : float
        The share; 0 for the same.
    """
    if one == other or not within or not (isinstance(one, list) and isinstance(other, list)):
        return one == other
    pairs = list(pairs_of(one, other))
    largest = max((abs(b) for pair in pairs for b in pair if isinstance(b, float) and math.isfinite(b)), default=0.0)
    return all(
        a == b or (isinstance(a, float) and isinstance(b, float) and (abs(a - b) <= within * largest or (a != a and b != b)))
        for a, b in pairs
    )


def pairs_of(one, other):
    """Values at the same places; where there are not as many, a pair that differs."""
    if isinstance(one, list) and isinstance(other, list):
        for a, b in itertools.zip_longest(one, other, fillvalue="none"):
            yield from pairs_of(a, b)
    else:
        yield one, other


def changed(ours, theirs, within=0.0):
    """What differs: scene, way and kind of number, and the kinds that only this tree has in any scene.

    A kind that is new is no change; one that is gone is.
    """
    known = {key[1:] for key in theirs}
    new = sorted({key[1:] for key in ours} - known)
    keys = {key for key in ours.keys() | theirs.keys() if key[1:] in known}
    return sorted(key for key in keys if not alike(ours.get(key), theirs.get(key), within)), new


def full_name(commit):
    """The whole name of a commit; by default of the one before, and of the last one, where files are changed but not committed."""
    if not commit:
        status = subprocess.run(["git", "-C", str(TOP), "status", "--porcelain"], capture_output=True, text=True, check=True)
        commit = "HEAD" if status.stdout.strip() else "HEAD~1"
    command = ["git", "-C", str(TOP), "rev-parse", "--verify", f"{commit}^{{commit}}"]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()


def main(arguments=None):
    """The command; its exit status is 1 if a number has changed."""
    parser = argparse.ArgumentParser("python tests/digests", description=__doc__.splitlines()[0])
    parser.add_argument("--beside", metavar="COMMIT", help="the other commit (default: the one before)")
    parser.add_argument("--count", type=int, default=500, help="scenes drawn at random (default 500)")
    parser.add_argument("--within", type=float, default=0.0, metavar="SHARE",
                        help="compare numbers themselves, to this share of the largest of their kind in a scene")  # fmt: skip
    parser.add_argument("--folder", type=Path, default=TOP / ".venv" / "digests", help="where both are built (.venv/digests)")
    chosen = parser.parse_args(arguments)
    chosen.folder.mkdir(parents=True, exist_ok=True)
    scenes = chosen.folder / "scenes"
    number = write_scenes(chosen.count, scenes)
    beside = full_name(chosen.beside)
    theirs, ours = Side(chosen.folder / beside[:12], beside), Side(chosen.folder / "here", "")
    options = ("--numbers",) if chosen.within else ()
    there, here = theirs.collect(scenes, number, options), ours.collect(scenes, number, options)
    return said(here, there, number, beside[:12], chosen.within)


def said(here, there, number, beside, within=0.0):
    """Print what was compared and what has changed; the exit status."""
    differences, new = changed(here, there, within)
    for name, what, kind in differences[:MOST_SHOWN]:
        print(f"changed: {name} ({what}): {kind}")
    if len(differences) > MOST_SHOWN:
        print(f"and {len(differences) - MOST_SHOWN} more")
    for what, kind in new[:MOST_SHOWN]:
        print(f"new: {kind} ({what})")
    total, scenes, other = Counter(), Counter(), Counter(what for _, what, _ in differences)
    for what in (what for _, what, _ in here):
        total[what] += 1
    for what in {(name, what) for name, what, _ in here}:
        scenes[what[1]] += 1
    for what, count in sorted(total.items()):
        print(f"{what:12} {scenes[what]:6} scenes {count:8} digests, {other[what]} changed")
    print(f"{number} scenes beside {beside}: {'nothing has changed' if not differences else 'numbers have changed'}")
    return 1 if differences or not here else 0
