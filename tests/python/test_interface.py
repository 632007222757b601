"""What `import gapbeam` offers, which is imported when it is first asked for."""

import pickle
import subprocess
import sys

import gapbeam
import pytest


def fresh(code):
    """Run a line in an interpreter that has imported nothing yet."""
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)


NAMES = """
import os, gapbeam, msgspec, numpy  # what is not ours only once
for name in gapbeam.__all__:
    if os.fork() == 0:
        exec(f"gapbeam.{name}; from gapbeam import {name}")
        break
    assert os.wait()[1] == 0, name
"""


def test_names():
    """Each before all others, in a copy of an interpreter that has imported nothing of the package."""
    run = fresh(NAMES)
    assert (run.returncode, run.stderr) == (0, "")


def test_all_of_them_at_once():
    run = fresh("from gapbeam import *; import gapbeam; assert set(gapbeam.__all__) <= set(dir(gapbeam)) & set(globals())")
    assert (run.returncode, run.stderr) == (0, "")


@pytest.mark.parametrize("name", ["engine", "base", "results", "plots", "_engine", "cli"])
def test_modules(name):
    run = fresh(f"import gapbeam; gapbeam.{name}; import gapbeam.{name}; from gapbeam import {name}")
    assert (run.returncode, run.stderr) == (0, "")


def test_nothing_is_imported_before():
    code = "import sys, gapbeam, gapbeam.cli; sys.exit(bool({'numpy', 'msgspec', 'gapbeam._engine'} & set(sys.modules)))"
    assert fresh(code).returncode == 0


def test_other_names():
    with pytest.raises(AttributeError, match="gapbeam has no 'solv'; did you mean"):
        _ = gapbeam.solv
    with pytest.raises(ImportError, match="cannot import name 'solv'"):
        exec("from gapbeam import solv")


def test_objects_belong_to_their_modules():
    assert pickle.loads(pickle.dumps(gapbeam.Beam([1.0], EI=2.0))) == gapbeam.Beam([1.0], EI=2.0)
    assert gapbeam.solve.__module__ == "gapbeam.results.stepping"


def test_what_few_programs_use_is_imported_when_it_is_asked_for():
    there = fresh("import sys, gapbeam; gapbeam.solve; print(*sys.modules)").stdout.split()
    heavy = {"rich", "matplotlib", "jinja2", "pyarrow", "scipy", "concurrent.futures", "importlib.metadata", "gapbeam.batches.run"}
    assert "gapbeam.results.stepping" in there
    assert not heavy & set(there)
    assert "numpy" not in fresh("import sys, gapbeam; print(*sys.modules)").stdout.split()
