"""A copy of the tree in which things are changed, built without optimization and tested; the tree itself is never touched."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

from .change import TOP

LIMIT = 300.0  # seconds for the tests of a change; what takes longer does not end
ENDLESS, CRASHED = "the tests did not end", "the process did not live to its end"
BUILD = ("-Dbuildtype=plain", "-Doptimization=0", "-Dlanes=least")


class Workshop:
    """A copy with its build.

    Parameters
    ----------
    folder : Path
        Where it is, or comes to be; what is there already is built on.
    compiled : bool
        False: changes are of Python files only, and the extension is that of the gapbeam that Python imports.
    """

    options = BUILD

    def __init__(self, folder, compiled=True):
        self.top, self.build, self.site, self.compiled = folder / "tree", folder / "build", folder / "site", compiled
        self.programs = folder / "programs"
        self.sound, self.unsound = set(), set()
        self.copy_tree()
        if compiled:
            self.set_up(self.build, "-Dpython=enabled", "-Dtests=disabled")
        self.make()

    def copy_tree(self):
        """Copy what git knows of; files that are the same stay as they are, so that little is compiled."""
        known = ("git", "ls-files", "-co", "--exclude-standard")
        names = subprocess.run(known, cwd=TOP, capture_output=True, text=True, check=True)
        wanted = {name for name in names.stdout.splitlines() if (TOP / name).is_file()}
        for name in wanted:
            theirs, ours = TOP / name, self.top / name
            if not ours.exists() or ours.read_bytes() != theirs.read_bytes():
                ours.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(theirs, ours)
        for path in self.top.rglob("*"):
            if path.is_file() and str(path.relative_to(self.top)) not in wanted:
                path.unlink()

    def run(self, *command):
        """Run a command of the build; an error with its last lines if it fails."""
        where = os.pathsep.join([os.path.dirname(sys.executable), os.environ["PATH"]])
        done = subprocess.run(command, capture_output=True, text=True, env=dict(os.environ, PATH=where), check=False)
        if done.returncode:
            raise RuntimeError(f"{command[0]}: {(done.stdout + done.stderr)[-600:]}")

    def set_up(self, build, *options):
        """Make a folder ready to be built in."""
        if not (build / "build.ninja").exists():
            self.run("meson", "setup", str(build), str(self.top), *self.options, *options)

    def make(self):
        """Build what has changed, and put the package together."""
        package, made = self.site / "gapbeam", self.top / "python" / "gapbeam"
        shutil.copytree(made, package, dirs_exist_ok=True)
        if self.compiled:
            self.run("ninja", "-C", str(self.build))
            found = [path for path in self.build.rglob("_*.so") if ".p" not in path.parent.suffix]
        else:
            import gapbeam

            found = Path(gapbeam.__file__).parent.glob("_*.so")
        for path in found:
            if not (package / path.name).exists() or self.compiled:
                shutil.copyfile(path, package / path.name)

    def failing_program(self, test):
        """Build and run a unit test in Fortran: its name if it fails, else empty."""
        program = Path("tests") / Path(test).stem
        self.set_up(self.programs, "-Dtests=enabled")
        self.run("ninja", "-C", str(self.programs), str(program))
        try:
            done = subprocess.run([self.programs / program], capture_output=True, timeout=LIMIT, check=False)
        except subprocess.TimeoutExpired:
            return ENDLESS
        return f"{test}::program" if done.returncode else ""

    def failing(self, tests):
        """Run tests until one fails.

        Parameters
        ----------
        tests : sequence of str
            Files, or tests by name; programs in Fortran.

        Returns
        -------
        str
            The test that fails, or that they did not end; empty if they pass.
        """
        programs = [one.partition("::")[0] for one in tests if ".f90" in one]
        for one in programs:
            if (failed := self.failing_program(one)) and failed not in self.unsound:
                return failed
        tests = [one for one in tests if ".f90" not in one]
        if not tests:
            return ""
        command = [sys.executable, "-m", "pytest", "-x", "-q", "--tb=no", "-p", "no:cacheprovider", "-m", "not alone"]
        command += [*(f"tests/{one}" for one in tests), *(f"--deselect=tests/{one}" for one in self.unsound if ".f90" not in one)]
        keys = {"PYTHONPATH": str(self.site), "PYTHONDONTWRITEBYTECODE": "1", "MPLBACKEND": "Agg"}
        try:
            done = subprocess.run(command, cwd=self.top, env=dict(os.environ, **keys), capture_output=True, text=True,
                                  timeout=LIMIT, check=False)  # fmt: skip
        except subprocess.TimeoutExpired:
            return ENDLESS
        if done.returncode == 0:
            return ""
        if done.returncode < 0:
            return CRASHED
        failed = [line for line in done.stdout.splitlines() if line.startswith(("FAILED", "ERROR"))]
        return failed[0].split(" - ")[0].partition(" tests/")[2] if failed else f"pytest ended with {done.returncode}"

    def tried(self, change):
        """Apply a change, test, and take it back; what fails without it, too, is no test of it.

        Returns
        -------
        outcome : str
            killed, survived or broken (it cannot be built, or its tests cannot be run).
        what : str
            The test that fails, or why it is broken.
        """
        while True:
            try:
                failed = self.failing_with(change)
            except RuntimeError as error:
                return "broken", str(error)
            if not failed:
                return "survived", ""
            if failed in (ENDLESS, CRASHED) or failed in self.sound:
                return "killed", failed
            self.make()
            if "::" not in failed:
                return "broken", failed
            # Without optimization the last digits are others, which a few tests do not bear
            (self.unsound if self.failing([failed]) else self.sound).add(failed)

    def failing_with(self, change):
        """The first test that fails with a change."""
        path = self.top / change.file
        text = path.read_text()
        path.write_text(change.applied(text))
        try:
            self.make()
            return self.failing(change.tests)
        finally:
            path.write_text(text)
