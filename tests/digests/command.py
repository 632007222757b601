"""The command: two trees are built, both solve the same scenes, and what differs is printed."""

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

from sabotage.workshop import Workshop

from .drawn import TOP, write_scenes

COLLECTOR = Path(__file__).with_name("collect.py")
MOST_SHOWN = 20


class Side(Workshop):
    """A tree with its builds, for speed as they are installed.

    Parameters
    ----------
    folder : Path
        Where it is, or comes to be.
    commit : str
        Name of a commit; empty for the tree as it lies here.
    """

    options = ("-Dbuildtype=release",)

    def __init__(self, folder, commit):
        self.commit = commit
        super().__init__(folder)
        self.set_up(self.programs, "-Dtests=disabled")
        self.run("ninja", "-C", str(self.programs))

    def copy_tree(self):
        """Take the files of the commit; those that are the same stay as they are, so that little is compiled."""
        if not self.commit:
            super().copy_tree()
            return
        with tempfile.TemporaryDirectory() as fresh:
            archive = Path(fresh) / "tree.tar"
            self.run("git", "-C", str(TOP), "archive", "-o", str(archive), self.commit)
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

    def collect(self, scenes):
        """Begin to solve all scenes; the process, and where it writes."""
        library = next((self.programs / "fortran").glob("libgapbeam.so"))
        keys = {"PYTHONPATH": str(self.site), "PYTHONDONTWRITEBYTECODE": "1"}
        return collect(scenes, library, self.top.parent / "digests", **keys)


def collect(scenes, library, path, **environment):
    """Begin to solve all scenes with the gapbeam of an environment; the process, and the file to which it writes."""
    command = [sys.executable, str(COLLECTOR), str(scenes), str(library)]
    with open(path, "wb") as output:
        return subprocess.Popen(command, env=dict(os.environ, **environment), stdout=output), path


def read_digests(process, path):
    """Digests by scene and by what they are of, as a process has written them when it ends."""
    if process.wait():
        raise SystemExit(f"the collector ended with {process.returncode}")
    lines = [json.loads(line) for line in path.read_text().splitlines()]
    return {(name, what): digest for name, what, digest in lines}


def changed(ours, theirs):
    """What differs: scene and what of it; ways that one of both does not have at all are not compared."""
    ways = {what for _, what in ours} & {what for _, what in theirs}
    keys = {key for key in ours.keys() | theirs.keys() if key[1] in ways}
    return sorted(key for key in keys if ours.get(key) != theirs.get(key))


def commit_beside():
    """The commit before; the last one, where files are changed but not committed."""
    status = subprocess.run(["git", "-C", str(TOP), "status", "--porcelain"], capture_output=True, text=True, check=True)
    return "HEAD" if status.stdout.strip() else "HEAD~1"


def main(arguments=None):
    """The command; its exit status is 1 if a number has changed."""
    parser = argparse.ArgumentParser("python tests/digests", description=__doc__.splitlines()[0])
    parser.add_argument("--beside", metavar="COMMIT", help="the other commit (default: the one before)")
    parser.add_argument("--count", type=int, default=500, help="scenes drawn at random (default 500)")
    parser.add_argument("--folder", type=Path, default=TOP / ".venv" / "digests", help="where both are built (.venv/digests)")
    chosen = parser.parse_args(arguments)
    chosen.folder.mkdir(parents=True, exist_ok=True)
    scenes = chosen.folder / "scenes"
    number = write_scenes(chosen.count, scenes)
    beside = chosen.beside or commit_beside()
    sides = [Side(chosen.folder / "here", ""), Side(chosen.folder / "beside", beside)]
    here, there = (read_digests(*begun) for begun in [side.collect(scenes) for side in sides])
    return said(here, there, number, beside)


def said(here, there, number, beside):
    """Print what was compared and what has changed; the exit status."""
    differences = changed(here, there)
    for name, what in differences[:MOST_SHOWN]:
        print(f"changed: {name} ({what})")
    if len(differences) > MOST_SHOWN:
        print(f"and {len(differences) - MOST_SHOWN} more")
    total, other = (Counter(what for _, what in keys) for keys in (here, differences))
    for what, count in sorted(total.items()):
        print(f"{what:12} {count:6} digests, {other[what]} changed")
    print(f"{number} scenes beside {beside}: {'nothing has changed' if not differences else 'numbers have changed'}")
    return 1 if differences or not here else 0
