"""What packagers meet: the static library, LAPACK from PyPI, versions that CMake asks for, uninstalling, the wheel."""

import os
import re
import shutil
import subprocess
import sys
import zipfile
from importlib.util import find_spec

import gapbeam
import pytest

from .installation import LANGUAGES, TOP, install_once


@pytest.fixture(scope="session")
def installed_openblas(installed, tmp_path_factory):
    """The library with PyPI's LAPACK, as it is built where the system has none."""
    if find_spec("scipy_openblas32") is None:
        pytest.skip("scipy-openblas32 is not in this environment")
    return install_once(tmp_path_factory, "openblas", "-Dlapack=scipy-openblas32", like=installed)


@pytest.fixture
def wheel_with_openblas(tmp_path):
    """A wheel with PyPI's LAPACK: of a copy of the build that `tests/run` made of the package, else built without optimization."""
    pytest.importorskip("mesonpy")
    pytest.importorskip("scipy_openblas32")
    pytest.importorskip("numpy", minversion="2.1")  # for building; in the environment of tests/lowest it is older
    made, build = TOP / ".venv" / "build" / "package", TOP / ".venv" / "build" / "openblas"
    settings = ["lapack=scipy-openblas32", *(() if made.exists() else ("optimization=0", "lanes=least"))]
    shutil.rmtree(build, ignore_errors=True)
    if made.exists():
        shutil.copytree(made, build, symlinks=True)
    options = ["--no-deps", "--no-build-isolation", "--quiet", "-w", tmp_path, f"--config-settings=build-dir={build}"]
    options += [f"--config-settings=setup-args=-D{one}" for one in settings]
    done = subprocess.run([sys.executable, "-m", "pip", "wheel", *options, TOP], capture_output=True, text=True)
    shutil.rmtree(build)
    assert done.returncode == 0, f"{done.stdout}\n{done.stderr}"
    (wheel,) = tmp_path.glob("gapbeam-*.whl")
    return wheel


def search_path(installation, library):
    """RUNPATH of a library."""
    return re.findall(r"R(?:UN)?PATH.*\[(.*)\]", installation.run("readelf", "-d", library).stdout)


def digits_of_static_program(installation, folder, *options):
    """Output of the paper's beam in C with the static library: the shared one is hidden, pkg-config says all that is needed."""
    lib = folder / "lib"
    shutil.copytree(installation.prefix / "lib", lib, symlinks=True)
    for shared in lib.glob("libgapbeam.so*"):
        shared.unlink()
    flags = [
        flag.replace(str(installation.prefix / "lib"), str(lib))
        for flag in installation.pkg_config("--static", "--cflags", "--libs")
    ]
    installation.run("cc", *options, LANGUAGES / "paper_beam.c", "-o", folder / "program", *flags)
    return installation.run(folder / "program").stdout


def test_static_library(installed, tmp_path, python_digits):
    assert digits_of_static_program(installed, tmp_path) == python_digits


def test_static_program(installed, tmp_path, python_digits):
    """Nothing is left to be found at run time; the linker takes libraries in the order in which they are named."""
    names = re.findall(r"-l(\S+)", " ".join(installed.pkg_config("--static", "--libs-only-l")))
    archives = [f"lib{name}.a" for name in names if name != "gapbeam"]
    missing = [name for name in archives if "/" not in installed.run("cc", f"-print-file-name={name}").stdout]
    if missing:
        pytest.skip(f"not on this machine: {', '.join(missing)}")
    assert digits_of_static_program(installed, tmp_path, "-static") == python_digits
    assert "NEEDED" not in installed.run("readelf", "-d", tmp_path / "program").stdout


def test_library_brings_openblas_along(installed_openblas, tmp_path, python_digits):
    lib = installed_openblas.prefix / "lib"
    assert search_path(installed_openblas, installed_openblas.library) == ["$ORIGIN/gapbeam"]
    assert (lib / "gapbeam" / "libscipy_openblas.so").exists()
    assert "OpenBLAS" in (lib / "gapbeam" / "scipy_openblas.LICENSE.txt").read_text()
    program = installed_openblas.compile(LANGUAGES / "paper_beam.c", tmp_path / "paper_beam")
    assert installed_openblas.run(program).stdout == python_digits
    assert digits_of_static_program(installed_openblas, tmp_path) == python_digits


def test_wheel_brings_openblas_along(wheel_with_openblas, installed, tmp_path, python_digits):
    """The extensions look for it beside themselves, never in the folder of the build; the wheel asks for no other package."""
    unpacked = tmp_path / "unpacked"
    zipfile.ZipFile(wheel_with_openblas).extractall(unpacked)
    assert {path.name for path in unpacked.iterdir()} == {"gapbeam", f"gapbeam-{gapbeam.__version__}.dist-info"}
    extensions = sorted((unpacked / "gapbeam").glob("_*.so"))
    assert len(extensions) == 2
    assert [search_path(installed, extension) for extension in extensions] == 2 * [["$ORIGIN"]]
    assert (unpacked / "gapbeam" / "scipy_openblas.LICENSE.txt").exists()
    (metadata,) = unpacked.glob("gapbeam-*.dist-info/METADATA")
    assert "scipy-openblas32" not in metadata.read_text().partition("\n\n")[0]
    done = subprocess.run(
        [sys.executable, LANGUAGES / "paper_beam.py"],
        env=os.environ | {"PYTHONPATH": str(unpacked)}, capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert done.stdout == python_digits


@pytest.mark.skipif(shutil.which("cmake") is None, reason="no CMake on this machine")
def test_versions_that_cmake_asks_for(installed, tmp_path):
    major, minor, patch = gapbeam.__version__.split(".")
    before, this, after, later = (f"{major}.{int(minor) + step}" for step in (-1, 0, 1, 2))
    answers = {
        this: 1,
        gapbeam.__version__: 1,
        before: 0,
        after: 0,
        f"{this}.{int(patch) + 1}": 0,
        f"{this}...{later}": 1,
        f"{before}...{gapbeam.__version__}": 1,
        f"{before}...<{gapbeam.__version__}": 0,
        f"{before}...<{after}": 1,
        f"{before}...{before}.9": 0,
        f"{after}...{later}": 0,
    }
    lines = ["cmake_minimum_required(VERSION 3.19)", "project(user LANGUAGES NONE)"]
    for version in answers:
        lines += ["unset(gapbeam_DIR CACHE)", f"find_package(gapbeam {version} QUIET)"]
        lines += [f'message("{version}=${{gapbeam_FOUND}}")']
    (tmp_path / "CMakeLists.txt").write_text("\n".join(lines))
    done = installed.run("cmake", "-S", tmp_path, "-B", tmp_path / "build")
    found = dict(re.findall(r"^(\S+)=(\d)$", done.stderr, re.MULTILINE))
    assert found == {version: str(answer) for version, answer in answers.items()}


def test_uninstall_leaves_nothing(installed, tmp_path):
    """After another install, to a root of its own."""
    installed.run("meson", "install", "-C", installed.build, "--no-rebuild", f"--destdir={tmp_path}")
    there = tmp_path / installed.prefix.relative_to("/")
    assert list(there.rglob("gapbeam.mod"))
    installed.run("ninja", "-C", installed.build, "uninstall")
    assert not [file for file in tmp_path.rglob("*") if not file.is_dir()]
    assert (installed.prefix / "include" / "gapbeam.h").exists()
