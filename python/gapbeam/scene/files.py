"""Scenes written in TOML or JSON, from a file or from standard input: both are read in the same way."""

from __future__ import annotations

import codecs
import json
import re
import sys
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn

from ..base.errors import SceneError, SceneFileError
from .lines import line_of, lines_of_keys, path_of
from .typed import TOO_DEEP
from .wording import key_of, out_of_range, shown

STANDARD_INPUT = "standard input"
JSON_INFINITIES = ("1e999", "-1e999", "1E999", "-1E999")
"""What other programs write where JSON knows no infinity."""
LONG_KEY = re.compile(r"""(?<![\w.-])(?:(?:[\w-]++|"[^"\n]*+"|'[^'\n]*+')[ \t]*+\.[ \t]*+){100}""")
"""A key of more than a hundred parts: no scene has one, and tomllib takes minutes for some ten thousand parts."""

SYNTAX = {
    r"Cannot mutate": "it is written in one piece above; add to that, or write all of it as tables of their own",
    r"Invalid initial[^:]*: ,\s*}": "leave out the comma before it",
    r"Invalid initial[^:]*: [{,]\s*(#.*)?$": "a table in braces is written on one line; over several lines write it as [table]",
    r"Cannot (declare|overwrite)": "it stands above already; leave one of the two out",
    r".*?: .[“”„\u2018\u2019]": "write straight quotes",
    r".*?: .[-+]?(Inf|inf|\.inf|∞)": "infinite is inf",
    r"Expecting.*?: ,[\]}]": "leave out the comma before it",
    r"(Expecting|Extra data).*?: .(//|/\*|#)": "JSON has no comments; leave them out, or write TOML",
}
"""What to do about a mistake of the syntax, by its words, the character before it and what follows."""


class Written(dict):
    """Data of a file, with its text for messages that name a line.

    Parameters
    ----------
    data : dict
        What stands there.
    name : str
        Of the file.
    text : str
        Its contents.
    """

    __slots__ = ("name", "text")

    def __init__(self, data: dict[str, Any], name: str, text: str) -> None:
        super().__init__(data)
        self.name, self.text = name, text

    def __reduce__(self) -> tuple:
        """Pickle as made."""
        return type(self), (dict(self), self.name, self.text)


def read_file(path: Path) -> Written:
    """Read a TOML or JSON file.

    Parameters
    ----------
    path : pathlib.Path
        A file that ends in .toml or .json.

    Returns
    -------
    Written
        The data as they stand there; only the syntax is checked.

    Raises
    ------
    SceneError
        Names the file and, for its syntax, line and column.
    """
    kind = path.suffix.lower()
    if kind not in (".toml", ".json"):
        text = "; to read a text of TOML, give tomllib.loads(text)" if "=" in str(path) else ""
        raise SceneError(str(path), f'a scene file ends in .toml or .json, not in "{path.suffix}"{text}')
    try:
        data = path.read_bytes()
    except FileNotFoundError:
        raise SceneError(str(path), "there is no such file") from None
    except (OSError, ValueError) as error:
        raise _unreadable(str(path), error) from None
    return _parse(_decoded(data, str(path)), kind, str(path))


def read_standard_input() -> Written:
    """Read TOML, or JSON where the text begins with a brace, from standard input.

    Returns
    -------
    Written
        As from `read_file`.

    Raises
    ------
    SceneError
        As from `read_file`.
    """
    if sys.stdin is None:
        raise SceneError(STANDARD_INPUT, "is closed; give the name of a file")
    try:
        data = getattr(sys.stdin, "buffer", sys.stdin).read()
    except (OSError, ValueError) as error:
        raise _unreadable(STANDARD_INPUT, error) from None
    text = data if isinstance(data, str) else _decoded(data, STANDARD_INPUT)
    return _parse(text, ".json" if text.lstrip().startswith("{") else ".toml", STANDARD_INPUT)


def _unreadable(name: str, error: Exception) -> SceneError:
    return SceneError(name, f"cannot be read ({getattr(error, 'strerror', None) or error})")


