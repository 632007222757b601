"""The house as docs/house.md draws it: a folder uses only folders above it, in both languages."""

import ast
import re
from pathlib import Path
from runpy import run_path

import gapbeam
import pytest

TOP = Path(__file__).resolve().parents[2]
HOUSE = run_path(str(TOP / "docs" / "house.py"))
FORTRAN = tuple(name for name in HOUSE["FORTRAN"] if name != "yardsticks")
SUFFIX = re.compile(r"_(quad|own|(own_)?v\d)$")
"""Of modules that are made of the same sources."""
ROOMS = tuple(name.removeprefix("results/") for name in HOUSE["PYTHON"] if name.startswith("results/"))
"""Of `results`."""
PYTHON = tuple(name for name in HOUSE["PYTHON"] if "/" not in name)


def fortran_sources():
    """Every module's file by its name."""
    return {f"gapbeam_{path.stem}": path for folder in FORTRAN for path in (TOP / "fortran" / folder).glob("*.[fF]90")}


def test_fortran_folders_use_only_those_above():
    sources = fortran_sources()
    wrong = []
    for path in sources.values():
        for name in re.findall(r"^ *use +(gapbeam_\w+)", path.read_text(), re.MULTILINE):
            if name == "gapbeam_version":
                continue
            used = sources[name if name in sources else SUFFIX.sub("", name)]
            if FORTRAN.index(used.parent.name) > FORTRAN.index(path.parent.name):
                wrong.append(f"{path.parent.name}/{path.name} uses {used.parent.name}/{used.name}")
    assert wrong == []


def test_fortran_modules_use_no_other_in_a_circle():
    sources = fortran_sources()
    uses = {
        name: {SUFFIX.sub("", used) for used in re.findall(r"^ *use +(gapbeam_\w+)", path.read_text(), re.MULTILINE)}
        for name, path in sources.items()
    }
    left = {name.removesuffix("_quad") for name in uses}
    while left:
        free = {name for name in left if not (uses.get(name, set()) & left) - {name}}
        assert free, f"these use each other: {sorted(left)}"
        left -= free


def test_sources_that_include_are_compiled_anew_with_what_they_include():
    """Meson follows no include: fortran/meson.build has both in lists."""
    build = (TOP / "fortran" / "meson.build").read_text()
    included, including = (set(re.findall(r"'(\S+)'", re.search(rf"^{name} = [\[f].*?^[\])]", build, re.M | re.S)[0]))
                           for name in ("included", "including"))  # fmt: skip
    texts = {path: re.findall(r"^ *include '(\S+)'", path.read_text(), re.M) for path in (TOP / "fortran").rglob("*.[fi]*")}
    assert included == {name for names in texts.values() for name in names}
    assert included == {path.relative_to(TOP / "fortran").as_posix() for path in texts if path.suffix == ".inc"}
    users = [path.relative_to(TOP / "fortran") for path, used in texts.items() if used and path.suffix == ".f90"]
    assert including == {path.with_suffix("").as_posix() for path in users}


def imports(path):
    """Folders of the package that a module imports from."""
    depth = len(path.relative_to(TOP / "python" / "gapbeam").parts)
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.ImportFrom) and node.level == depth:
            yield from [node.module.split(".")[0]] if node.module else [name.name for name in node.names]


def test_python_folders_use_only_those_above():
    wrong = []
    for folder in PYTHON:
        for path in (TOP / "python" / "gapbeam" / folder).rglob("*.py"):
            for used in imports(path):
                if used not in ("_engine", "_yardsticks") and PYTHON.index(used) > PYTHON.index(folder):
                    wrong.append(f"{folder}/{path.name} imports from {used}")
    assert wrong == []


def modules_of(path, package=TOP / "python" / "gapbeam"):
    """Files of the package that a file imports by a relative name at run time, at its top or inside a function."""
    tree = ast.parse(path.read_text())
    for_types = {id(node) for one in ast.walk(tree) if isinstance(one, ast.If) and ast.unparse(one.test) == "TYPE_CHECKING"
                 for node in ast.walk(one)}  # fmt: skip
    for node in ast.walk(tree):
        if not isinstance(node, ast.ImportFrom) or not node.level or id(node) in for_types:
            continue
        folder = path.parents[node.level - 1].joinpath(*(node.module or "").split("."))
        for found in (folder.with_suffix(".py"), *(folder / f"{name.name}.py" for name in node.names)):
            if found.exists() and found.is_relative_to(package):
                yield found, node in tree.body


def test_every_file_of_python_is_installed():
    build = (TOP / "python" / "meson.build").read_text()
    folders = re.findall(r"^  '(gapbeam[\w/]*)': \[(.*?)\]", build, re.M | re.S)
    listed = sorted(f"{folder}/{name}" for folder, names in folders for name in re.findall(r"'(\S+)'", names))
    package = TOP / "python" / "gapbeam"
    there = [path for path in package.rglob("*") if path.is_file() and path.parent.name != "__pycache__"]
    assert listed == sorted(path.relative_to(TOP / "python").as_posix() for path in there)


def test_no_installed_file_of_python_is_long():
    long = [path.name for path in (TOP / "python" / "gapbeam").rglob("*.py") if path.read_text().count("\n") > 400]
    assert long == []


def test_python_files_import_each_other_in_no_circle():
    uses = {path: {used for used, _ in modules_of(path)} for path in (TOP / "python" / "gapbeam").rglob("*.py")}
    left = set(uses)
    while left:
        free = {path for path in left if not uses[path] & left}
        assert free, f"these import each other: {sorted(str(path) for path in left)}"
        left -= free


