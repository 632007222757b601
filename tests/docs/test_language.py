"""The English of README and docs: short sentences, and the words of structural engineering."""

import re
from pathlib import Path

import pytest

TOP = Path(__file__).resolve().parents[2]
PAGES = ["README.md", *sorted(path.relative_to(TOP).as_posix() for path in (TOP / "docs").rglob("*.md"))]
MEAN, LONGEST = 17, 35
"""Words of a sentence: the mean of a page, and the most."""
WRONG = {
    r"working schemes?": "contact state",
    r"scheme of supports|starting schemes?": "contact state",
    r"cannot stand|stands? no more": "is unstable",
    r"(?<!and so )\bgo(es)? on\b": "continues",
    r"lets? go\b": "loses contact",
    r"is idle|are idle": "carries no load",
    r"lacks? of fit": "preload, negative gap",
    r"the way of the load|ways? of all combinations": "loading history",
    r"what one reads off": "a list of findings",
    r"indifferent equilibrium": "neutral equilibrium",
    r"bilateral supports?": "two-way supports",
    r"referee": "check in quadruple precision",
    r"runaways?": "unbounded rigid-body motion",
}
"""Words that no engineer writes, each with what to write instead."""


def prose(text):
    """What is written on a page: without code, pictures, addresses and what is made by a command of its own."""
    text = re.sub(r"```.*?```|<!-- lists.*?<!-- end[^>]*>", "\n", text, flags=re.DOTALL)
    text = re.sub(r"(?m)(?<=\n)\n(?:    \S.*\n)+|^!\[.*$|^## Sources\n[\s\S]*", "\n", text)
    return re.sub(r"`[^`]*`", "code", re.sub(r"\]\([^)]*\)", "]", text))


def words(part):
    return re.findall(r"[\w'-]+", part)


def sentences(text):
    """Sentences of a page, each as a list of words; of tables and headings see `cells`."""
    lines = [line for line in prose(text).splitlines() if not line.startswith(("|", "#", ":"))]
    parts = re.split(r"(?<=[.:?!])\*{0,2}\s+|\n\s*\n|\n\s*(?=(?:[*-]|\d+\.) )", "\n".join(lines))
    return [found for part in parts if len(found := words(part)) > 2]


def cells(text):
    """Sentences in the tables of a page."""
    rows = [line for line in prose(text).splitlines() if line.startswith("|")]
    parts = [part for row in rows for cell in row.split("|") for part in re.split(r"(?<=[.:?!;])\s+", cell)]
    return [words(part) for part in parts]


def page(name):
    return (TOP / name).read_text(encoding="utf-8")


@pytest.mark.parametrize("name", PAGES)
def test_sentences_are_short(name):
    found = sentences(page(name))
    longest = max(found + cells(page(name)), key=len, default=[])
    assert len(longest) <= LONGEST, " ".join(longest)
    if name != "docs/changelog.md":
        assert sum(map(len, found)) <= MEAN * len(found)


@pytest.mark.parametrize("name", PAGES)
def test_words_are_those_of_the_field(name):
    if name in ("docs/glossary.md", "docs/changelog.md"):  # they name old words
        return
    text = " ".join(prose(page(name)).split())
    wrong = {found[0]: instead for pattern, instead in WRONG.items() for found in re.finditer(rf"(?i)\b(?:{pattern})", text)}
    assert wrong == {}


def test_bad_sentences_are_found():
    assert sum(len(sentences(page(name))) for name in PAGES) > 1500
    long = "One word " * 18 + "ends here."
    assert max(map(len, sentences(f"# Page\n\nShort it is.\n{long}\n"))) == 38
    assert max(map(len, cells(f"| a | b |\n|---|---|\n| x | {long} |\n"))) == 38
    assert [len(one) for one in sentences("* one two three:\n  * four five six\n* seven eight nine\n")] == [3, 3, 3]
    assert sentences("```\na b c d\n```\n\n    a = b c d\n\n![a b c d](e)\n") == []
    assert re.search("|".join(WRONG), "The beam goes on and cannot stand.")
