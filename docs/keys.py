"""Write the pages that list every key: docs/reference/scene.md of scenes, docs/reference/results.md of the JSON output.

All but the examples comes from the JSON Schemas, which come from the docstrings of the package.
"""

import re
import tomllib
from pathlib import Path

import gapbeam
from gapbeam.scene.key_units import ONE

REFERENCE = Path(__file__).parent / "reference"
UNIT = re.compile(rf"\s*\((no unit|{ONE}(?:, {ONE})*)(, from the left end(?: of the beam)?)?\)")
"""In a description: the unit of the value, or those of a pair."""

SCENE = tomllib.loads((Path(__file__).parent / "keys.toml").read_text(encoding="utf-8"))
NONE = "-"


def kind_of(entry):
    """Say in words which values a key takes."""
    if "$ref" in entry:
        return link(entry["$ref"])
    if "enum" in entry:
        return " or ".join(f"`{word}`" if isinstance(word, (int, float)) else f'`"{word}"`' for word in entry["enum"])
    if "anyOf" in entry:
        kinds = list(dict.fromkeys(kind_of(one) for one in entry["anyOf"]))
        return " or ".join(sorted(kinds, key=lambda kind: kind == "null"))
    if entry.get("type") == "array" and "prefixItems" in entry:
        return "(" + ", ".join(kind_of(one) for one in entry["prefixItems"]) + ")"
    if entry.get("type") == "array":
        return f"list of {kind_of(entry['items'])}"
    if entry.get("type") == "object":
        return f"table by name of {kind_of(entry['additionalProperties'])}"
    words = {"string": "text", "boolean": "`true` or `false`", "integer": "whole number"}.get(entry["type"], entry["type"])
    limits = [f" {sign} {entry[key]}" for key, sign in (("exclusiveMinimum", ">"), ("minimum", "≥")) if key in entry]
    return words + "".join(limits).replace(" ", "\N{NO-BREAK SPACE}")


def link(reference):
    """Link to a table, by the heading that it has on the page."""
    name = reference.rpartition("/")[2]
    return f"[{name}](#{name.lower()})"


def default_of(entry, key, table):
    """Give the default of a key as it is written in a file."""
    if key in table.get("required", ()):
        return "required"
    if re.search(r"default inf\b", entry.get("description", "")):
        return "`inf`"
    if key == "history":
        return "`[1.0]`"
    value = entry.get("default")
    if value in (None, "", [], {}):
        return NONE
    return f'`"{value}"`' if isinstance(value, str) else f"`{str(value).lower()}`"


def meaning_of(description):
    """Split a description into the unit and the rest."""
    found = UNIT.search(description)
    if not found:
        return NONE, description
    rest = description[: found.start()] + (found[2] or "") + description[found.end() :]
    unit = found[1].replace("*", "·").replace("^2", "²").replace("^3", "³").replace("^4", "⁴")
    return unit, rest.strip()


def cell(text):
    """Make a text fit for a table of Markdown."""
    return text.replace("|", "\\|").replace("*", "\\*")


def table_of(name, table, with_defaults=True):
    """Give the lines that describe the keys of a table."""
    head = "| key | value | unit | default | meaning |" if with_defaults else "| key | value | unit | meaning |"
    lines = [head, "|---" * (head.count("|") - 1) + "|"]
    for key, entry in table["properties"].items():
        unit, meaning = meaning_of(entry["description"])
        if with_defaults:
            default = default_of(entry, key, table)
            meaning = re.sub(r"[;,]? default .*?(?=[.;](?: |$)|$)| \(default\)", "", meaning) if default != NONE else meaning
        shown = f"`{key}`" if key in table.get("required", ()) or with_defaults else f"`{key}` (optional)"
        row = [shown, kind_of(entry).replace(" or null", "" if with_defaults else " or `null`"), unit]
        lines.append("| " + " | ".join(map(cell, [*row, *([default] if with_defaults else []), meaning])) + " |")
    return [*lines, ""]


def scene_page():
    """Give the page on scenes."""
    defs = gapbeam.scene_schema()["$defs"]
    lines = [
        "# Every key of a scene", "",
        "Units are those of the scene: any consistent set, such as kN and m. Signs: [modelling](../modelling.md#signs-and-units).",
        "A key that is not listed here is refused, and the message names the nearest one that is.",
        "The examples are parts of files. What they lack is a beam of two spans on three supports.", "",
        "![Signs of loads, reactions and moments; sides, gaps and settlements of supports](../signs.svg)", "",
        "This page is made by `python docs/keys.py` from what `gapbeam schema` prints.", "",
    ]  # fmt: skip
    for name, told in SCENE.items():
        heading = told["heading"]
        heading = heading if heading == "The file" else f"`{heading}`"
        lines += [f"## {name}", "", f"{heading}: {defs[name]['description'][:1].lower()}{defs[name]['description'][1:]}", ""]
        lines += table_of(name, defs[name])
        for example in told["examples"]:
            lines += ["```toml", example.strip(), "```", ""]
    return "\n".join(lines)


def results_page():
    """Give the page on results."""
    schema = gapbeam.result_schema()
    lines = [
        "# Every key of the JSON output", "",
        "`gapbeam run SCENE --json FILE` and `result.to_json(FILE)` write it.",
        f'Its version is `"schema": "{schema["title"]}"`. The number grows when programs that read it have to change.',
        "New keys may come without that. Numbers are written so that reading them back gives the same floating-point number.", "",
        "This page is made by `python docs/keys.py` from what `gapbeam schema --results` prints.", "",
    ]  # fmt: skip
    for name in sorted(schema["$defs"], key=lambda name: name != "Results"):
        table = schema["$defs"][name]
        lines += [f"## {name}", "", table["description"], "", *table_of(name, table, with_defaults=False)]
    return "\n".join(lines)


PAGES = {"scene.md": scene_page, "results.md": results_page}

if __name__ == "__main__":
    for name, make in PAGES.items():
        (REFERENCE / name).write_text(make(), encoding="utf-8")
