"""``gapbeam new``: every scene runs, is that of the task of the same name, and overwrites nothing."""

from pathlib import Path

import gapbeam
import pytest
from gapbeam.cli import main
from gapbeam.cli.new import TASKS, TEMPLATES

TOP = Path(__file__).resolve().parents[3]
MATLOCK = "pile"
"""Its curves are given at five depths; the task has layers."""


def scenes_of_task(name):
    """The scenes that a script of examples/tasks makes, without solving them."""
    text = (TOP / "examples" / "tasks" / f"{name.replace('-', '_')}.py").read_text(encoding="utf-8")
    before, asked, _ = text.partition("# What a designer asks\n")
    assert asked
    names = {}
    exec(before, names)
    if name == "slab":
        return [names["slab"]("Slab on reactive clay, centre heave", names["CENTRE"])]
    return [one for one in names.values() if isinstance(one, gapbeam.Scene)]


@pytest.mark.parametrize("name", TASKS)
def test_a_scene_runs(name, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["new", name]) == 0
    assert capsys.readouterr().out == f"{name}.toml is written; gapbeam run {name}.toml solves it\n"
    text = (tmp_path / f"{name}.toml").read_text(encoding="utf-8")
    assert text.startswith("# ")
    assert max(map(len, text.splitlines())) <= (170 if name == MATLOCK else 132)
    assert main(["run", f"{name}.toml"]) == 0
    shown = capsys.readouterr()
    assert not shown.err
    assert shown.out.splitlines()[0] in text
    assert main(["check", f"{name}.toml"]) == 0


@pytest.mark.parametrize("name", [name for name in TASKS if name != MATLOCK])
def test_a_scene_is_that_of_its_task(name):
    (task,) = scenes_of_task(name)
    assert gapbeam.read_scene(TEMPLATES / f"{name}.toml").to_dict() == gapbeam.read_scene(task.to_dict()).to_dict()


def test_the_pile_is_that_of_its_task():
    (task,) = scenes_of_task(MATLOCK)
    one, other = gapbeam.solve(task), gapbeam.solve(TEMPLATES / f"{MATLOCK}.toml")
    assert float(other.at(0.0).deflection) == pytest.approx(float(one.at(0.0).deflection), rel=0.02)
    assert other.extremes["moment"]["min"].value == pytest.approx(one.extremes["moment"]["min"].value, rel=0.01)


def test_all_files_have_names():
    assert sorted(path.name for path in TEMPLATES.iterdir()) == sorted(f"{name}.toml" for name in TASKS)
    assert len(TASKS) == len(list((TOP / "examples" / "tasks").glob("*.py"))) == 9
    page = (TOP / "docs" / "command.md").read_text(encoding="utf-8")
    assert all(f"| `{name}` | {about}" in page for name, about in TASKS.items())


@pytest.mark.parametrize("name", ["crane_runway", "Bridge", "no such", "../bridge", "bridge.toml", ""])
def test_an_unknown_name_is_refused(name, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["new", name]) == 2
    told = capsys.readouterr().err
    assert told.startswith(f'gapbeam: error: no scene is called "{name}"; ')
    assert told.endswith(f"here are: {', '.join(TASKS)}\n")
    assert ("did you mean crane-runway? " in told) == (name == "crane_runway")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("kind", ["file", "folder", "dangling link"])
def test_what_is_there_is_left(kind, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    there = tmp_path / "shaft.toml"
    if kind == "file":
        there.write_text("mine")
    elif kind == "folder":
        there.mkdir()
    else:
        there.symlink_to(tmp_path / "nowhere")
    assert main(["new", "shaft"]) == 2
    told = "is there already, and is left as it is; move it, or call gapbeam new shaft in another folder"
    assert capsys.readouterr().err == f"gapbeam: error: shaft.toml: {told}\n"
    assert kind != "file" or there.read_text() == "mine"
    assert not (tmp_path / "nowhere").exists()


def test_help_lists_the_names(capsys):
    with pytest.raises(SystemExit):
        main(["new", "--help"])
    shown = capsys.readouterr().out
    assert all(f"  {name:14}{about}\n" in shown for name, about in TASKS.items())
    with pytest.raises(SystemExit):
        main(["--help"])
    assert "    new " in capsys.readouterr().out
