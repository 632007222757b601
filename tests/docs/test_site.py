"""The site: it is built without a warning, needs nothing from outside, and every link in it leads somewhere."""

import os
import re
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote

import pytest

pytest.importorskip("myst_parser")
pytest.importorskip("pydata_sphinx_theme")
pytest.importorskip("sphinx_design")

TOP = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """Build the site as docs/build does."""
    folder = tmp_path_factory.mktemp("site")
    command = re.search(r"^python (-m sphinx .*) docs build/site$", (TOP / "docs" / "build").read_text(), re.MULTILINE)[1]
    words = command.replace('"$@"', "").replace("build/site", str(folder / "trees")).split()
    made = [sys.executable, *words, str(TOP / "docs"), str(folder / "html")]
    done = subprocess.run(made, capture_output=True, text=True, check=False, env=os.environ | {"MPLBACKEND": "Agg"})
    assert done.stderr == ""
    assert done.returncode == 0
    return folder / "html"


class Links(HTMLParser):
    """What a page links to, loads and shows."""

    def __init__(self, text):
        super().__init__()
        self.links, self.loaded, self.images, self.ids = [], [], [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        if found.get("id"):
            self.ids.add(found["id"])
        if tag == "a" and found.get("href"):
            self.links.append(found["href"])
        if tag in ("script", "img", "iframe") and found.get("src"):
            self.loaded.append(found["src"])
        if tag == "link" and found.get("rel") in ("stylesheet", "preload", "icon"):
            self.loaded.append(found["href"])
        if tag == "img":
            self.images.append(found)


@pytest.fixture(scope="module")
def parsed(site):
    return {page: Links(page.read_text(encoding="utf-8")) for page in site.rglob("*.html") if "_static" not in page.parts}


def test_every_page_is_built(parsed, site):
    sources = {path.relative_to(TOP / "docs").with_suffix(".html").as_posix() for path in (TOP / "docs").rglob("*.md")}
    assert {page.relative_to(site).as_posix() for page in parsed} >= sources
    assert len(sources) > 40


def test_nothing_comes_from_outside(parsed, site):
    for page, found in parsed.items():
        assert [source for source in found.loaded if re.match(r"(https?:)?//", source)] == [], page
    for style in site.rglob("*.css"):
        assert not re.search(r"(url\(|@import )['\"]?(https?:)?//", style.read_text(encoding="utf-8")), style


def test_every_link_leads_somewhere(parsed):
    broken = []
    for page, found in parsed.items():
        for link in [*found.links, *found.loaded]:
            if re.match(r"(https?|mailto|data):", link):
                continue
            name, _, anchor = unquote(link).partition("#")
            there = (page.parent / name.partition("?")[0]).resolve() if name else page
            lost = anchor and there in parsed and anchor not in parsed[there].ids
            if lost or not there.exists():
                broken.append(f"{page.name}: {link}")
    assert broken == []


def test_every_picture_is_described(parsed):
    for page, found in parsed.items():
        for image in found.images:
            assert len(image.get("alt", "")) > 3, f"{page}: {image['src']}"


def test_search_finds(site):
    index = (site / "searchindex.js").read_text(encoding="utf-8")
    for word in ("uplift", "settlement", "subgrad", "recipes/bridge"):
        assert f'"{word}"' in index or f"{word}:" in index, word
