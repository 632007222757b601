"""Text of the user goes literally everywhere: no formulas, no colours, no sequences that a terminal obeys."""

import csv
import io
import json
import re
import subprocess
import sys
import warnings
import xml.etree.ElementTree as ElementTree
from html import unescape

import gapbeam
import pytest
from gapbeam.base.characters import visible
from gapbeam.base.errors import Status, check_status
from gapbeam.cli import main
from gapbeam.plots import figure, plot
from gapbeam.plots.path import path_figure, plot_path
from gapbeam.report import report_text, to_csv, to_json
from matplotlib import rc_context

# What a user writes, and how one line of text shows it
TEXTS = {
    "dollars": ("cost $5 to $7", None),
    "formula": (r"$\frac{1}{2}$ x_1^2", None),
    "broken formula": (r"$\foo{", None),
    "escaped dollar": (r"\$5", None),
    "markup": ("[red]danger[/red] [link=x]y", None),
    "emoji code": (":warning: **bold** <b>&amp;</b>", None),
    "percent": ("100 %s %(x)d {0} {x!r}", None),
    "quotes": ("a \"b\" 'c', d;\\n", None),
    "letters": ("Träger Ελληνικά", None),
    "escape": ("\x1b[31mred\x1b]0;title\x07", r"\x1b[31mred\x1b]0;title\x07"),
    "eight-bit escape": ("\x9b31m", r"\x9b31m"),
    "lines": ("one\ntwo\r\nthree\u2028four", r"one\ntwo\r\nthree\u2028four"),
    "nothing": ("a\0b\x7f", r"a\x00b\x7f"),
    "half a character": ("a\ud800b", r"a\ud800b"),
    "no character": ("a\uffffb", r"a\uffffb"),
    "no width": ("a\u200b\ufeffb", r"a\u200b\ufeffb"),
    "joined": ("\N{ARABIC LETTER MEEM}\u200c\N{ARABIC LETTER YEH}", None),
    "backwards": ("a\u202eb", r"a\u202eb"),
}


@pytest.fixture(params=TEXTS.values(), ids=TEXTS)
def text(request):
    return request.param[0], request.param[1] or request.param[0]


def scene(title, **analysis):
    return {
        "title": title,
        "units": {"force": title, "length": "m"},
        "beam": {"spans": [6.0, 6.0], "EI": 1.0e4},
        "supports": [{"node": 0}, {"node": 1, "side": "below", "gap": 0.01}, {"node": 2}],
        "loads": [{"type": "uniform", "q": 20.0}, {"type": "force", "x": 2.0, "F": 3.0}],
        "analysis": analysis,
    }


def test_visible(text):
    written, shown = text
    assert visible(written) == shown
    assert visible(shown) == shown
    shown.encode("utf-8")


def test_the_report(text):
    written, shown = text
    report = report_text(gapbeam.solve(scene(written)), width=200)
    assert report.splitlines()[0] == shown
    assert f"moment [{shown} m]" in report
    assert not re.search("[\0-\x09\x0b-\x1f\x7f-\x9f]", report)


def test_json_and_csv(text):
    written, shown = text
    result = gapbeam.solve(scene(written))
    data = json.loads(to_json(result))
    assert (data["title"], data["units"]["force"]) == (written, written)
    heading = next(csv.reader(io.StringIO(to_csv(result))))
    assert f"shear [{shown}]" in heading


def test_pictures(text, tmp_path):
    written, shown = text
    result = gapbeam.solve(scene(written, follow="events"))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for draw, name in ((plot, "a.svg"), (plot_path, "b.svg")):
            draw(result, tmp_path / name)
            ElementTree.parse(tmp_path / name)
            shown_texts = re.findall(r"<text[^>]*>([^<]*)</text>", (tmp_path / name).read_text(encoding="utf-8"))
            assert shown in map(unescape, shown_texts), name
            assert any(f"[{shown}" in unescape(label) for label in shown_texts)


def test_pictures_where_settings_ask_for_formulas(tmp_path):
    """A user's own settings of matplotlib."""
    result = gapbeam.solve(scene(TEXTS["broken formula"][0], follow="events"))
    with rc_context({"text.usetex": True, "text.parse_math": True}):
        plot(result, tmp_path / "a.pdf")
        plot_path(result, tmp_path / "b.png")
    for picture in (figure(result), path_figure(result)):
        picture.draw_without_rendering()


def test_the_command(text, tmp_path, capsys):
    written, shown = text
    path = tmp_path / "scene.json"
    path.write_text(json.dumps(scene(written) | {"units": {"length": written}}))
    assert main(["check", str(path)]) == 0
    assert capsys.readouterr().out == f"{path}: valid: 2 spans, 12 {shown}; 3 supports, 1 of them one-sided; 2 loads\n"
    assert main(["run", str(path)]) == 0
    assert capsys.readouterr().out.splitlines()[0] == shown[:80].rstrip()


