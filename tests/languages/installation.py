"""The library built and installed to a prefix of its own, and programs built against it with pkg-config alone."""

import os
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

import pytest

TOP = Path(__file__).resolve().parents[2]
LANGUAGES = TOP / "examples" / "languages"
BUILDS = Path(".venv", "build")
NEEDED = ("meson", "ninja", "gfortran", "cc", "pkg-config")


@dataclass(frozen=True)
class Installation:
    """An installed library.

    Attributes
    ----------
    prefix : Path
        Where it is.
    build : Path
        The folder it was built in.
    """

    prefix: Path
    build: Path

    @property
    def library(self) -> Path:
        """The shared library."""
        return self.prefix / "lib" / "libgapbeam.so"

    @property
    def environment(self) -> dict[str, str]:
        """Environment in which pkg-config, CMake and the loader find it."""
        return os.environ | {
            "PKG_CONFIG_PATH": str(self.prefix / "lib" / "pkgconfig"),
            "CMAKE_PREFIX_PATH": str(self.prefix),
            "LD_LIBRARY_PATH": str(self.prefix / "lib"),
        }

    def run(self, *command, expect: int = 0, **keys) -> subprocess.CompletedProcess:
        """Run a command in that environment and hold its exit status against the one expected."""
        done = subprocess.run(
            list(map(str, command)), env=self.environment | keys.pop("env", {}), capture_output=True, text=True, **keys
        )
        assert done.returncode == expect, f"{command}: {done.returncode}\n{done.stdout}\n{done.stderr}"
        return done

    def pkg_config(self, *options: str) -> list[str]:
        """Ask pkg-config for the flags of the library."""
        return self.run("pkg-config", *options, "gapbeam").stdout.split()

    def compile(self, source: Path, program: Path, *options: str) -> Path:
        """Build a program with pkg-config alone."""
        compilers = {
            ".c": ["cc", "-std=c11", "-pedantic"],
            ".f90": ["gfortran", "-std=f2018", "-J", program.parent],
            ".f": ["gfortran", "-std=legacy"],
        }
        flags = ["-Wall", "-Wextra", "-Werror", *options, *self.pkg_config("--cflags", "--libs")]
        self.run(*compilers[source.suffix], source, "-o", program, *flags)
        return program


def install(folder: Path, *options: str, like: Installation | None = None) -> Installation:
    """Build and install the library under a folder, with options of meson; skip the test where a tool for that is missing.

    What another installation, or else the package that `tests/run` made, was built of is copied, so that only what the options
    change is compiled. The sources go along, since the compiler's commands hold places relative to the build.
    """
    missing = [name for name in NEEDED if shutil.which(name) is None]
    if missing:
        pytest.skip(f"not on this machine: {', '.join(missing)}")
    tree, prefix = folder / "tree", folder / "prefix"
    build, made = tree / BUILDS / "library", like.build if like else TOP / BUILDS / "package"
    shutil.copytree(TOP / "fortran", tree / "fortran")
    for name in ("meson.build", "meson.options"):
        shutil.copy2(TOP / name, tree)
    off = ("-Dpython=disabled", "-Dtests=disabled")
    setup = ["meson", "setup", build, tree, f"--prefix={prefix}", "-Dlibdir=lib", *off, *options]
    if made.exists():
        shutil.copytree(made, build, symlinks=True)
        setup += ["--reconfigure"]
    for command in (setup, ["meson", "install", "-C", build]):
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
        assert done.returncode == 0, f"{done.stdout}\n{done.stderr}"
    return Installation(prefix, build)


def install_once(folders, name: str, *options: str, like: Installation | None = None) -> Installation:
    """Install in a temporary folder; the processes of `pytest -n` share it: who comes first builds, the others wait."""
    if "PYTEST_XDIST_WORKER" not in os.environ:
        return install(folders.mktemp(name), *options, like=like)
    import fcntl

    folder = folders.getbasetemp().parent / name
    with open(f"{folder}.lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if (folder / "done").exists():
            return Installation(folder / "prefix", folder / "tree" / BUILDS / "library")
        found = install(folder, *options, like=like)
        (folder / "done").touch()
        return found
