"""Cases side by side at every level of instructions, as optimized for the package: the same bits as one by one."""

import shutil
import subprocess

import pytest

from .installation import TOP

BUILD = TOP / ".venv" / "build" / "package"
UNIT = TOP / "tests" / "unit"
SOURCES = (UNIT / "testing.f90", UNIT / "lane_beams.f90", UNIT / "cases" / "lane_widths.f90")


@pytest.mark.skipif(not BUILD.exists() or not shutil.which("gfortran"), reason="tests/run did not build the package here")
def test_every_level_of_instructions_as_optimized(tmp_path):
    folders = [f"-I{folder}" for folder in (BUILD / "fortran").glob("*.p")]
    lapack = ["-llapack"]
    if any(BUILD.glob("libscipy_openblas*")):
        lapack = [f"-L{BUILD}", f"-Wl,-rpath,{BUILD}", "-lscipy_openblas"]
    libraries = [BUILD / "fortran" / "libgapbeam_engine.a", *lapack, "-lquadmath", "-pthread"]
    program = tmp_path / "lane_widths"
    command = ["gfortran", "-std=f2018", f"-J{tmp_path}", *folders, *SOURCES, "-o", program, *libraries]
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    done = subprocess.run([program, "200"], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout
    assert "not ok" not in done.stdout
    assert "ok" in done.stdout
