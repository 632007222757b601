"""The README shows what the program does: its scene, its report and its picture; it is short (its blocks and links: test_pages)."""

import re
import tomllib
from pathlib import Path

from gapbeam.cli import main
from gapbeam.plots import plot

TOP = Path(__file__).resolve().parents[2]
README = (TOP / "README.md").read_text(encoding="utf-8")
SCENE = TOP / "examples" / "three_spans.toml"


def block(language):
    return re.search(rf"```{language}\n(.*?)```", README, re.DOTALL)[1]


def test_scene_is_the_example():
    assert tomllib.loads(block("toml")) == tomllib.loads(SCENE.read_text(encoding="utf-8"))


def test_report_is_what_is_printed(capsys):
    assert main(["run", str(SCENE)]) == 0
    printed = "\n".join(line.rstrip() for line in capsys.readouterr().out.splitlines())
    assert block("text").strip() in printed


def test_picture_is_what_is_drawn(tmp_path):
    """Compare the texts in the picture; the rest depends on the version of matplotlib."""
    names = {}
    lines = [line[4:] for line in block("python").splitlines() if line.startswith((">>> ", "... "))]
    exec("\n".join(lines), names)
    plot(names["result"], tmp_path / "new.svg")
    texts = [
        re.findall(r"<text[^>]*>([^<]+)</text>", path.read_text(encoding="utf-8"))
        for path in (TOP / "docs" / "readme.svg", tmp_path / "new.svg")
    ]
    assert len(texts[0]) > 20
    assert texts[0] == texts[1]


def test_a_screen_or_two():
    assert len(README.splitlines()) <= 120
