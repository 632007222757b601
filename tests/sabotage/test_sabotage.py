"""The sabotage: every change still applies to one place, all rooms have some, and a few that need no compiler are tried."""

import re
from dataclasses import replace

import pytest

from sabotage import command
from sabotage.change import TOP, Change, read_changes
from sabotage.workshop import Workshop

ROOMS = {f"fortran/{path.name}" for path in (TOP / "fortran").iterdir() if list(path.glob("*.[fF]90"))}
TRIED = ("support.settlement + SIDES[support.side]", "return text if len(text) <= 60")


def test_every_change_applies_to_exactly_one_place():
    changes = read_changes()
    assert len(changes) >= 60
    for change in changes:
        change.applied((TOP / change.file).read_text())
        assert all((TOP / "tests" / name.partition("::")[0]).exists() for name in change.tests), change
    assert len({(change.file, change.old) for change in changes}) == len(changes)


def test_all_rooms_have_changes():
    rooms = {change.room for change in read_changes()}
    python = {f"gapbeam/{path.name}" for path in (TOP / "python" / "gapbeam").iterdir() if (path / "__init__.py").exists()}
    assert rooms >= ROOMS | python


def test_a_change_that_applies_no_longer_is_told():
    change = Change("README.md", "nowhere to be found", "anything", ())
    with pytest.raises(ValueError, match="stands there 0 times"):
        change.applied("text")
    with pytest.raises(ValueError, match="is no change"):
        replace(change, new=change.old).applied(change.old)


def test_changes_are_killed_and_the_tree_is_left_alone(tmp_path):
    changes = {old: next(one for one in read_changes() if old in one.old) for old in TRIED}
    before = {change.file: (TOP / change.file).read_bytes() for change in changes.values()}
    shop = Workshop(tmp_path, compiled=False)
    tests = ("python/results/cases/test_scheme_of.py",), ("python/results/paths/test_laws.py::test_what_goes_out_as_data",)
    first, second = (replace(change, tests=those) for change, those in zip(changes.values(), tests, strict=True))
    outcome, what = shop.tried(first)
    assert outcome == "killed"
    assert what in shop.sound
    assert what.startswith("python/results/cases/test_scheme_of.py::")
    assert shop.tried(replace(second, new=second.old + "  # the same")) == ("survived", "")
    assert shop.tried(replace(second, tests=("nothing.py",)))[0] == "broken"
    assert before == {name: (TOP / name).read_bytes() for name in before}


def test_the_command_lists_and_says_what_survives(capsys):
    assert command.main(["--only", "combinations.py", "--list"]) == 0
    said = capsys.readouterr().out
    assert re.search(r"^\d+ changes in 1 rooms$", said, re.MULTILINE)
    one, other = Change("fortran/a/b.f90", "x", "y", ()), Change("fortran/a/c.f90", "x", "y", (), "no one can tell")
    assert command.said([one, other], {one: ("killed", "t"), other: ("survived", "")}, 1.0) == 1  # half are not enough
    assert command.said([one] * 20, {one: ("killed", "t")}, 1.0) == 0
    assert command.said([one], {one: ("survived", "")}, 1.0) == 1
    assert "survived: fortran/a/b.f90: x  ->  y" in capsys.readouterr().out
    assert command.said([one], {}, 1.0) == 1
