"""The boundary to Fortran: no silent single precision, the same digits from many threads, the version in one place."""

import re
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import gapbeam
import numpy as np
import pytest
from gapbeam import _engine
from gapbeam.studies.meshes import gapped_spans
from studies.schemes import lifted_end

ROUTINES = [name for name in dir(_engine) if name.startswith("gb")]


@pytest.mark.parametrize("name", ROUTINES)
def test_no_single_precision(name):
    """f2py takes a kind that it does not know for C float, and says so only on stderr."""
    text = getattr(_engine, name).__doc__
    assert "array('f')" not in text
    without = ("gbdrop", "gbhaxi", "gbhend", "gbreco", "gbrway", "gbshar", "gbsize", "gbroom", "gbstop")
    assert " : float" in text or "array('d')" in text or name in without


def test_all_routines_are_there():
    names = (
        "gbmake gbcopy gbdrop gbsize gbnumb gbplac gbsolv gbpath gbhist gbhget gbhsch gbhaxi gbalng gbhend gbhten gbhlin gbheng "
        "gblaws gbsget gbcert gbreco gbfind gbvalu gbextr gblarg "
        "gbshar gbroom gbcase gbone gbgget gbgrun gbgpth gbgpte gbcomb gbcext gbccrt "
        "gbtmak gbtget gbtenv gbtcur gbtinf gbtprt gbrmak gbrget gbrext gbrcur gbrway gbstop gbtole gblawv gblawp gbslop gbyiel"
        " gbleas gbpart gbbuck gbmode gbshap"
    )
    assert set(ROUTINES) == set(names.split())


def test_threads_give_the_same_digits():
    scenes = [gapped_spans(50 + i) for i in range(6)] + [lifted_end(60 + 20 * i) for i in range(6)]
    alone = [gapbeam.solve(scene).steps[-1] for scene in scenes]
    with ThreadPoolExecutor(4) as pool:
        together = list(pool.map(lambda scene: gapbeam.solve(scene).steps[-1], scenes * 4))
    for step, true in zip(together, alone * 4, strict=True):
        assert np.array_equal(step.reaction, true.reaction)
        assert np.array_equal(step.deflection, true.deflection)
        assert step.solves == true.solves


def test_version_stands_in_one_place():
    meson = (Path(__file__).resolve().parents[3] / "meson.build").read_text(encoding="utf-8")
    assert re.search(r"version: '([^']+)'", meson)[1] == gapbeam.__version__


def test_a_million_sections_make_two_nodes():
    """Section changes inside one span are condensed exactly: the digits of the same beam without them."""
    count = 200_000
    ends = np.arange(count + 1) * 2.0**-14
    sections = [{"from": a, "to": b, "EI": 7.0} for a, b in zip(ends[:-1].tolist(), ends[1:].tolist(), strict=True)]
    scene = {
        "beam": {"spans": [float(ends[-1])], "EI": 3.0},
        "supports": [{"node": 0, "rotation": "fixed"}, {"node": 1}],
        "loads": [{"type": "uniform", "q": 2.0}],
    }
    cut = gapbeam.solve({**scene, "sections": sections})
    whole = gapbeam.solve({**scene, "sections": [{"EI": 7.0}]})
    assert cut.system.nodes == 2
    assert cut.steps[-1].reaction == pytest.approx(whole.steps[-1].reaction, rel=4e-16)
    x = np.linspace(0.0, float(ends[-1]), 7)
    right = whole.at(x).deflection
    assert cut.at(x).deflection == pytest.approx(right, abs=1e-14 * np.abs(right).max())
