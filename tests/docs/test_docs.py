"""The page on laws shows what the program prints, and pages show the pictures that it draws (blocks and links: test_pages)."""

import re
import tomllib
from pathlib import Path

import gapbeam
import pytest
from gapbeam.cli import main
from gapbeam.plots import plot, plot_path

TOP = Path(__file__).resolve().parents[2]
PATHS = ["snap_through", "rubber_stops", "pile_head", "shaft_jack_up"]
BEAMS = ["rail_lift_off", "strip_footing", "slab_on_mound", "seabed_pipe", "pipe_on_rock", "laterally_loaded_pile",
         "pipe_rack_states", "crane_runway_bays", "bridge_bearings", "rail_bogie_passes",
         "tensioned_pipe_span", "column_stop"]  # fmt: skip


def page(name):
    return (TOP / "docs" / f"{name}.md").read_text(encoding="utf-8")


def test_scene_and_report_of_the_worked_example(capsys):
    scene = TOP / "examples" / "snap_through.toml"
    blocks = re.findall(r"```toml\n(.*?)```", page("laws"), re.DOTALL)
    assert tomllib.loads(blocks[0]) == tomllib.loads(scene.read_text(encoding="utf-8"))
    assert main(["run", str(scene)]) == 0
    printed = "\n".join(line.rstrip() for line in capsys.readouterr().out.splitlines())
    shown = re.findall(r"```text\n(.*?)```", page("laws"), re.DOTALL)
    assert len(shown) == 2
    assert all(block.strip() in printed for block in shown)


def test_the_scene_on_ground_is_solved():
    scene = re.search(r"```toml\n(.*?)```", page("foundation"), re.DOTALL)[1]
    contact = gapbeam.solve(tomllib.loads(scene)).steps[-1].contact
    assert f"(0, 0.0, {contact[0].to:.3f}, {contact[0].resultant:.2f})" in page("foundation")


@pytest.mark.parametrize(("name", "draw"), [*((name, plot_path) for name in PATHS), *((name, plot) for name in BEAMS)])
def test_pictures_are_what_is_drawn(name, draw, tmp_path):
    """Compare the texts in the picture; the rest depends on the version of matplotlib."""
    draw(gapbeam.solve(TOP / "examples" / f"{name}.toml"), tmp_path / "new.svg")
    texts = [
        re.findall(r"<text[^>]*>([^<]+)</text>", path.read_text(encoding="utf-8"))
        for path in (TOP / "docs" / f"{name}.svg", tmp_path / "new.svg")
    ]
    assert len(texts[0]) > 15
    assert texts[0] == texts[1]


def test_the_citation_has_the_version():
    cited = (TOP / "CITATION.cff").read_text(encoding="utf-8")
    assert f"\nversion: {gapbeam.__version__}\n" in cited
    assert f"(version {gapbeam.__version__})" in page("cite")


def test_the_picture_of_hysteresis_is_what_is_drawn(tmp_path):
    pile = gapbeam.solve(TOP / "examples" / "pile_head.toml")
    pile.plot("hysteresis", support=2, path=tmp_path / "new.svg")
    texts = [
        re.findall(r"<text[^>]*>([^<]+)</text>", path.read_text(encoding="utf-8"))
        for path in (TOP / "docs" / "pile_head_hysteresis.svg", tmp_path / "new.svg")
    ]
    assert texts[0] == texts[1]
    assert any("energy 1.403 kN m" in text for text in texts[0])
