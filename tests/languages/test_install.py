"""The installed library: what is there, what it exports, programs in four languages built with pkg-config alone, and that all
spellings of names and codes agree."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import gapbeam
import pytest

from .clibrary import Library
from .installation import LANGUAGES, TOP

PROGRAMS = ("paper_beam.c", "paper_beam.f90", "paper_beam.f")


@pytest.fixture(scope="session")
def header(installed):
    return (installed.prefix / "include" / "gapbeam.h").read_text()


def constants(header):
    """Enumerators of the header."""
    return {name: int(value) for name, value in re.findall(r"\b(GAPBEAM_\w+) = (-?\d+)", header)}


def functions(header):
    """Functions the header declares."""
    text = re.sub(r"/\*.*?\*/", "", header, flags=re.DOTALL)
    return set(re.findall(r"\b(gapbeam_\w+)\(", text))


def test_everything_is_there(installed):
    lib, include = installed.prefix / "lib", installed.prefix / "include"
    version = gapbeam.__version__
    major, minor, _ = version.split(".")
    for name in ("libgapbeam.a", "libgapbeam.so", f"libgapbeam.so.{major}.{minor}", f"libgapbeam.so.{version}"):
        assert (lib / name).exists()
    dynamic = installed.run("readelf", "-d", installed.library).stdout
    assert f"soname: [libgapbeam.so.{major}.{minor}]" in dynamic
    assert "RUNPATH" not in dynamic or "scipy" in dynamic
    assert (include / "gapbeam.h").exists()
    modules = installed.pkg_config("--cflags")[-1].removeprefix("-I")
    assert (installed.prefix / modules / "gapbeam.mod").exists()
    assert installed.pkg_config("--modversion") == [version]
    assert installed.pkg_config("--libs")[-1] == "-lgapbeam"


def test_only_the_public_symbols_are_exported(installed, header):
    symbols = {
        line.split()[-1].partition("@")[0]
        for line in installed.run("nm", "-D", "--defined-only", installed.library).stdout.splitlines()
        if " A " not in line
    }
    c = {name for name in symbols if name.startswith("gapbeam_")}
    assert c == functions(header)
    facade = "".join(path.read_text() for path in (TOP / "fortran" / "face").glob("fortran77*.f90"))
    f77 = {f"{name}_" for name in re.findall(r"^(?:subroutine|function) (\w+)\(", facade, re.MULTILINE)}
    assert {name for name in symbols if name.startswith(("gb", "gh"))} == f77
    fortran = {name.rpartition("_MOD_")[2] for name in symbols - c - f77}
    umbrella = (TOP / "fortran" / "face" / "gapbeam.f90").read_text()
    taken = re.findall(r"\b[a-z]\w*", " ".join(re.findall(r"^    use .*?only:((?:.*&\n)*.*)", umbrella, re.MULTILINE)))
    procedures = {name for name in taken if not (name.startswith(("gapbeam_", "rule_")) or name.endswith("_type"))}
    assert fortran == procedures


def test_nothing_is_kept_between_calls(installed):
    """No writable storage but constants: threads have nothing to share."""
    listing = installed.run("nm", installed.prefix / "lib" / "libgapbeam.a").stdout
    writable = set(re.findall(r" [bBdDcC] (\S+)", listing))
    kept = {name for name in writable if not re.search(r"___(vtab|def_init)_", name)}
    assert kept <= {f"__gapbeam_capi_library_MOD_{name}" for name in ("texts", "no_text", "version", "i_text")}


@pytest.mark.parametrize("name", PROGRAMS)
def test_same_digits_in_every_language(installed, tmp_path, python_digits, name):
    program = installed.compile(LANGUAGES / name, tmp_path / "paper_beam")
    assert installed.run(program).stdout == python_digits
    assert len(python_digits.splitlines()) == 12


@pytest.mark.parametrize("name", ["test_capi.c", "test_capi_modes.c", "test_f77.f", "test_threads.c", "test_memory.c"])
def test_interfaces_as_installed(installed, tmp_path, name):
    """The tests of the interfaces once more, with the shared library; failures within it print nothing."""
    program = installed.compile(Path(__file__).with_name(name), tmp_path / "program", "-pthread", "-lm")
    done = installed.run(program)
    assert all(line.startswith(("ok ", "1..")) for line in done.stdout.splitlines())
    assert not done.stderr


def test_headers_are_cpp_and_c99(installed, tmp_path):
    source = tmp_path / "empty.c"
    source.write_text('#include "gapbeam.h"\nint main(void) { return gapbeam_count_nodes(NULL); }\n')
    flags = installed.pkg_config("--cflags", "--libs")
    for language in (["-std=c99", "-pedantic-errors"], ["-x", "c++", "-Wpedantic"]):
        if "c++" in language and shutil.which("g++") is None:
            continue
        installed.run("cc", *language, "-Wall", "-Wextra", "-Werror", source, *flags, "-o", tmp_path / "empty")
        installed.run(tmp_path / "empty")


def test_found_by_meson(installed, tmp_path, python_digits):
    (tmp_path / "meson.build").write_text(
        "project('user', 'c', 'fortran')\n"
        "dep = dependency('gapbeam', version: '>=0.3')\n"
        f"executable('in_c', '{LANGUAGES / 'paper_beam.c'}', dependencies: dep)\n"
        f"executable('in_fortran', '{LANGUAGES / 'paper_beam.f90'}', dependencies: dep)\n"
    )
    installed.run("meson", "setup", tmp_path / "build", tmp_path)
    installed.run("ninja", "-C", tmp_path / "build")
    for name in ("in_c", "in_fortran"):
        assert installed.run(tmp_path / "build" / name).stdout == python_digits


@pytest.mark.skipif(shutil.which("cmake") is None, reason="no CMake on this machine")
def test_found_by_cmake(installed, tmp_path, python_digits):
    (tmp_path / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.18)\n"
        "project(user LANGUAGES C Fortran)\n"
        "find_package(gapbeam 0.4 REQUIRED)\n"
        f"add_executable(in_c {LANGUAGES / 'paper_beam.c'})\n"
        f"add_executable(in_fortran {LANGUAGES / 'paper_beam.f90'})\n"
        "foreach(name in_c in_fortran)\n  target_link_libraries(${name} gapbeam::gapbeam)\nendforeach()\n"
    )
    installed.run("cmake", "-S", tmp_path, "-B", tmp_path / "build")
    installed.run("cmake", "--build", tmp_path / "build")
    for name in ("in_c", "in_fortran"):
        assert installed.run(tmp_path / "build" / name).stdout == python_digits


def test_all_spellings_of_the_codes_agree(installed, header, tmp_path):
    """Header, Fortran module, Fortran 77, Python and the page about the languages."""
    values = constants(header)
    fortran = {name: value for name, value in values.items() if name not in fields_of(header)}
    assert len(fortran) == 87
    listing = ["program codes", "    use gapbeam", "    implicit none"]
    for name in fortran:
        listing.append(f'    print "(a, 1x, i0)", "{name}", {name.lower()}')
    statuses = [value for value in fortran.values() if value == 0 or value > 10]
    listing += [
        f'    print "(a)", "text {value} " // trim(gapbeam_status_message({value}))' for value in sorted({1, 2, *statuses})
    ]
    listing += ['    print "(2a)", "version ", gapbeam_version_string', "end program codes", ""]
    source = tmp_path / "codes.f90"
    source.write_text("\n".join(listing))
    out = installed.run(installed.compile(source, tmp_path / "codes")).stdout.splitlines()
    assert out[: len(fortran)] == [f"{name} {value}" for name, value in fortran.items()]
    library = Library(installed.library)
    for line in out[len(fortran) : -1]:
        _, code, text = line.split(" ", 2)
        assert library.c.gapbeam_status_message(int(code)).decode() == text
    enumerators = {name: values[f"GAPBEAM_{name}"] for name in gapbeam.Status.__members__}
    assert {name: int(status) for name, status in gapbeam.Status.__members__.items()} == enumerators
    in_header = re.search(r"enum gapbeam_status \{(.*?)\};", header, re.DOTALL)[1]
    assert set(constants(in_header)) == {f"GAPBEAM_{name}" for name in enumerators}
    page = (TOP / "docs" / "languages.md").read_text()
    rows = dict(re.findall(r"^\| (\d+) \| `GAPBEAM_(\w+)` \|", page, re.MULTILINE))
    assert {name: int(code) for code, name in rows.items()} == enumerators
    versions = {out[-1].split()[1], library.c.gapbeam_version_text().decode(), gapbeam.__version__}
    assert versions == {re.search(r'define GAPBEAM_VERSION "(.*)"', header)[1]}


def fields_of(header):
    """Columns of C arrays, which Fortran counts from 1."""
    enums = re.findall(r"enum gapbeam_(?:field|quantity) \{(.*?)\};", header, re.DOTALL)
    return {name for enum in enums for name in constants(enum)}


def test_page_names_every_routine(header):
    """The map across the languages is complete."""
    page = (TOP / "docs" / "languages.md").read_text()
    facade = "".join(path.read_text() for path in (TOP / "fortran" / "face").glob("fortran77*.f90"))
    f77 = {name.upper() for name in re.findall(r"^(?:subroutine|function) (\w+)\(", facade, re.MULTILINE)}
    api = "".join((TOP / "fortran" / "face" / name).read_text() for name in ("api.f90", "api_history.f90"))
    public = set(re.findall(r"^    (?:pure )?(?:subroutine|function) (\w+)\(", api, re.MULTILINE))
    public &= set(re.findall(r"\w+", (TOP / "fortran" / "face" / "gapbeam.f90").read_text()))
    for name in functions(header) | f77 | public:
        assert f"`{name}`" in page, name


@pytest.mark.skipif(shutil.which("mkoctfile") is None, reason="no Octave on this machine")
def test_same_digits_in_octave(installed, tmp_path, python_digits):
    for name in ("gapbeam_mex.c", "paper_beam.m"):
        shutil.copy(LANGUAGES / name, tmp_path)
    installed.run("mkoctfile", "--mex", "gapbeam_mex.c", *installed.pkg_config("--cflags", "--libs"), cwd=tmp_path)
    out = installed.run("octave-cli", "--norc", "paper_beam.m", cwd=tmp_path).stdout
    assert out.splitlines() == python_digits.splitlines()[:8]


@pytest.mark.skipif(shutil.which("valgrind") is None, reason="no valgrind on this machine")
@pytest.mark.parametrize("name", PROGRAMS)
def test_valgrind_finds_nothing(installed, tmp_path, python_digits, name):
    program = installed.compile(LANGUAGES / name, tmp_path / "paper_beam", "-g")
    done = installed.run("valgrind", "--quiet", "--leak-check=full", "--error-exitcode=9", program)
    assert done.stdout == python_digits
    assert not done.stderr


@pytest.mark.skipif(shutil.which("valgrind") is None, reason="no valgrind on this machine")
def test_valgrind_finds_nothing_in_the_extension(tmp_path, python_digits):
    """Python and numpy are full of what valgrind minds; nothing of it may come by way of the extension."""
    log = tmp_path / "log"
    done = subprocess.run(
        ["valgrind", "--leak-check=no", f"--log-file={log}", sys.executable, LANGUAGES / "paper_beam.py"],
        env=os.environ | {"PYTHONMALLOC": "malloc"}, capture_output=True, text=True,
    )  # fmt: skip
    assert done.stdout == python_digits
    assert "f90" not in log.read_text()
    assert "_engine" not in log.read_text()


@pytest.mark.skipif(shutil.which("valgrind") is None, reason="no valgrind on this machine")
def test_helgrind_finds_nothing(installed, tmp_path):
    program = installed.compile(Path(__file__).with_name("test_threads.c"), tmp_path / "test_threads", "-g", "-pthread")
    done = installed.run("valgrind", "--tool=helgrind", "--quiet", "--error-exitcode=9", program, "1")
    assert "not ok" not in done.stdout
