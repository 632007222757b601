"""Where the studies are: accuracy in the package, the others beside the tests, and what each page says of its own making."""

import re
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import gapbeam
import pytest
from gapbeam.cli import main
from gapbeam.cli.studies import MOVED

TOP = Path(__file__).resolve().parents[2]
STUDIES = TOP / "tests" / "studies"
PAGES = {"batch": "batch", "contact": "contact", "corners": "extremes", "foundation": "foundation", "kernel": "kernel",
         "schemes": "schemes", "trains": "trains"}  # fmt: skip
"""Names of studies by the modules that hold their pages."""


@pytest.mark.parametrize("options", [[], ["--help"], ["--largest", "10", "--markdown", "-"], ["--", "scene.toml"]])
@pytest.mark.parametrize("name", MOVED)
def test_the_command_says_where_a_study_is_now(name, options, capsys):
    assert main(["study", name, *options]) == 2
    line = f"study {name} measures the program itself and is not installed: python tests/studies {name} in a checkout"
    assert capsys.readouterr() == ("", f"gapbeam: error: {line}\n")


def test_the_command_has_one_study(capsys):
    with pytest.raises(SystemExit) as ended:
        main(["study", "--help"])
    assert ended.value.code == 0
    told = capsys.readouterr().out
    assert "accuracy" in told
    assert main(["study", "nothing"]) == 2
    told += capsys.readouterr().err
    assert not any(name in told for name in MOVED)


def test_all_others_run_beside_the_tests(tmp_path):
    def run(*words):
        return subprocess.run([sys.executable, STUDIES, *words], capture_output=True, text=True, cwd=tmp_path)

    told = run("--help")
    assert told.returncode == 0
    assert set(re.findall(r"^    (\w+)\b", told.stdout, re.MULTILINE)) == {"axial", *MOVED}
    assert set(MOVED) == set(PAGES.values())
    wrong = run("accuracy")
    assert (wrong.returncode, wrong.stdout) == (2, "")
    assert wrong.stderr.count("\n") == 1
    made = run("kernel", "--largest", "10", "--csv", "kernel.csv")
    assert (made.returncode, made.stderr) == (0, "")
    assert (tmp_path / "kernel.csv").read_text().startswith("beam,method,nodes")


@pytest.mark.parametrize("module", PAGES)
def test_a_page_says_what_made_it(module):
    page = import_module(f"studies.{module}").PAGE
    assert page.study == PAGES[module]
    written = (TOP / "docs" / f"{page.file or page.study}.md").read_text()
    picture = f"{page.file}.svg" if page.caption else ""
    begin = page.markdown([["x"] * len(page.columns)], "", picture).partition("\n\n|")[0]
    assert written.startswith(begin)


def test_what_measures_the_program_is_not_installed():
    folder = Path(gapbeam.__file__).parent / "studies"
    names = {path.stem for path in folder.glob("*.py")}
    assert names == {path.stem for path in (TOP / "python" / "gapbeam" / "studies").glob("*.py")}
    assert not names & {path.stem for path in STUDIES.glob("*.py")} - {"__init__", "page", "diagram"}
