"""Run every code block of the documentation, and renew what commands printed and drew.

``python docs/pages.py [PAGE...]`` runs all blocks of pages and writes outputs and pictures into them again.

A page is run in an empty folder, block by block: ``python`` in one namespace, with or without ``>>>``; ``toml`` is read as a scene,
and written to the file that its first line names; ``console`` holds commands after ``$`` with what they print, where a line ``...``
stands for any lines. A picture that is made there under the name of one beside the page is that one.
"""

import contextlib
import doctest
import io
import os
import re
import shlex
import subprocess
import sys
import tempfile
import tomllib
import warnings
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

import gapbeam
from gapbeam.cli import main as gapbeam_command
from jsonschema import Draft202012Validator

TOP = Path(__file__).resolve().parents[1]
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
BEAM = {"spans": [6.0], "EI": 1e4}
"""What a part of a scene may lack."""
OPTIONAL = {"openturns", "SALib", "umbridge"}
"""Packages of the extra uq; a block that takes one is passed over where it is not installed (tests/docs/test_function.py)."""
SOURCES = ("sh", "text", "json", "csv", "c", "fortran")
"""Blocks that tests of their own look at."""


class Ran(NamedTuple):
    """What has come of a page."""

    text: str
    problems: list
    pictures: dict


def pages():
    """Give all pages, the generated ones too."""
    return [TOP / "README.md", *sorted((TOP / "docs").rglob("*.md"))]


def run_page(page):
    """Run all blocks of a page; the text has the new outputs."""
    text, problems = page.read_text(encoding="utf-8"), []
    space = {"__name__": "__main__"}

    def renewed(match):
        language, body = match.groups()
        try:
            body = RUN[language](body, space, problems) if language in RUN else body
        except Exception as error:
            problems.append(f"{language} block\n{body}\n{type(error).__name__}: {error}")
        return f"```{language}\n{body}```"

    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder), warnings.catch_warnings():
        warnings.filterwarnings("error", category=DeprecationWarning, module="__main__")   # pages use no old names
        for name in ("examples", "docs", "tests"):
            Path(name).symlink_to(TOP / name)
        new = BLOCK.sub(renewed, text)
        pictures = {made.name: made.read_text(encoding="utf-8") for made in Path().glob("*.svg")}
    return Ran(new, problems, {name: drawn for name, drawn in pictures.items() if f"]({name})" in text})


def run_python(body, space, problems):
    """Run Python lines; of ``>>>`` compare and renew what they print."""
    imported = set(re.findall(r"^(?:>>> )?(?:import|from) (\w+)", body, re.MULTILINE))
    if any(find_spec(name) is None for name in imported & OPTIONAL):
        return body
    if ">>>" not in body:
        exec(compile(body, "<page>", "exec"), space)
        return body
    test = doctest.DocTestParser().get_doctest(body, space, "page", None, 0)
    runner, found = doctest.DocTestRunner(verbose=False, optionflags=doctest.NORMALIZE_WHITESPACE), {}

    def collect(out, test, example, got):
        found[example.lineno] = got

    runner.report_failure = collect
    runner.report_unexpected_exception = lambda out, test, example, info: problems.append(
        f"{example.source}{info[0].__name__}: {info[1]}"
    )
    runner.run(test, out=lambda _: None, clear_globs=False)
    space.update(test.globs)
    lines = body.splitlines(keepends=True)
    for example in sorted(test.examples, key=lambda one: -one.lineno):
        if example.lineno in found:
            problems.append(f"{example.source}expected {example.want}got {found[example.lineno]}")
            begin = example.lineno + example.source.count("\n")
            lines[begin : begin + example.want.count("\n")] = found[example.lineno].splitlines(keepends=True)
    return "".join(lines)


def run_toml(body, space, problems):
    """Solve a scene; hold a part of one against the schema."""
    data = tomllib.loads(body)
    if "beam" in data and "loads" in data:
        gapbeam.solve(data)
    else:
        errors = Draft202012Validator(gapbeam.scene_schema()).iter_errors({"beam": BEAM, **data})
        problems += [f"toml block\n{body}\n{error.json_path}: {error.message}" for error in errors]
    named = re.match(r"# ([\w-]+\.toml)$", body.partition("\n")[0])
    if named:
        Path(named[1]).write_text(body, encoding="utf-8")
    return body


def run_console(body, space, problems):
    """Run commands and compare what they print."""
    parts = re.split(r"^(\$ .*\n)", body, flags=re.MULTILINE)
    made = parts[0]
    for command, shown in zip(parts[1::2], parts[2::2], strict=True):
        printed = run_command(command[2:].strip(), space)
        new = shortened(printed, shown)
        if not matches(printed, shown):
            problems.append(f"{command}printed\n{new}instead of\n{shown}")
        made += command + new
    return made


def run_command(command, space):
    """Give what a command prints."""
    if command == "echo $?":
        return f"{space['status']}\n"
    words = shlex.split(command, comments=True)
    if words[0] == "python":
        done = subprocess.run([sys.executable, *words[1:]], capture_output=True, text=True, check=False)
        space["status"] = done.returncode
        return done.stdout + done.stderr
    if words[0] != "gapbeam":
        raise ValueError(f"the tests cannot run {command!r}")
    out = io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
        space["status"] = gapbeam_command(words[1:])
    return "".join(f"{line.rstrip()}\n" for line in out.getvalue().splitlines())


def matches(printed, shown):
    """Whether what is printed is what is shown, where ``...`` stands for any lines."""
    pattern = "".join(r"(?:.*\n)*?" if line == "..." else re.escape(line) + r"\n" for line in shown.strip("\n").splitlines())
    return re.fullmatch(pattern, printed.strip("\n") + "\n" if printed.strip() else "") is not None


def shortened(printed, shown):
    """Give what is printed, as many of its paragraphs as are shown before ``...``."""
    if not shown.rstrip().endswith("..."):
        return printed
    count = shown.rstrip()[:-3].strip().count("\n\n") + 1
    return "\n\n".join(printed.strip("\n").split("\n\n")[:count]) + "\n...\n"


def texts_in(picture):
    """Give the texts in a picture; the rest depends on the version of matplotlib."""
    return re.findall(r"<text[^>]*>([^<]+)</text>", picture)


RUN = {"python": run_python, "toml": run_toml, "console": run_console}


def main(arguments):
    """Renew pages, all unless some are named."""
    os.environ["MPLBACKEND"] = "Agg"
    for page in map(Path, arguments or pages()):
        page = page.resolve()
        ran = run_page(page)
        page.write_text(ran.text, encoding="utf-8")
        for name, drawn in ran.pictures.items():
            there = page.parent / name
            if not there.exists() or texts_in(there.read_text(encoding="utf-8")) != texts_in(drawn):
                there.write_text(drawn, encoding="utf-8")
                print(f"{there.relative_to(TOP)}: drawn anew")
        for problem in ran.problems:
            print(f"{page.relative_to(TOP)}: {problem}")


if __name__ == "__main__":
    main(sys.argv[1:])
