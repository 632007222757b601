"""Lines of keys in a text of TOML or JSON, for messages: a scanner for texts that have been parsed already."""

from __future__ import annotations

import json
import re
from contextlib import suppress
from typing import Any

from ..base.errors import SceneError
from .edited import pieces_of
from .wording import shown

Path = tuple[str | int, ...]
BLANK = re.compile(r"(?:[ \t\r\n,]|#[^\n]*)*")
"""What may stand between entries; a JSON text has no comments, so nothing of it is taken for one."""
KEY = re.compile(r"""[A-Za-z0-9_-]+|"(?:[^"\\\n]|\\.)*"|'[^'\n]*'""")
STRING = re.compile(r'"""(?:[^\\]|\\.)*?"{3,5}|\'\'\'.*?\'{3,5}|"(?:[^"\\\n]|\\.)*"|\'[^\'\n]*\'', re.DOTALL)
SCALAR = re.compile(r"[^,\]}\n#]+")
HEADER = re.compile(r"\[\[?")


def lines_of_keys(text: str) -> dict[Path, int]:
    r"""Find the line of every key and entry.

    Parameters
    ----------
    text : str
        TOML, or JSON where it begins with a brace.

    Returns
    -------
    dict
        Line, from 1, by path: keys and numbers of entries.

    Examples
    --------
    >>> lines = lines_of_keys("[beam]\nspans = [6.0,\n  7.0]\n[[supports]]\nnode = 0\n[[supports]]\nlaw.type = 'plastic'\n")
    >>> lines["beam", "spans", 1], lines["supports", 1], lines["supports", 1, "law", "type"]
    (3, 6, 7)
    """
    scanner = _Scanner(text)
    with suppress(RecursionError, ValueError):  # rather no line than no message
        scanner.scan()
    return scanner.lines


class _Scanner:
    def __init__(self, text: str) -> None:
        self.text, self.at, self.line, self.counted = text, 0, 1, 0
        self.lines: dict[Path, int] = {(): 1}
        self.entries: dict[Path, int] = {}

    def scan(self) -> None:
        """Go through the text once."""
        self._skip()
        if self.text.startswith("{", self.at):
            self._value(())
            return
        table: Path = ()
        while self.at < len(self.text):
            before = self.at
            if header := HEADER.match(self.text, self.at):
                table = self._header(header[0])
            else:
                self._pair(table)
            self._skip()
            if self.at == before:  # nothing that is known
                return

    def _skip(self) -> None:
        self.at = BLANK.match(self.text, self.at).end()

    def _note(self, path: Path) -> None:
        self.line += self.text.count("\n", self.counted, self.at)
        self.counted = self.at
        for end in range(1, len(path) + 1):
            self.lines.setdefault(path[:end], self.line)

    def _key(self) -> Path:
        """A key, dotted or not, and what stands behind it up to the value."""
        parts: list[str] = []
        while found := KEY.match(self.text, self.at):
            word = found[0]
            parts.append(json.loads(word, strict=False) if word[0] == '"' and "\\U" not in word else word.strip("\"'"))
            self.at = found.end()
            self._spaces()
            if not self.text.startswith(".", self.at):
                break
            self.at += 1
            self._spaces()
        return tuple(parts)

    def _spaces(self) -> None:
        while self.text.startswith((" ", "\t"), self.at):
            self.at += 1

    def _header(self, bracket: str) -> Path:
        start = self.at
        self.at += len(bracket)
        self._spaces()
        keys, path = self._key(), ()
        for k, key in enumerate(keys):
            path = (*path, key)
            if bracket == "[[" and k == len(keys) - 1:
                self.entries[path] = self.entries.get(path, -1) + 1
            if path in self.entries:
                path = (*path, self.entries[path])
        self.at += len(bracket)
        end, self.at = self.at, start
        self._note(path)
        self.at = end
        return path

    def _pair(self, table: Path) -> None:
        start, path = self.at, (*table, *self._key())
        end, self.at = self.at, start
        self._note(path)
        self.at = end
        self._spaces()
        if self.text.startswith(("=", ":"), self.at):
            self.at += 1
            self._skip()
            self._value(path)

    def _value(self, path: Path) -> None:
        opening = self.text[self.at : self.at + 1]
        if opening in ("[", "{"):
            self.at += 1
            self._skip()
            index = 0
            while self.at < len(self.text) and self.text[self.at] not in "]}":
                before = self.at
                if opening == "{":
                    self._pair(path)
                else:
                    self._note((*path, index))
                    self._value((*path, index))
                    index += 1
                self._skip()
                if self.at == before:
                    return
            self.at += 1
        elif found := (STRING if opening in ('"', "'") else SCALAR).match(self.text, self.at):
            self.at = found.end()


def line_of(lines: dict[Path, int], path: Path) -> int | None:
    """Find the line of a path, or of the entry that it would stand in.

    Parameters
    ----------
    lines : dict
        By `lines_of_keys`.
    path : tuple
        Keys and numbers of entries.

    Returns
    -------
    int or None
        None for a path of which not even the first key is there.
    """
    return next((lines[path[:end]] for end in range(len(path), 0, -1) if path[:end] in lines), None)


def path_of(place: str, data: Any) -> Path:
    """Read a place as messages have it.

    Parameters
    ----------
    place : str
        Such as ``supports[2].gap`` or ``combinations "hot".factors.dead``.
    data : dict
        The scene, in which entries are found by name.

    Returns
    -------
    tuple
        Keys and numbers of entries; of what cannot be read only the beginning.

    Examples
    --------
    >>> path_of('supports "R-1".law[2][0]', {"supports": [{"node": 0}, {"node": 1, "name": "R-1"}]})
    ('supports', 1, 'law', 2, 0)
    """
    try:
        pieces = pieces_of(place)
    except SceneError:
        return ()
    path: list[str | int] = []
    for piece in pieces:
        if isinstance(data, list):
            names = [one.get("name") if isinstance(one, dict) else None for one in data]
            piece = _found(piece, {name: names.index(name) for name in names if isinstance(name, str)})
            inside = data[piece] if isinstance(piece, int) and 0 <= piece < len(data) else None
        else:
            piece = _found(piece, {key: key for key in data}) if isinstance(data, dict) else piece
            inside = data.get(piece) if isinstance(data, dict) else None
        path.append(piece)
        data = inside
    return tuple(path)


def _found(piece: str | int, there: dict[str, str | int]) -> str | int:
    """The key or number that a piece stands for; messages shorten long names."""
    if piece in there or not isinstance(piece, str):
        return there.get(piece, piece)
    return next((one for name, one in there.items() if isinstance(name, str) and shown(name) == shown(piece)), piece)