def _decoded(data: bytes, name: str) -> str:
    """Text of UTF-8, with or without a mark of byte order; lines end as they do on any system."""
    mark = len(codecs.BOM_UTF8) if data.startswith(codecs.BOM_UTF8) else 0
    try:
        text = data[mark:].decode("utf-8")
    except UnicodeDecodeError as error:
        raise SceneError(name, f"not a text in UTF-8 (byte {mark + error.start + 1} is wrong); save it as UTF-8") from None
    return text.replace("\r\n", "\n").replace("\r", "\n")


def _parse(text: str, kind: str, name: str) -> Written:
    """Parse a text of the kind .toml or .json that came from a place with a name."""
    if kind == ".toml" and LONG_KEY.search(text):
        raise SceneError(name, TOO_DEEP)
    far: list[_Far] = []

    def number(word: str) -> Any:
        value = float(word)
        if out_of_range(word, value) and not (kind == ".json" and word in JSON_INFINITIES):
            far.append(_Far(word, value))
            return far[-1]
        return value

    try:
        if kind == ".toml":
            data = tomllib.loads(text, parse_float=number)
        else:
            data = json.loads(text, parse_float=number, object_pairs_hook=_table)
    except tomllib.TOMLDecodeError as error:
        found = re.search(r"\(at line (\d+), column (\d+)\)", str(error))
        end = text.count("\n") + 1, len(text.rpartition("\n")[2]) + 1
        line, column = map(int, found.groups()) if found else end
        _syntax(name, text, line, column, str(error).partition(" (at ")[0])
    except json.JSONDecodeError as error:
        _syntax(name, text, error.lineno, error.colno, error.msg)
    except RecursionError:
        raise SceneError(name, TOO_DEEP) from None
    except _TwiceError as error:
        raise SceneError(name, str(error)) from None
    except ValueError:
        raise SceneError(name, f"a number has more than {sys.get_int_max_str_digits()} digits") from None
    if far:
        lines = lines_of_keys(text)
        found = [(_place(data, one), out_of_range(one.word, one.value)) for one in far]
        raise SceneFileError(name, [(line_of(lines, path_of(place, data)), place, problem) for place, problem in found])
    if not isinstance(data, dict):
        raise SceneError(name, f"expected a table with beam, supports and loads, got {shown(data)}")
    return Written(data, name, text)


@dataclass(eq=False)
class _Far:
    """A number that is beyond the range of doubles, as it is written, and what they make of it."""

    word: str
    value: float


def _place(data: Any, far: _Far) -> str:
    """Key path of such a number."""
    rest = [("", data)]
    while rest[-1][1] is not far:
        at, one = rest.pop()
        if isinstance(one, dict):
            rest += [(f"{at}.{key_of(key)}".lstrip("."), value) for key, value in one.items()]
        elif isinstance(one, list):
            rest += [(f"{at}[{k}]", value) for k, value in enumerate(one)]
    return rest[-1][0]


class _TwiceError(ValueError):
    """One key stands twice in a table."""


def _table(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """Make a JSON table; of two equal keys one would get lost without a word."""
    table = dict(pairs)
    if len(table) < len(pairs):
        seen = set()
        twice = next(key for key, _ in pairs if key in seen or seen.add(key))
        raise _TwiceError(f"the key {shown(twice)} stands twice in one table")
    return table


def _syntax(name: str, text: str, line: int, column: int, problem: str) -> NoReturn:
    lines = text.split("\n")
    source = (lines[line - 1 : line] or [""])[0]
    before = "\n".join([*lines[: line - 1], source[: column - 1]]).rstrip()[-1:]
    there = f"{problem}: {before}{source[column - 1 :]}"
    comma = re.search(r"(?<![\d,\[])\s\d+,\d+\s*(#|$)", source)
    hint = f'; write numbers with a point: "{comma[0].strip(" #").replace(",", ".")}"' if comma else ""
    unit = re.search(r"[=\[,]\s*([-+]?\d[\d.eE+-]*)\s?((?:[mck]?m|[kM]?N|kNm)\d?)\b", source)
    hint = f"; numbers have no units: write {unit[1]} if the scene has {unit[2]}, else convert it" if unit else hint
    hint = next((f"; {words}" for mistake, words in SYNTAX.items() if re.match(mistake, there)), hint)
    quoted = f", in: {source.strip()[:80]}" if source.strip() else ""
    raise SceneError(f"{name}, line {line}, column {column}", f"{problem}{quoted}{hint}") from None
