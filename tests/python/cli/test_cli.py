"""The command: exit statuses, messages, what is written and what is not."""

import io
import json
import os
import subprocess
import sys
import zipfile

import gapbeam
import pytest
from gapbeam.cli import main

SCENE = """
title = "Two spans"
[units]
force = "kN"
length = "m"
[beam]
spans = [6.0, 6.0]
EI = 1.0e4
[[supports]]
node = 0
[[supports]]
node = 1
side = "below"
gap = 0.01
[[supports]]
node = 2
[[loads]]
type = "uniform"
q = 20.0
[analysis]
steps = 4
"""

# A plank on two trestles with its end overloaded: it tips about the second one.
TIPPING = """
[beam]
spans = [2.0, 4.0, 2.0]
EI = 100.0
[[supports]]
node = 1
side = "below"
[[supports]]
node = 2
side = "below"
[[loads]]
type = "force"
node = 3
F = 2.0
"""


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(SCENE)
    return path


@pytest.fixture
def tipping(tmp_path):
    path = tmp_path / "tipping.toml"
    path.write_text(TIPPING)
    return path


def refused(capsys, *arguments):
    """The message of a refusal, after checking that it is one line and nothing else."""
    assert main([str(argument) for argument in arguments]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("gapbeam: error: ")
    assert err.count("\n") == 1
    return err.removeprefix("gapbeam: error: ")


def test_no_command_is_refused(capsys):
    assert "COMMAND" in refused(capsys)


def test_unknown_option_is_refused(capsys, scene):
    assert "--jsn" in refused(capsys, "run", scene, "--jsn", "x")


@pytest.mark.parametrize("command", ["run", "check"])
def test_missing_file(capsys, tmp_path, command):
    assert "none.toml" in refused(capsys, command, tmp_path / "none.toml")


@pytest.mark.parametrize("command", ["run", "check"])
@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("gap = 0.01", 'gap = "0,01"', 'supports[1].gap: expected a number, got "0,01"'),
        ("node = 2", "node = 5", "supports[2].node"),
        ("gap = 0.01", "gpa = 0.01", "supports[1].gpa"),
        ("spans = [6.0, 6.0]", "spans = [6.0, -6.0]", "beam.spans[1]"),
        ("EI = 1.0e4", "EI = 1.0e4 kN", "scene.toml"),
    ],
)
def test_bad_scenes_write_nothing(capsys, scene, tmp_path, command, old, new, message):
    scene.write_text(SCENE.replace(old, new))
    outputs = [tmp_path / name for name in ("a.json", "a.csv", "a.png")]
    options = ["--json", outputs[0], "--csv", outputs[1], "--plot", outputs[2]] if command == "run" else []
    assert message in refused(capsys, command, scene, *options)
    assert not any(path.exists() for path in outputs)


@pytest.mark.parametrize(
    ("option", "name", "message"),
    [
        ("--json", "nowhere/a.json", "does not exist"),
        ("--csv", "nowhere/a.csv", "does not exist"),
        ("--plot", "nowhere/a.png", "does not exist"),
        ("--plot", "a.docx", ".png, .pdf or .svg"),
        ("--plot", "a", ".png, .pdf or .svg"),
        ("--plot", "-", ".png, .pdf or .svg"),
        ("--xlsx", "-", "ends in .xlsx"),
        ("--xlsx", "a.xls", "ends in .xlsx"),
        ("--json", "", "name of a file"),
        ("--json", ".", "name of a file"),
    ],
)
def test_impossible_outputs_are_refused_before_solving(
    capsys, scene, tmp_path, monkeypatch, option, name, message
):
    monkeypatch.chdir(tmp_path)
    before = sorted(tmp_path.iterdir())
    text = refused(capsys, "run", scene, option, name)
    assert option in text
    assert message in text
    assert sorted(tmp_path.iterdir()) == before


def test_one_file_for_two_outputs_is_refused(capsys, scene, tmp_path):
    refused(capsys, "run", scene, "--json", tmp_path / "a", "--csv", tmp_path / "a")
    refused(capsys, "run", scene, "--json", "-", "--csv", "-")


