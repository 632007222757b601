"""A folder of a batch comes from anywhere: what it says is checked, no link in it is followed, nothing is written beside it."""

import json
import os
import shutil
from pathlib import Path

import gapbeam
import numpy as np
import pytest
from gapbeam.batches import chunks
from gapbeam.cli import main

SCENE = {
    "beam": {"spans": [6.0, 6.0], "EI": 1e4},
    "supports": [{"node": 0}, {"node": 1, "side": "below", "gap": 0.01}, {"node": 2}],
    "loads": [{"type": "uniform", "q": 20.0}],
}
CASES, IN_A_FILE = 50, 20


@pytest.fixture(params=chunks.FORMATS)
def there(request, tmp_path, monkeypatch):
    """A folder of fifty cases, and the names of scene and table beside it."""
    if request.param == "parquet":
        pytest.importorskip("pyarrow")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("gapbeam.batches.run.best_format", lambda: request.param)
    Path("scene.json").write_text(json.dumps(SCENE))
    Path("table.csv").write_text("supports[1].gap\n" + "".join(f"{0.0004 * k}\n" for k in range(CASES)))
    gapbeam.batch("scene.json", "table.csv", "out", chunk=IN_A_FILE)
    return Path("out")


def again(*options):
    return main(["batch", "scene.json", "table.csv", "--out", "out", "--jobs", "1", "--quiet", *options])


def refused(capsys, *words):
    """Both commands say in one line what is wrong, and write nothing."""
    for command in (again, lambda: main(["batch", "--summary", "out", "--quiet"])):
        before = {one: os.lstat(one).st_mtime_ns for one in sorted(Path().rglob("*")) if one.name != ".lock"}
        assert command() == 2
        out, err = capsys.readouterr()
        assert out == ""
        assert err.startswith("gapbeam: error: out")
        assert err.count("\n") == 1
        for word in words:
            assert word in err
        assert {one: os.lstat(one).st_mtime_ns for one in sorted(Path().rglob("*")) if one.name != ".lock"} == before


WRONG = {
    "format": ["../../../escaped.txt", "csv", 5, None, ["npy"]],
    "cases": [7.0, "50", True, None, [], -1, 0],
    "chunk": [0, -5, 1.5, "20"],
    "chunks": [1e9, 10**9, 2, 4, None, False],
    "inputs": ["supports[1].gap", [1], None, {}],
    "want": [5, ["moment", None]],
    "columns": [{"a": 1}, "moment.max"],
    "supports": [3, [["a"]]],
    "scene": [5, None, []],
    "table": [5, {}],
    "gapbeam": [None, 0.4],
    "writer": [[], 3],
    "data": [5, [1], "scene"],
}


@pytest.mark.parametrize("key", WRONG)
def test_what_no_batch_writes_is_refused(there, capsys, key):
    manifest = json.loads((there / "_manifest.json").read_text())
    for value in WRONG[key]:
        (there / "_manifest.json").write_text(json.dumps({**manifest, key: value}))
        refused(capsys, f"_manifest.json, {key}: expected ", "give --out another folder")
    del manifest[key]
    (there / "_manifest.json").write_text(json.dumps(manifest))
    refused(capsys, f"does not say {key}")


OTHERS = {
    "cases": ({"cases": 47}, "says that there are 47 cases, and the table has 50"),
    "fewer files": ({"cases": 7, "chunks": 1}, "says that there are 7 cases, and the table has 50"),
    "endless": ({"cases": 10**12, "chunk": 1, "chunks": 10**12}, "says that there are 1000000000000 cases, and the table has 50"),
    "inputs": ({"inputs": ["beam.EI"]}, "says that the table has the columns beam.EI, and it has supports[1].gap"),
    "want": ({"want": ["input", "moment"]}, "says that input, moment is wanted, and it is input, reaction, opening"),
    "supports": ({"supports": ["0", "1"]}, "names other supports (0, 1)"),
    "columns": ({"columns": ["../../x"]}, "holds other columns (../../x)"),
    "data": ({"data": None}, "says that the scene is another one"),
    "scene": ({"scene": "0"}, "holds results of another scene"),
    "table": ({"table": "0"}, "holds results of another table"),
    "writer": ({"writer": "pyarrow 1"}, "was written with pyarrow 1"),
}