def test_rooms_of_the_results_use_only_those_before():
    results = TOP / "python" / "gapbeam" / "results"
    assert {path.parent.name for path in results.glob("*/__init__.py")} == set(ROOMS)
    for path in results.glob("*/*.py"):
        for used, _ in modules_of(path):
            if used.parent.parent == results:
                assert ROOMS.index(used.parent.name) <= ROOMS.index(path.parent.name), f"{path} imports {used}"


def test_imports_inside_functions_are_of_what_a_command_may_not_need():
    """The command loads what it needs when it needs it; elsewhere only files that load rich, pyarrow or matplotlib come late."""
    late = {
        path.relative_to(TOP / "python" / "gapbeam").as_posix()
        for path in (TOP / "python" / "gapbeam").rglob("*.py")
        if any(not at_top for _, at_top in modules_of(path))
    }
    elsewhere = {path for path in late if not path.startswith(("cli/", "studies/"))}
    assert elsewhere == {"batches/sample.py", "batches/tables.py", "show/display.py"}


@pytest.mark.parametrize("language", ["fortran", "python/gapbeam"])
def test_there_are_no_other_folders(language):
    folders = {path.name for path in (TOP / language).iterdir() if path.is_dir()} - {"__pycache__"}
    assert folders == (set(FORTRAN) | {"build", "modules", "yardsticks"} if language == "fortran" else set(PYTHON))


def test_the_map_is_made_of_the_files():
    page = (TOP / "docs" / "house.md").read_text()
    assert page == HOUSE["made"](), "run python docs/house.py"
    assert len(page.splitlines()) <= 150
    assert max(map(len, page.splitlines())) <= 120


def test_heads_say_what_a_file_does():
    heads = {path: HOUSE["head_of"](path) for room in HOUSE["ROOMS"] for path in HOUSE["files_of"](room) if path.suffix != ".c"}
    assert not [str(path) for path, head in heads.items() if not head or head.endswith("?") or head.split()[0] == "What"]


def modules_named(path):
    """Modules that a file imports by their whole names, at its top or inside a function."""
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            yield from (name.name for name in node.names)
        elif isinstance(node, ast.ImportFrom) and not node.level:
            yield from (node.module, *(f"{node.module}.{name.name}" for name in node.names))


def test_the_package_needs_nothing_of_the_tests():
    tests = {path.stem for path in (TOP / "tests").iterdir() if path.suffix == ".py" or (path / "__init__.py").exists()}
    for path in (TOP / "python").rglob("*.py"):
        assert not {name.split(".")[0] for name in modules_named(path)} & {*tests, "tests"}, path


def test_all_tests_are_in_rooms():
    here = {path.name for path in (TOP / "tests").iterdir() if path.is_file()}
    assert here == {"checked.ini", "conftest.py", "lowest", "meson.build", "run", "wheel"}
    house = (TOP / "docs" / "house.md").read_text().partition("Tests are in rooms")[2]
    for path in (TOP / "tests").iterdir():
        assert path.is_file() or path.name == "__pycache__" or f"`{path.name}`" in house, path
    package = {path.relative_to(TOP / "python" / "gapbeam") for path in (TOP / "python" / "gapbeam").rglob("*") if path.is_dir()}
    for path in (TOP / "tests" / "python").rglob("test_*.py"):
        assert path.parent.relative_to(TOP / "tests" / "python") in {*package, Path()}, path
    for path in (TOP / "tests" / "unit").rglob("test_*.f90"):
        assert path.parent.name in FORTRAN, path


def test_the_oracle_imports_nothing_of_gapbeam():
    """Nor do the scenes that it reads, nor anything else that comes with it."""
    tests, seen = TOP / "tests", set()
    left = set((tests / "oracle").rglob("*.py"))
    while left:
        path = left.pop()
        seen.add(path)
        for name in modules_named(path):
            assert name.partition(".")[0] not in ("gapbeam", "python", "attack", "studies", "digests", "languages"), path
            used = tests.joinpath(*name.split("."))
            left |= {found for found in (used.with_suffix(".py"), used / "__init__.py") if found.exists()} - seen
        relative = {found for found, _ in modules_of(path, tests)}
        left |= relative - seen
    assert {path.parent.name for path in seen} == {"oracle", "checkers", "scenes"}


def test_dir_shows_what_users_use():
    assert gapbeam.solve
    assert dir(gapbeam) == sorted(gapbeam.__all__)


THRESHOLDS = ("tolerances", "path_tolerances", "limits")
"""Files of `fortran/base` in which every threshold and every limit of a count stands."""


def test_thresholds_say_who_reads_them():
    readers = {}
    for folder in FORTRAN:
        for path in (TOP / "fortran" / folder).glob("*.[fF]90"):
            if path.stem.startswith("python"):
                continue  # what Python reads is named by who reads it there
            text = re.sub(r"&\n\s*", "", path.read_text())
            for module, names in re.findall(rf"use gapbeam_({'|'.join(THRESHOLDS)}), only: (.*)", text):
                for name in names.split(","):
                    readers.setdefault((module, name.split("=>")[-1].strip()), set()).add(f"{folder}/{path.stem}")
    told = {}
    for module in THRESHOLDS:
        text = (TOP / "fortran" / "base" / f"{module}.f90").read_text()
        for comment, name in re.findall(r"((?:^ *!> .*\n)+) +\S.*parameter :: (\w+) =", text, re.MULTILINE):
            words = " ".join(re.findall(r"!> (.*)", comment)).partition(" Read by ")[2]
            told[module, name] = set(re.findall(r"[a-z_]+/\w+", words))
        public = " ".join(re.findall(r"public :: (.*)", text)).replace(",", " ").split()
        assert {(module, name) for name in public} == {one for one in told if one[0] == module}
    assert told == readers