def test_errors(text):
    written, _ = text
    with pytest.raises(gapbeam.SceneError) as caught:
        gapbeam.read_scene({"beam": {"spans": [1.0], "EI": 1.0}, "supports": [{"node": 0, "side": written}]})
    message = str(caught.value)
    assert message.startswith('supports[0].side: expected "above", "below", "both", "left" or "right", got "')
    assert visible(message) == message
    with pytest.raises(gapbeam.SceneError) as caught:
        gapbeam.read_scene({"beam": {"spans": [1.0], "EI": 1.0}, written: 1})
    assert visible(str(caught.value)) == str(caught.value)
    assert "unknown key" in str(caught.value)


def test_names_of_files(tmp_path, capsys):
    name = str(tmp_path / "\x1b[2J\udcff.toml")
    assert main(["check", name]) == 2
    assert capsys.readouterr().err == f"gapbeam: error: {tmp_path}/\\x1b[2J\\udcff.toml: there is no such file\n"
    assert main(["check", "a.toml", "\x1b[2J"]) == 2
    assert r"unrecognized arguments: \x1b[2J" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("name", "warned"), [("a.svg", ""), ("a.png", r"gapbeam: warning: Glyph 26753 \(.*\) missing from .*font.*\n")]
)
def test_characters_that_the_font_has_not(tmp_path, name, warned):
    path = tmp_path / "scene.json"
    path.write_text(json.dumps(scene("\N{CJK UNIFIED IDEOGRAPH-6881}")))
    words = [sys.executable, "-m", "gapbeam", "run", str(path), "--quiet", "--plot", str(tmp_path / name)]
    run = subprocess.run(words, capture_output=True, text=True)
    assert run.returncode == 0
    assert re.fullmatch(f"({warned})+" if warned else "", run.stderr)
    assert name == "a.png" or "\N{CJK UNIFIED IDEOGRAPH-6881}" in (tmp_path / name).read_text(encoding="utf-8")


def test_characters_that_standard_output_has_not(tmp_path):
    path = tmp_path / "scene.json"
    path.write_text(json.dumps(scene("Träger")))
    words = [sys.executable, "-X", "utf8=0", "-m", "gapbeam", "run", str(path)]
    run = subprocess.run(words, capture_output=True, env={"PYTHONIOENCODING": "ascii"})
    assert run.stdout.splitlines()[0] == b"Tr\\xe4ger"


@pytest.mark.parametrize("name", ["formula", "markup", "emoji code", "escape"])
def test_the_page_of_a_study(name, tmp_path, capsys):
    """Markdown has its own ideas of what a title means."""
    written, shown = TEXTS[name][0], TEXTS[name][1] or TEXTS[name][0]
    path = tmp_path / "scene.json"
    path.write_text(json.dumps(scene(written)))
    outputs = ["--csv", str(tmp_path / "a.csv"), "--plot", str(tmp_path / "a.svg"), "--markdown", str(tmp_path / "a.md")]
    assert main(["study", "accuracy", str(path), "--parts", "1", *outputs]) == 0
    capsys.readouterr()
    page = (tmp_path / "a.md").read_text(encoding="utf-8")
    heading = next(line for line in page.splitlines() if line.startswith("## "))[3:]
    assert re.sub(r"\\([\\`*_\[\]<>#|$~])", r"\1", heading).casefold() == shown.casefold()
    assert not re.search(r"(?<!\\)[`*_<>$|]", re.sub(r"\\\\", "", heading))
    assert list(csv.reader((tmp_path / "a.csv").open(encoding="utf-8")))[1][0] == shown
    ElementTree.parse(tmp_path / "a.svg")


@pytest.mark.parametrize("name", ["=cmd|' /C calc'!A0", "+1", "-2+3", "@SUM(A1)", "\tx", "\r=1", "\n=1"])
def test_no_cell_is_a_formula(name):
    """Spreadsheets work out what begins like one, whoever named the combination."""
    combinations = [{"name": name, "factors": {"live": 1.0}}, {"name": "plain", "factors": {"live": -1.0}}]
    made = {**scene("beam"), "combinations": combinations}
    rows = list(csv.reader(io.StringIO(to_csv(gapbeam.solve(made)))))
    cells = {cell for row in rows for cell in row}
    assert f"'{visible(name)}" in cells or (name == "\tx" and r"\tx" in cells)
    for cell in cells - {"plain", ""}:
        try:
            float(cell)  # numbers stay numbers, of whatever sign
        except ValueError:
            assert not cell.startswith(("=", "+", "-", "@", "\t", "\r", "\n")), cell
    assert any(cell.startswith("-") for cell in cells)


@pytest.mark.parametrize(
    ("engine", "ours"),
    [
        ("support 3 of 5: law: off its curve", "supports[2].law: off its curve"),
        ("support 3 of 5: stiffness = 4", "supports[2].stiffness = 4"),
        ("the law of support 1 of 5 is too far", "the law of supports[0] is too far"),
    ],
)
def test_the_engine_counts_supports_from_one(engine, ours):
    with pytest.raises(gapbeam.EngineError, match=f"^{re.escape(ours)}$"):
        check_status(Status.NOT_CONVERGED, engine.encode())
