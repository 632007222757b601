"""Settings of hypothesis (the same examples in every run; HYPOTHESIS_PROFILE=explore draws many new ones), and fixtures."""

import os
import subprocess
import sys

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
