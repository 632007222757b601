"""All mistakes of a scene file at once: what is wrong is put right for the time being, and the rest is checked again."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from copy import deepcopy
from time import perf_counter
from typing import Any

from ..base.errors import GapbeamError, SceneError, SceneFileError
from .files import Written
from .lines import Path, line_of, lines_of_keys, path_of
from .wording import shown

MOST, LONGEST = 20, 2.0
"""Mistakes that are told at once; seconds after which no more are looked for."""
NUMBERS = ("EI", "GA", "EA", "width")
"""Keys of the beam that any number above 0 puts right."""
HARMLESS: dict[str, Callable[[float, int, int], dict[str, Any]]] = {
    "supports": lambda length, k, n: {"x": length * (k + 1.0) / (n + 1.618), "side": "below", "stiffness": 0.0},
    "loads": lambda *_: {"type": "force", "x": 0.0, "F": 0.0},
    "foundation": lambda *_: {"k": 1.0, "side": "both"},
    "sections": lambda *_: {"EI": 1.0},
    "trains": lambda *_: {"axles": [[0.0, 1.0]]},
    "combinations": lambda *_: {"factors": {}},
}
"""Entries that stand for what is wrong: they keep their number, their name and their case."""
KEPT = ("name", "case")
MEANT = re.compile(r'did you mean "(\w+)"')
REFERENCES = {"no load is of this case": ("loads", "case"), "there is no support": ("supports", "name"),
              "there is no foundation": ("foundation", "name"), "there is no train": ("trains", "name")}  # fmt: skip
"""Problems that come of what is left out: the list and the key that others refer to."""


def all_mistakes(written: Written, first: SceneError, check: Callable[[dict[str, Any]], Any]) -> SceneFileError:
    """Find all mistakes of a file.

    Parameters
    ----------
    written : Written
        What stands in it.
    first : SceneError
        What its check has raised.
    check : callable
        The check; it raises the first mistake of the data it is given.

    Returns
    -------
    SceneFileError
        In the order of the lines.
    """
    data, found, error = deepcopy(dict(written)), [first], first
    repair = _Repair(data)
    begin = perf_counter()
    for _ in range(2 * MOST):
        if len(found) == MOST or perf_counter() - begin > LONGEST or not repair(error):
            break
        try:
            check(data)
            break
        except SceneError as another:
            error = another
        except GapbeamError:
            break
        if not repair.has_caused(error):
            found.append(error)
    lines = lines_of_keys(written.text)
    mistakes = [(line_of(lines, path_of(one.place, written)), one.place, one.problem) for one in found if not _is_meant(one, found)]
    return SceneFileError(written.name, sorted(mistakes, key=lambda one: one[0] or 0))


def _is_meant(error: SceneError, found: list[SceneError]) -> bool:
    """Whether a key is only missing because it is misspelt."""
    owner, _, key = error.place.rpartition(".")
    return "is missing" in error.problem and any(
        other.place.rpartition(".")[0] == owner and other.problem.startswith("unknown key") and f'"{key}"' in other.problem
        for other in found
    )


class _Repair:
    """Puts right what an error is about; true where the rest can be checked then."""

    def __init__(self, data: dict[str, Any]) -> None:
        self._data = data
        self._done: set[Path] = set()

    def has_caused(self, error: SceneError) -> bool:
        """Whether an error is only about what was taken away here."""
        path, problem = path_of(error.place, self._data), error.problem
        hangs_on_others = len(path) == 2 or any(words in problem for words in ("is missing", "has a gap", "with a law unloads"))
        if path in self._done or (hangs_on_others and path[:2] in {done[:2] for done in self._done}):
            return True
        if any(name in problem for name in self._changed()):
            return True
        if "nothing holds the beam" in problem:
            return any(done[0] == "supports" for done in self._done)
        return any(words in problem and self._has_lost(key, part) for words, (key, part) in REFERENCES.items())

    def _changed(self) -> Iterator[str]:
        """Entries that are not as they were, as messages name them."""
        for key, k in {done[:2] for done in self._done if len(done) > 1 and isinstance(done[1], int)}:
            yield f"{key}[{k}]"
            entry = self._data[key][k]
            if isinstance(entry, dict) and isinstance(entry.get("name"), str):
                yield f"{key} {shown(entry['name'])}"

    def _has_lost(self, key: str, part: str) -> bool:
        """Whether names or cases of a list are not all there any more."""
        return any(done[0] == key and (len(done) == 1 or done[2:] == (part,)) for done in self._done)

    def __call__(self, error: SceneError) -> bool:
        path = path_of(error.place, self._data)
        if not path:
            return False
        owner = self._owner(path)
        if error.problem.startswith("unknown key") and isinstance(owner, dict) and path[-1] in owner:
            meant = MEANT.search(error.problem)
            del owner[path[-1]]
            if meant and meant[1] not in owner:
                self._leave_out((*path[:-1], meant[1]), owner)
            return True
        if path[0] == "beam":
            return self._beam(path)
        if path[0] in HARMLESS and len(path) > 1:
            return self._entry(path)
        taken = path[:2] if isinstance(self._data.get(path[0]), dict) else path[:1]
        owner = self._owner(taken)
        if taken in self._done or not isinstance(owner, dict) or taken[-1] not in owner:
            return False
        self._done.add(taken)
        del owner[taken[-1]]
        return True

    def _leave_out(self, path: Path, owner: dict[str, Any]) -> None:
        """Take a key away; where a gap may stand beside it, the side is put right; a train without others gets an axle."""
        self._done.add(path)
        owner.pop(path[-1], None)
        if path[0] == "supports" and path[-1] == "side" and owner.get("direction") != "axial":
            owner["side"] = "below"
        if path[0] == "trains" and path[-1] == "together":
            owner.setdefault("axles", [[0.0, 1.0]])

    def _owner(self, path: Path) -> Any:
        """The table or list that the last piece of a path stands in."""
        owner: Any = self._data
        for piece in path[:-1]:
            try:
                owner = owner[piece]
            except (KeyError, IndexError, TypeError):
                return None
        return owner

    def _beam(self, path: Path) -> bool:
        beam = self._data.get("beam")
        if len(path) < 2 or path[:2] in self._done or not isinstance(beam, dict) or path[1] == "spans":
            return False  # without spans there are no places
        self._done.add(path[:2])
        if path[1] in NUMBERS:
            beam[path[1]] = 1.0
        else:
            beam.pop(path[1], None)
        return True

    def _entry(self, path: Path) -> bool:
        """Leave out the key that is wrong; where that is not enough, put a harmless entry in its place."""
        items, k = self._data[path[0]], path[1]
        if not isinstance(items, list) or not isinstance(k, int) or not 0 <= k < len(items) or path[:2] in self._done:
            return False
        entry = items[k]
        for end in range(len(path), 2, -1):  # as little as will do
            owner = self._owner(path[:end])
            if isinstance(owner, dict) and path[end - 1] in owner and path[:end] not in self._done:
                self._leave_out(path[:end], owner)
                return True
        self._done.add(path[:2])
        spans = self._data["beam"].get("spans") if isinstance(self._data.get("beam"), dict) else None
        known = isinstance(spans, list) and all(isinstance(span, int | float) for span in spans)
        kept = {key: entry[key] for key in KEPT if isinstance(entry, dict) and isinstance(entry.get(key), str)}
        if path[0] != "loads":
            kept.pop("case", None)
        items[k] = HARMLESS[path[0]](float(sum(spans)) if known else 0.0, k, len(items)) | kept
        return True
