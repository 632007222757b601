"""The list of changes: where, what, and which tests are to notice."""

import tomllib
from dataclasses import dataclass
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
LIST = Path(__file__).with_name("changes.toml")


@dataclass(frozen=True)
class Change:
    """A change of one line.

    Attributes
    ----------
    file : str
        From the top of the tree.
    old, new : str
        What stands there at exactly one place, and what is put in its place.
    tests : tuple of str
        Files of tests, from the folder of tests.
    survives : str
        Why no test can notice; empty if one has to.
    """

    file: str
    old: str
    new: str
    tests: tuple
    survives: str = ""

    @property
    def room(self):
        """Folder of the house."""
        return "/".join(self.file.removeprefix("python/").split("/")[:2])

    @property
    def is_python(self):
        """Whether nothing has to be compiled."""
        return self.file.endswith(".py")

    def applied(self, text):
        """The text of the file with the change; an error if it does not apply to exactly one place."""
        if (count := text.count(self.old)) != 1:
            raise ValueError(f"{self.file}: {self.old!r} stands there {count} times, not once")
        if self.new in ("", self.old) or "\n" in self.old + self.new:
            raise ValueError(f"{self.file}: {self.old!r} to {self.new!r} is no change of a line")
        return text.replace(self.old, self.new)


def read_changes():
    """All changes of the list, with the tests of their rooms where they name none."""
    data = tomllib.loads(LIST.read_text())
    found = []
    for row in data["change"]:
        change = Change(row["file"], row["old"], row["new"], (), row.get("survives", ""))
        tests = row.get("tests") or data["rooms"][change.room]
        found.append(Change(change.file, change.old, change.new, tuple(tests), change.survives))
    return found