@pytest.mark.parametrize("name", OTHERS)
def test_what_another_batch_would_have_written_is_refused(there, capsys, name):
    change, words = OTHERS[name]
    manifest = json.loads((there / "_manifest.json").read_text())
    (there / "_manifest.json").write_text(json.dumps({**manifest, **change}))
    assert again() == 2
    assert words in capsys.readouterr().err


@pytest.mark.parametrize("text", ["[]", "null", "7", '"x"', "{}", "{", "", "[" * 100_000, "NaN", '{"format": "npy"}', "\xff"])
def test_a_manifest_that_is_none(there, capsys, text):
    (there / "_manifest.json").write_text(text, encoding="latin-1")
    refused(capsys, "_manifest.json")


def test_cases_that_are_not_there_are_not_counted(there, capsys):
    """The manifest says less than the files hold."""
    manifest = json.loads((there / "_manifest.json").read_text())
    (there / "_manifest.json").write_text(json.dumps({**manifest, "cases": 7, "chunks": 1}))
    assert main(["batch", "--summary", "out"]) == 2
    assert "holds 20 cases, and should hold 7" in capsys.readouterr().err


LINKS = {
    "link": lambda part: part.symlink_to("/etc/passwd"),
    "link to a part": lambda part: part.symlink_to(shutil.copy("spare", "elsewhere")),
    "pipe": os.mkfifo,
    "folder": Path.mkdir,
}


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes here")
@pytest.mark.parametrize("name", LINKS)
def test_nothing_but_files_is_opened(there, capsys, name):
    part = min(there.glob("part-000001.*"))
    part.rename("spare")
    LINKS[name](part)
    refused(capsys, part.name, "it is a link" if "link" in name else "it is no file")
    part.rmdir() if name == "folder" else part.unlink()
    assert again() == 0
    assert part.read_bytes() == Path("spare").read_bytes()


def test_links_are_not_written_through(there):
    """Neither in the place of a file, nor under the name that it has before it is complete."""
    Path("mine").write_text("as it was")
    part = min(there.glob("part-000001.*"))
    part.unlink()
    (there / f".{part.name}").symlink_to(Path("mine").absolute())
    (there / "._manifest.json").symlink_to(Path("mine").absolute())
    assert again() == 0
    assert part.is_file()
    (there / "_manifest.json").unlink()
    for one in there.glob("part-*"):
        one.unlink()
    assert again() == 0
    assert Path("mine").read_text() == "as it was"


@pytest.mark.parametrize("name", ["_manifest.json", ".lock"])
def test_other_files_are_no_links(there, capsys, name):
    (there / name).unlink(missing_ok=True)
    (there / name).symlink_to(Path("elsewhere").absolute())
    assert again() == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert not Path("elsewhere").exists()


def rewritten(part, change):
    """Write the columns of a file again, some of them changed."""
    names = gapbeam.Batch("out").columns
    found = {name: column.astype("S") if column.dtype == object else column
             for name, column in chunks.read_columns(part, names).items()}  # fmt: skip
    part.unlink()
    change(found)
    part.write_bytes(chunks.encode(found, part.suffix[1:]))


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda found: found.update({name: column[:7] for name, column in found.items()}), "holds 7 cases, and should hold 20"),
        (lambda found: found.pop("status"), "cannot be read"),
        (lambda found: found.update({"moment.max": np.array([b"x"] * IN_A_FILE)}), "moment.max holds no numbers"),
    ],
    ids=["fewer cases", "no status", "a text for a number"],
)
def test_a_part_that_is_another_one(there, capsys, change, words):
    rewritten(min(there.glob("part-000001.*")), change)
    assert main(["batch", "--summary", "out"]) == 2
    assert words in capsys.readouterr().err


def test_junk_is_refused(there, capsys):
    for junk in (b"", b"PAR1", b"\x93NUMPY\x01\x00\xff\xff{'descr': '<f8'", os.urandom(4000)):
        min(there.glob("part-000001.*")).write_bytes(junk)
        refused(capsys, "cannot be read", "remove it and start the batch again")
