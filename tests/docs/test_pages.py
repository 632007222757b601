"""Every page: its code blocks run and print what they show, its pictures are drawn by them, its links lead somewhere."""

import os
import re
from pathlib import Path
from runpy import run_path

import pytest
from gapbeam.cli.command import _parser

TOP = Path(__file__).resolve().parents[2]
DOCS = TOP / "docs"
RUNNER = run_path(str(DOCS / "pages.py"))
PAGES = RUNNER["pages"]()
NAMES = [page.relative_to(TOP).as_posix() for page in PAGES]
RECIPES = sorted(path for path in (DOCS / "recipes").glob("*.md") if path.name != "index.md")
SHOWN = {"", "text", "json", "csv"}
"""Blocks that are shown only; what prints them is tested beside (test_docs, test_readme, test_examples)."""


def blocks(page):
    return re.findall(r"^```([\w{}-]*).*?\n(.*?)^```$", page.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)


@pytest.mark.parametrize("page", PAGES, ids=NAMES)
def test_blocks_run(page):
    ran = RUNNER["run_page"](page)
    assert ran.problems == []
    for name, drawn in ran.pictures.items():
        texts = RUNNER["texts_in"](drawn)
        assert len(texts) > 5
        assert texts == RUNNER["texts_in"]((page.parent / name).read_text(encoding="utf-8"))


@pytest.mark.parametrize("page", PAGES, ids=NAMES)
def test_every_block_is_of_a_kind_that_is_run(page):
    of_the_site = {"{toctree}", "{help}", "{eval-rst}"}
    assert {language for language, _ in blocks(page)} <= {*RUNNER["RUN"], *SHOWN, *of_the_site, "sh"}


@pytest.mark.parametrize("page", PAGES, ids=NAMES)
def test_shell_lines_are_possible(page):
    """Commands of the shell are not run here; their files and options are there."""
    for language, body in blocks(page):
        for line in body.splitlines() if language == "sh" else ():
            words = line.partition("#")[0].split()
            if words and words[0] == "gapbeam":
                _parser().parse_args(words[1:])
            elif words and words[0] in ("sh", "python"):
                assert (TOP / words[1]).exists() or words[1] == "-m", line


@pytest.mark.parametrize("page", PAGES, ids=NAMES)
def test_links_and_pictures(page):
    text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
    links = re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`]*`", "", text))
    for link in links:
        name, _, anchor = link.partition("#")
        if re.match(r"https?:", link):
            assert re.fullmatch(r"https?://[\w.-]+\.\w+(/\S*)?", link), link
            continue
        there = page.parent / name if name else page
        assert there.exists(), link
        if anchor:
            headings = re.findall(r"^#+ (.*)", there.read_text(encoding="utf-8"), re.MULTILINE)
            anchors = [re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in headings]
            assert anchor in anchors, link


@pytest.mark.parametrize("page", RECIPES, ids=lambda page: page.stem)
def test_recipes_are_short_and_have_a_picture(page):
    """A scene or program of at most 15 lines, an answer that is compared, a picture that it makes."""
    text = page.read_text(encoding="utf-8")
    solving = [body for language, body in blocks(page) if language in ("toml", "python")]
    assert 3 <= len([line for line in solving[0].splitlines() if not re.match(r"\s*(#|$)", line)]) <= 15
    assert re.search(r"^!\[[^\]]{20,}\]\(" + page.stem + r"\.svg\)$", text, re.MULTILINE)
    assert f"{page.stem}.svg" in RUNNER["run_page"](page).pictures
    for heading in ("## Solve", "## Read", "## Vary"):
        assert heading in text
    assert os.path.getsize(page.with_suffix(".svg")) < 150_000


def test_recipes_are_in_the_gallery():
    gallery = (DOCS / "recipes" / "index.md").read_text(encoding="utf-8")
    assert RECIPES
    assert [page.name for page in RECIPES if f"({page.name})" not in gallery or f"({page.stem}.svg)" not in gallery] == []
