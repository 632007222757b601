"""Settings of hypothesis (the same examples in every run; HYPOTHESIS_PROFILE=explore draws new ones), other seeds, fixtures."""

import gc
import os
import subprocess
import sys

os.environ["OPENBLAS_NUM_THREADS"] = "1"  # before numpy: threads for small matrices wait for each other, at full load

import pytest
from hypothesis import HealthCheck, settings
from languages.clibrary import Library
from languages.installation import LANGUAGES, install_once

CALM = [HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.filter_too_much]
settings.register_profile(
    "fixed", derandomize=True, deadline=None, max_examples=150, suppress_health_check=CALM
)
settings.register_profile("explore", deadline=None, max_examples=3000, suppress_health_check=CALM)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "fixed"))


gc.set_threshold(50_000)  # many digits and pictures are many small objects, next to none of them in a cycle


def pytest_collection_finish():
    """No more tests are made: what they are is not searched for garbage again and again."""
    gc.freeze()


def pytest_addoption(parser):
    """``--seeds FIRST:END`` gives tests of random scenes other seeds than those they are run with."""
    parser.addoption("--seeds", metavar="FIRST:END", help="seeds of tests that draw scenes, instead of their own")


@pytest.hookimpl(tryfirst=True)
def pytest_generate_tests(metafunc):
    """Give a test its seeds."""
    seeds = metafunc.config.getoption("--seeds")
    for k, mark in enumerate(metafunc.definition.own_markers if seeds else ()):
        if mark.name == "parametrize" and mark.args[0] == "seed":
            other = pytest.mark.parametrize("seed", range(*map(int, seeds.split(":"))))
            metafunc.definition.own_markers[k] = other.mark


@pytest.fixture(scope="session")
def installed(tmp_path_factory):
    """The library as `meson install` puts it in place."""
    return install_once(tmp_path_factory, "installed")


@pytest.fixture(scope="session")
def library(installed):
    """The installed library, loaded."""
    return Library(installed.library)


@pytest.fixture(scope="session")
def python_digits():
    """What the paper's beam in Python prints; the other languages print the same."""
    return subprocess.run(
        [sys.executable, LANGUAGES / "paper_beam.py"], capture_output=True, text=True, check=True
    ).stdout
