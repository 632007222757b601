"""The recipes of docs/function.md, where the packages are installed, beside numbers found in another way."""

import socket
import subprocess
import sys
import time
from pathlib import Path
from runpy import run_path

import gapbeam
import numpy as np
import pytest

DOCS = Path(__file__).parents[2] / "docs"
RUNNER = run_path(str(DOCS / "pages.py"))


INPUTS = ["supports[3].gap", "supports[4].gap", "factors.dead"]
SCENE = str(DOCS.parent / "examples" / "pipe_rack.toml")


def block(package):
    """The recipe of a package."""
    blocks = [body for language, body in RUNNER["BLOCK"].findall((DOCS / "function.md").read_text()) if language == "python"]
    (there,) = [body for body in blocks if f"import {package}" in body or f"from {package}" in body]
    return there.replace('"examples/pipe_rack.toml"', repr(SCENE))


def run_block(package):
    """Run the recipe of a package, and give its names."""
    space, problems = {"gapbeam": gapbeam, "f": gapbeam.function(SCENE, INPUTS, ["reaction[4]"])}, []
    RUNNER["run_python"](block(package), space, problems)
    assert not problems
    return space


def test_openturns():
    pytest.importorskip("openturns")
    space = run_block("openturns")
    rng = np.random.default_rng(5)
    cases = 400_000
    spread = np.sqrt(np.log(1.0025))
    X = np.column_stack([
        rng.normal(0.01, 0.005, cases), rng.normal(0.0, 0.005, cases), np.exp(rng.normal(-0.5 * spread**2, spread, cases)),
    ])  # fmt: skip
    share = (space["f"](X)[:, 0] > 9.5).mean()
    # FORM is an approximation, near where the boundary is smooth; the share itself has a deviation of 8 %
    assert space["form"].getResult().getEventProbability() == pytest.approx(share, rel=0.4)
    point = np.array(space["form"].getResult().getPhysicalSpaceDesignPoint())
    assert space["f"](point) == pytest.approx(9.5, abs=1e-3)


def test_salib():
    pytest.importorskip("SALib")
    found = run_block("SALib")["indices"]
    assert 0.85 < found["S1"].sum() <= found["ST"].sum() + 1e-9 < 1.15


def test_umbridge(tmp_path):
    umbridge = pytest.importorskip("umbridge")
    with socket.socket() as free:
        free.bind(("localhost", 0))
        port = free.getsockname()[1]
    program = tmp_path / "server.py"
    made = f"import gapbeam\nf = gapbeam.function({SCENE!r}, {INPUTS}, ['reaction[4]'])\n"
    program.write_text(f"{made}{block('umbridge')}\numbridge.serve_models([model], {port})\n")
    with subprocess.Popen([sys.executable, program], stdout=subprocess.DEVNULL) as server:
        try:
            client = connected(umbridge, f"http://localhost:{port}", server)
            assert (client.get_input_sizes(), client.get_output_sizes()) == ([3], [1])
            x = [0.012, 0.001, 1.1]
            assert client([x])[0] == gapbeam.function(SCENE, INPUTS, ["reaction[4]"])(x).tolist()
        finally:
            server.terminate()


def connected(umbridge, address, server):
    """Wait for a server."""
    for _ in range(300):
        try:
            return umbridge.HTTPModel(address, "forward")
        except Exception:
            assert server.poll() is None
            time.sleep(0.1)
    raise TimeoutError(address)
