"""Tables in CSV: names of columns in the first line, then a case a line."""

from __future__ import annotations

import csv
import hashlib
import io
import re
from contextlib import suppress
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from warnings import catch_warnings, simplefilter

import numpy as np

from ..base.errors import SceneError
from ..scene.wording import below, beyond, out_of_range, shown

BLOCK = 2**22
"""Bytes that are looked through at a time."""
EVERY = 1024
"""Every so many lines their place in the file is kept."""
TINY = re.compile(rb"[eE]-[0-9]*[1-9][0-9][0-9]|0{200}")
"""In what is written so a number may be, of which doubles make zero."""
RETURN = "a carriage return that ends no line"


@dataclass(frozen=True)
class CsvRows:
    """Some lines of a CSV file."""

    text: bytes
    names: tuple[str, ...]
    count: int

    def __len__(self) -> int:
        """Count the rows."""
        return self.count

    def columns(self) -> tuple[np.ndarray, dict[int, str]]:
        """Make numbers of the lines, columns by rows, and say what is wrong with lines that are none."""
        text = self.text.decode("utf-8", "replace")
        try:
            with catch_warnings():
                simplefilter("ignore")  # of no rows
                found = np.loadtxt(io.StringIO(text), delimiter=",", ndmin=2, comments=None)
            # What is infinite has to be written so, not as 1e400, and what is zero not as 1e-400
            are_written = np.isinf(found).sum() == self.text.lower().count(b"inf")
            are_written = are_written and not ((found == 0.0).any() and TINY.search(self.text))
            if found.shape == (self.count, len(self.names)) and are_written:
                return np.ascontiguousarray(found.T), {}
        except ValueError:
            pass
        return self._one_by_one(text)

    def _one_by_one(self, text: str) -> tuple[np.ndarray, dict[int, str]]:
        values, problems = np.full((len(self.names), self.count), np.nan), {}
        lines = (line for line in text.split("\n") if line.rstrip("\r"))
        for row, line in enumerate(lines):
            try:
                cells = next(csv.reader([line.rstrip("\r")]), [])
            except csv.Error:
                problems[row] = f"the line holds {RETURN}"
                continue
            if len(cells) != len(self.names):
                problems[row] = f"the line has {len(cells)} values, and the table {len(self.names)} columns"
                continue
            for k, cell in enumerate(cells):
                try:
                    value = float(cell.replace("_", "x"))  # Python's own digits 1_000 are nobody else's
                except ValueError:
                    problems.setdefault(row, f"{self.names[k]}: expected a number, got {shown(cell)}")
                    continue
                if problem := out_of_range(cell.strip(), value):
                    problems.setdefault(row, f"{self.names[k]}: {problem}")
                else:
                    values[k, row] = value
        return values, problems


class CsvTable:
    """A CSV file, read some lines at a time.

    Parameters
    ----------
    path : pathlib.Path
        The file; numbers with a decimal point, separated by commas.

    Raises
    ------
    SceneError
        It cannot be read, or its first lines are no table.
    """

    def __init__(self, path: Path):
        self._path, self._quoted = path, False
        digest = hashlib.sha256()
        self.cases, self._places = 0, []
        try:
            with open(path, "rb") as stream:
                header = stream.readline()
                digest.update(header)
                self.names = self._header(header)
                place, rest = stream.tell(), b""
                while block := stream.read(BLOCK):
                    digest.update(block)
                    self._quoted = self._quoted or b'"' in block
                    place, rest = self._count(place, rest + block)
                if rest.strip(b"\r"):
                    self._note(np.array([place]))
        except OSError as error:
            problem = "there is no such file" if isinstance(error, FileNotFoundError) else f"cannot be read ({error.strerror})"
            raise SceneError(str(path), problem) from None
        self.digest = digest.hexdigest()
        if self._quoted:
            self._refuse_broken_cells()
        if not self.cases:
            raise SceneError(str(path), "the table has no row; give a case a line below the names of the columns")
        problems = self.rows(0, 1).columns()[1]
        if problems and not problems[0].endswith((' got ""', beyond(""), below(""))):  # these are mistakes of the case alone
            raise SceneError(f"{path}, first case", f"{problems[0]}; separate values by commas, and write numbers with a point")

    def rows(self, first: int, stop: int) -> CsvRows:
        """Give the lines from first to stop, which is left out."""
        with open(self._path, "rb") as stream:
            stream.seek(self._places[first // EVERY])
            lines = (line for line in stream if line.strip(b"\r\n"))
            found = list(islice(lines, first % EVERY, first % EVERY + stop - first))
        if len(found) < stop - first:
            raise SceneError(str(self._path), "has become shorter while it was read; leave the table as it is until the batch ends")
        return CsvRows(b"".join(found), self.names, stop - first)

    def _header(self, line: bytes) -> tuple[str, ...]:
        try:
            cells = next(csv.reader([line.decode("utf-8-sig").strip()]), [])
        except UnicodeDecodeError:
            raise SceneError(f"{self._path}, first line", "not a text in UTF-8") from None
        except csv.Error:
            raise SceneError(f"{self._path}, first line", f"holds {RETURN}; write each case on a line of its own") from None
        self._refuse_broken_cell(1, line)
        if not cells:
            raise SceneError(f"{self._path}, first line", "expected the names of the columns, such as supports.R-104.gap")
        return tuple(cell.strip() for cell in cells)

    def _refuse_broken_cells(self) -> None:
        """Refuse what would be taken as two cases, and give all later ones another number."""
        with open(self._path, "rb") as stream:
            for number, line in enumerate(stream, 1):
                self._refuse_broken_cell(number, line)

    def _refuse_broken_cell(self, number: int, line: bytes) -> None:
        with suppress(csv.Error):  # which is told where the line is read
            if line.count(b'"') % 2 and len(list(csv.reader([line.decode("utf-8-sig", "replace"), "next"]))) == 1:
                problem = "a quoted cell continues in the next line; write each case on one line"
                raise SceneError(f"{self._path}, line {number}", problem)

    def _count(self, place: int, block: bytes) -> tuple[int, bytes]:
        """Count whole lines that are not empty; give the place of the first line that goes on, and its beginning."""
        text = np.frombuffer(block, dtype=np.uint8)
        ends = np.flatnonzero(text == 10)
        if not len(ends):
            return place, block
        starts = np.concatenate(([0], ends[:-1] + 1))
        length = ends - starts
        empty = (length == 0) | ((length == 1) & (text[starts] == 13))
        self._note(place + starts[~empty])
        return place + int(ends[-1]) + 1, block[ends[-1] + 1 :]

    def _note(self, places: np.ndarray) -> None:
        """Keep where some of the lines begin."""
        first = -self.cases % EVERY
        self._places.extend(places[first::EVERY].tolist())
        self.cases += len(places)