def test_run_prints_a_report(capsys, scene):
    assert main(["run", str(scene)]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    for words in ("Two spans", "Largest moment", "Contact state", "reaction", "opening", "Extremes", "--verbose"):
        assert words in out
    assert "System" not in out
    assert main(["run", str(scene), "--verbose"]) == 0
    out, _ = capsys.readouterr()
    for words in ("System", "left out", "Residuals"):
        assert words in out


def test_run_writes_what_it_is_asked_for(capsys, scene, tmp_path):
    names = [tmp_path / name for name in ("a.json", "a.csv", "a.svg")]
    arguments = ["run", scene, "--quiet", "--json", names[0], "--csv", names[1], "--plot", names[2]]
    assert main([str(argument) for argument in arguments]) == 0
    assert capsys.readouterr() == ("", "")
    assert json.loads(names[0].read_text())["status"] == "solved"
    assert names[1].read_text().startswith("x [m],deflection [m],")
    assert "</svg>" in names[2].read_text()


def test_json_on_standard_output_stands_alone(capsys, scene):
    assert main(["run", str(scene), "--json", "-"]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    assert json.loads(out)["title"] == "Two spans"


def test_scene_from_standard_input(capsys, monkeypatch):
    monkeypatch.setattr(sys, "stdin", io.StringIO(SCENE))
    assert main(["check", "-"]) == 0
    assert "2 spans, 12 m; 3 supports, 1 of them one-sided; 1 load" in capsys.readouterr().out
    monkeypatch.setattr(sys, "stdin", io.StringIO('{"beam": {"spans": [1.0]}}'))
    assert "beam.EI" in refused(capsys, "check", "-")
    monkeypatch.setattr(sys, "stdin", io.StringIO("spans = ["))
    assert "standard input" in refused(capsys, "check", "-")


def test_check_is_one_line(capsys, scene):
    assert main(["check", str(scene)]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    assert out == f"{scene}: valid: 2 spans, 12 m; 3 supports, 1 of them one-sided; 1 load\n"


def test_no_equilibrium(capsys, tipping, tmp_path):
    picture, table = tmp_path / "a.png", tmp_path / "a.csv"
    assert main(["run", str(tipping), "--plot", str(picture), "--csv", str(table)]) == 1
    out, err = capsys.readouterr()
    assert "No equilibrium" in out
    assert "tips about the support at x = 6" in " ".join(out.split())
    assert picture.stat().st_size > 10_000
    assert not table.exists()
    assert "not written" in err


def test_tables_for_excel(capsys, scene, tipping, tmp_path, monkeypatch):
    pytest.importorskip("xlsxwriter")
    assert main(["run", str(scene), "--quiet", "--xlsx", str(tmp_path / "a.xlsx")]) == 0
    with zipfile.ZipFile(tmp_path / "a.xlsx") as book:
        words = book.read("xl/sharedStrings.xml").decode()
    assert "Two spans" in words
    assert "<t>reaction</t>" in words
    assert main(["run", str(tipping), "--xlsx", str(tmp_path / "b.xlsx")]) == 1
    assert not (tmp_path / "b.xlsx").exists()
    assert "b.xlsx is not written" in capsys.readouterr()[1]
    monkeypatch.setattr(gapbeam.cli.command, "find_spec", lambda _: None)
    assert 'pip install "gapbeam[excel]"' in refused(capsys, "run", scene, "--xlsx", tmp_path / "c.xlsx")


def test_no_equilibrium_quietly(capsys, tipping):
    assert main(["run", str(tipping), "--quiet"]) == 1
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("gapbeam: no equilibrium at load factor 1: ")
    assert err.count("\n") == 1
    assert main(["run", str(tipping), "--json", "-"]) == 1
    data = json.loads(capsys.readouterr().out)
    assert data["status"] == "no-equilibrium"
    assert data["reason"]


def test_schema(capsys):
    assert main(["schema"]) == 0
    schema = json.loads(capsys.readouterr().out)
    assert "$schema" in schema
    assert schema == gapbeam.scene_schema()


@pytest.mark.parametrize("command", ["run", "check", "schema"])
def test_help_teaches(capsys, command):
    with pytest.raises(SystemExit) as stopped:
        main([command, "--help"])
    assert stopped.value.code == 0
    out = capsys.readouterr().out
    for words in ("[[supports]]", "positive downward", "Exit status"):
        assert words in out


def test_the_scene_in_the_help_is_valid():
    import tomllib

    from gapbeam.cli.command import SCENE as shown

    assert gapbeam.solve(tomllib.loads(shown.partition("\n")[2])).status == "solved"


def test_version(capsys):
    with pytest.raises(SystemExit) as stopped:
        main(["--version"])
    assert stopped.value.code == 0
    assert capsys.readouterr().out == f"gapbeam {gapbeam.__version__}\n"


def test_check_imports_neither_rich_nor_matplotlib(scene):
    code = (
        "import sys; from gapbeam.__main__ import main; status = main(['check', sys.argv[1]]);"
        "sys.exit(status or bool({'rich', 'matplotlib'} & set(sys.modules)))"
    )
    assert subprocess.run([sys.executable, "-c", code, scene], capture_output=True).returncode == 0


def test_module_with_plain_characters(scene):
    """`python -m gapbeam` where standard output knows no others than ASCII."""
    command = [sys.executable, "-m", "gapbeam", "run", str(scene)]
    environment = {**os.environ, "PYTHONIOENCODING": "ascii"}
    run = subprocess.run(command, capture_output=True, env=environment, check=True)
    assert run.stdout.isascii()
    assert b"# in contact" in run.stdout


@pytest.mark.parametrize(("name", "status"), [("scene", 0), ("tipping", 1)])
def test_reader_that_leaves_early_costs_no_file(request, tmp_path, name, status):
    scene = str(request.getfixturevalue(name))
    command = [sys.executable, "-m", "gapbeam", "run", scene, "--json", str(tmp_path / "a.json")]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        process.stdout.close()
        assert process.stderr.read() == b""
    assert process.returncode == status
    assert json.loads((tmp_path / "a.json").read_text())["status"] in ("solved", "no-equilibrium")


def test_a_scene_without_a_command_is_answered(capsys):
    assert main(["beam.toml"]) == 2
    assert capsys.readouterr().err == "gapbeam: error: a command is missing; did you mean: gapbeam run beam.toml\n"
