"""What a release takes: the version in one place, workflows of a forge that are commands of this tree, classifiers of Python."""

import re
import tomllib
from pathlib import Path

import gapbeam
import pytest

TOP = Path(__file__).resolve().parents[2]
WORKFLOWS = TOP / ".github" / "workflows"
COMMANDS = {"tests": "bash .ci/run", "wheels": "sh tests/wheel", "docs": "sh docs/build"}
#: Where the version is told rather than set; the first two are compared in test_docs, the last one here
TOLD = {"CITATION.cff", "docs/cite.md", "docs/changelog.md"}


def sources():
    """Texts of the tree, built things left out."""
    for place in ("CITATION.cff", "README.md", "meson.build", "meson.options", "pyproject.toml", "docs", "examples", "fortran",
                  "python", "tests"):  # fmt: skip
        top = TOP / place
        for path in [top] if top.is_file() else sorted(top.rglob("*")):
            if path.is_file() and path.suffix not in (".png", ".pyc", ".svg", ".xlsx"):
                yield path


def test_the_version_is_in_one_place():
    version = re.compile(rf"(?<![\d.]){re.escape(gapbeam.__version__)}(?![\d.]*\d)")
    having = {path.relative_to(TOP).as_posix() for path in sources() if version.search(path.read_text(encoding="utf-8"))}
    assert having <= {"meson.build"} | TOLD
    assert (TOP / "meson.build").read_text(encoding="utf-8").count(f"version: '{gapbeam.__version__}'") == 1


def test_the_changelog_begins_with_the_version():
    first = re.search(r"^## (\S+)", (TOP / "docs" / "changelog.md").read_text(encoding="utf-8"), re.MULTILINE)
    assert first[1] == gapbeam.__version__


@pytest.mark.parametrize("name", COMMANDS)
def test_a_workflow_runs_the_command_of_this_tree(name):
    """What passes here passes there: a workflow has no command of its own."""
    text = (WORKFLOWS / f"{name}.yml").read_text(encoding="utf-8")
    assert re.findall(r"^ *-? *run: *(.*)$", text, re.MULTILINE) == [COMMANDS[name]]
    assert (TOP / COMMANDS[name].split()[1]).is_file()
    assert sorted(path.stem for path in WORKFLOWS.iterdir()) == sorted(COMMANDS)
    assert not re.search(r"secrets\.|curl|pip ", text)


def test_wheels_are_made_for_all_that_the_package_names():
    """Pythons of the workflow, of the package's classifiers and those that tests/wheel looks for."""
    project = tomllib.loads((TOP / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    named = re.findall(r"Python :: (3\.\d+)", "\n".join(project["classifiers"]))
    workflow = re.findall(r"^ +(3\.\d+)$", (WORKFLOWS / "wheels.yml").read_text(encoding="utf-8"), re.MULTILINE)
    assert sorted(workflow) == sorted(named)
    assert project["requires-python"] == f">={min(named, key=lambda one: int(one[2:]))}"
    last = max(int(one[2:]) for one in named)
    assert f'while [ "$minor" -le {last} ]; do' in (TOP / "tests" / "wheel").read_text(encoding="utf-8")
