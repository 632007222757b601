"""The Python package and libgapbeam in one process: names that both have, such as gbsolv_, mean different things in them."""

import os
import re
import shutil
import subprocess
import sys
import sysconfig

import pytest
from gapbeam import _engine, _yardsticks

from .installation import LANGUAGES, TOP

# Python would not make the extension's symbols global; here they are to meet the library's.
IN_ONE_PROCESS = f"""
import ctypes, os, runpy, sys
sys.path.insert(0, {str(TOP / "tests")!r})
sys.setdlopenflags(os.RTLD_NOW | os.RTLD_GLOBAL)
library = sys.argv[2]
if sys.argv[1] == "first":
    ctypes.CDLL(library, ctypes.RTLD_GLOBAL)
import gapbeam, gapbeam._yardsticks
ctypes.CDLL(library, ctypes.RTLD_GLOBAL)
runpy.run_path({str(LANGUAGES / "paper_beam.py")!r}, run_name="__main__")
from languages.clibrary import F77Beam, Library
scene = {{"beam": {{"spans": [6.0, 6.0], "EI": 1e4}}, "supports": [{{"node": i, "side": "below"}} for i in range(3)],
          "loads": [{{"type": "uniform", "q": 5.0, "to": 6.0}}], "analysis": {{}}}}
beams = [Library(library).prepare(scene)[0], F77Beam(Library(library), scene)]
assert [beam.solve(1.0) for beam in beams] == [(0, ""), 0]
found = [gapbeam.solve(scene).steps[-1].reaction.tolist(), *(list(beam.at_supports()[0]) for beam in beams)]
assert found[0] == found[1] == found[2], found
"""


@pytest.mark.skipif(shutil.which("nm") is None, reason="no nm on this machine")
@pytest.mark.parametrize("extension", [_engine, _yardsticks])
def test_extensions_export_nothing_but_their_init(extension):
    command = ["nm", "-D", "--defined-only", extension.__file__]
    listing = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    name = extension.__name__.rpartition(".")[2]
    assert [line.split()[-1] for line in listing.splitlines()] == [f"PyInit_{name}"]


def test_library_calls_itself(installed):
    """No call within the library goes by a symbol that another one could have taken."""
    relocations = installed.run("readelf", "--relocs", "--wide", installed.library).stdout
    assert "dgbsvx_" in relocations
    assert not re.findall(r"JUMP_SLO.* (?:__gapbeam|gapbeam|gb)\S+", relocations)


@pytest.mark.parametrize("when", ["first", "last"])
def test_both_in_one_process(installed, python_digits, when):
    done = installed.run(sys.executable, "-c", IN_ONE_PROCESS, when, installed.library)
    assert done.stdout == python_digits


def test_program_that_links_one_and_embeds_the_other(installed, tmp_path, python_digits):
    version = "{}.{}".format(*sys.version_info)
    paths = [installed.environment["PKG_CONFIG_PATH"], sysconfig.get_config_var("LIBPC") or ""]
    embedding = f"python-{version}-embed"
    environment = {
        "PKG_CONFIG_PATH": os.pathsep.join(paths),
        "LD_LIBRARY_PATH": f"{installed.library.parent}:{sysconfig.get_config_var('LIBDIR')}",
        "PYTHONPATH": sysconfig.get_path("platlib"),
    }
    if subprocess.run(["pkg-config", "--exists", embedding], env=installed.environment | environment).returncode:
        pytest.skip(f"pkg-config does not know {embedding} on this machine")
    flags = installed.run("pkg-config", "--cflags", "--libs", "gapbeam", embedding, env=environment).stdout.split()
    program = tmp_path / "embedding"
    installed.run("cc", "-std=c11", f"-I{LANGUAGES}", TOP / "tests" / "languages" / "embedding.c", "-o", program, *flags)
    done = installed.run(program, LANGUAGES / "paper_beam.py", env=environment)
    assert done.stdout == 3 * python_digits
