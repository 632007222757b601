"""Files: written in whole or left as they were, never over the scene or one another, and named where they cannot be written."""

import json
import os
import resource
import signal
import stat
import subprocess
import sys
import tempfile
from pathlib import Path

import gapbeam
import pytest
import studies.command
from gapbeam.base.files import write_files
from gapbeam.cli import main
from gapbeam.plots import plot

SCENE = {
    "beam": {"spans": [6.0, 6.0], "EI": 1.0e4},
    "supports": [{"node": 0}, {"node": 1, "side": "below", "gap": 0.01}, {"node": 2}],
    "loads": [{"type": "uniform", "q": 20.0}],
}
OLD = "as it was before\n"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scene.json").write_text(json.dumps(SCENE))
    return tmp_path


def command(*arguments, limit=None, **keywords):
    """Run the command in a process of its own, whose files cannot grow beyond a limit."""

    def prepare():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        if limit is not None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

    words = [sys.executable, "-m", "gapbeam", *map(str, arguments)]
    return subprocess.run(words, preexec_fn=prepare, stderr=subprocess.PIPE, text=True, **keywords)


def refused(capsys, *arguments, command=main):
    assert command([str(argument) for argument in arguments]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("\n") == 1
    return err.removeprefix("gapbeam: error: ").rstrip("\n")


# All or nothing


@pytest.mark.parametrize("option", ["--json", "--csv", "--plot", "--path"])
def test_a_full_disk_leaves_the_files_as_they_were(folder, option):
    """The file that does not fit, and the one that would have fitted."""
    name = {"--json": "a.json", "--csv": "a.csv", "--plot": "a.png", "--path": "a.png"}[option]
    other = ("--json", "b.json") if option != "--json" else ("--csv", "b.csv")
    for path in (name, other[1]):
        (folder / path).write_text(OLD)
    before = sorted(folder.iterdir())
    run = command("run", "scene.json", *other, option, name, limit=1500, stdout=subprocess.PIPE)
    assert run.returncode == 2
    assert run.stdout == ""
    assert run.stderr in [f"gapbeam: error: {path}: File too large\n" for path in (name, other[1])]
    assert sorted(folder.iterdir()) == before
    assert [(folder / path).read_text() for path in (name, other[1])] == [OLD, OLD]


def test_all_files_or_none(folder):
    (folder / "first").write_text(OLD)
    with pytest.raises(IsADirectoryError, match=str(folder)):
        write_files({"first": b"new", folder: b"new"})

    def broken():
        yield "half"
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_files({"first": b"new", "second": broken()})
    assert (folder / "first").read_text() == OLD
    assert sorted(os.listdir()) == ["first", "scene.json"]
    write_files({"first": b"new", "second": ["x", "\N{GREEK SMALL LETTER MU}"]})
    assert (folder / "first").read_bytes() == b"new"
    assert (folder / "second").read_bytes() == b"x\xce\xbc"


def test_pictures_of_the_library_are_written_in_whole(folder):
    (folder / "a.png").write_text(OLD)
    code = (
        "import resource, signal, gapbeam, gapbeam.plots as p; signal.signal(signal.SIGXFSZ, signal.SIG_IGN);"
        "r = gapbeam.solve('scene.json'); p.figure(r); resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000)); p.plot(r, 'a.png')"
    )
    run = subprocess.run([sys.executable, "-c", code], stderr=subprocess.PIPE, text=True)
    assert run.stderr.rstrip().endswith("OSError: [Errno 27] File too large: 'a.png'")
    assert (folder / "a.png").read_text() == OLD
    plot(gapbeam.solve("scene.json"), "a.png")
    assert (folder / "a.png").read_bytes().startswith(b"\x89PNG")


# What is there already


def test_a_link_stays_a_link(folder):
    (folder / "there").mkdir()
    (folder / "there" / "real").write_text(OLD)
    for link, target in (("good", "there/real"), ("dangling", "there/new")):
        (folder / link).symlink_to(target)
        write_files({link: b"new"})
        assert os.readlink(folder / link) == target
        assert (folder / target).read_bytes() == b"new"
        assert not (folder / target).is_symlink()
    assert sorted(os.listdir("there")) == ["new", "real"]


def test_permissions(folder):
    """Those of an old file stay; a new one gets what is usual."""
    (folder / "old").write_text(OLD)
    (folder / "old").chmod(0o640)
    if os.getuid() == 0:
        os.chown("old", 12, 34)
    owner = os.stat("old").st_uid, os.stat("old").st_gid
    mask = os.umask(0o027)
    write_files({"old": b"new", "new": b"new"})
    os.umask(mask)
    assert stat.S_IMODE(os.stat("old").st_mode) == 0o640
    assert (os.stat("old").st_uid, os.stat("old").st_gid) == owner
    assert stat.S_IMODE(os.stat("new").st_mode) == 0o640


@pytest.fixture
def nobody(monkeypatch):
    """A folder of a user who may not write everything."""
    with tempfile.TemporaryDirectory() as folder:
        monkeypatch.chdir(folder)
        Path("scene.json").write_text(json.dumps(SCENE))
        os.chmod(folder, 0o777)
        if os.getuid() != 0:
            yield
        else:
            os.setresuid(65534, 65534, 0)
            yield
            os.setresuid(0, 0, 0)
        os.chmod(folder, 0o777)


def test_what_may_not_be_written_is_not_replaced(nobody, capsys):
    Path("a.json").write_text(OLD)
    os.chmod("a.json", 0o444)
    assert refused(capsys, "run", "scene.json", "--json", "a.json") == '--json: no permission to write "a.json"'
    with pytest.raises(PermissionError, match=r"a\.json"):
        write_files({"a.json": b"new"})
    os.mkdir("closed")
    os.chmod("closed", 0o555)
    problem = '--json: no permission to write in the folder of "closed/a.json"'
    assert refused(capsys, "run", "scene.json", "--json", "closed/a.json") == problem
    with pytest.raises(PermissionError, match=r"closed/a\.json"):
        write_files({"closed/a.json": b"new"})


def test_devices_are_written_to(folder):
    reader, writer = os.pipe()
    write_files({f"/dev/fd/{writer}": b"new", "/dev/null": b"new"})
    assert os.read(reader, 10) == b"new"
    assert stat.S_ISCHR(os.stat("/dev/null").st_mode)
    os.close(reader)
    os.close(writer)


def test_a_full_device_has_a_name(folder, capsys):
    before = os.stat("/dev/full").st_rdev
    assert refused(capsys, "run", "scene.json", "--json", "/dev/full") == "/dev/full: No space left on device"
    assert os.stat("/dev/full").st_rdev == before


@pytest.mark.parametrize(
    "arguments",
    ["run scene.json", "run scene.json --json -", "check scene.json", "schema", "--help", "run --help", "--version"],
)
@pytest.mark.parametrize("buffer", ["", "1"])
def test_a_full_standard_output_has_a_name(folder, arguments, buffer):
    with open("/dev/full", "wb") as full:
        run = command(*arguments.split(), stdout=full, env=os.environ | {"PYTHONUNBUFFERED": buffer})
    assert (run.returncode, run.stderr) == (2, "gapbeam: error: standard output: No space left on device\n")


@pytest.mark.parametrize("arguments", [("run", "scene.json"), ("check", "scene.json")])
def test_a_closed_standard_output_is_no_failure(folder, arguments):
    words = " ".join([sys.executable, "-m", "gapbeam", *arguments])
    run = subprocess.run(["sh", "-c", f"{words} >&-"], stderr=subprocess.PIPE, text=True)
    assert (run.returncode, run.stderr) == (0, "")


def test_what_goes_to_a_closed_standard_output_is_refused(folder):
    words = " ".join([sys.executable, "-m", "gapbeam", "run", "scene.json", "--json", "-"])
    run = subprocess.run(["sh", "-c", f"{words} >&-"], stderr=subprocess.PIPE, text=True)
    assert run.returncode == 2
    assert run.stderr == "gapbeam: error: --json: standard output is closed; give the name of a file\n"


def test_a_closed_standard_error_leaves_the_status(folder):
    words = " ".join([sys.executable, "-m", "gapbeam", "check", "none.json"])
    run = subprocess.run(["sh", "-c", f"{words} 2>&-"], stdout=subprocess.PIPE, text=True)
    assert (run.returncode, run.stdout) == (2, "")


# Which file


@pytest.fixture
def spellings(folder):
    """The scene by other names."""
    (folder / "soft.json").symlink_to("scene.json")
    os.link("scene.json", "hard.json")
    (folder / "way").symlink_to(folder)
    return ["scene.json", "./scene.json", str(folder / "scene.json"), "way/scene.json", "soft.json", "hard.json"]


def test_no_output_is_the_scene(spellings, capsys):
    text = Path("scene.json").read_text()
    for scene in spellings:
        for name in spellings:
            assert refused(capsys, "run", scene, "--json", name) == f'--json: "{name}" is the scene; give another file'
    assert Path("scene.json").read_text() == text


def test_no_output_is_the_scene_on_standard_input(folder):
    with open("scene.json") as scene:
        run = command("run", "-", "--json", "scene.json", stdin=scene)
    assert run.stderr == 'gapbeam: error: --json: "scene.json" is the scene; give another file\n'
    assert json.loads(Path("scene.json").read_text()) == SCENE


@pytest.mark.parametrize("there", [True, False])
def test_no_output_is_another_one(folder, capsys, there):
    (folder / "way").symlink_to(folder)
    if there:
        (folder / "a.png").write_text(OLD)
        os.link("a.png", "b.png")
    pairs = [("a.png", "a.png"), ("a.png", "./a.png"), ("a.png", "way/a.png"), (folder / "a.png", "a.png")]
    for first, second in [*pairs, ("a.png", "b.png")] if there else pairs:
        message = refused(capsys, "run", "scene.json", "--plot", first, "--path", second)
        assert message == f'--plot, --path need different files, got "{first}" and "{second}"'


def test_no_output_is_where_the_report_goes(folder):
    with open("a.json", "w") as output:
        run = command("run", "scene.json", "--json", "a.json", stdout=output)
    assert run.returncode == 2
    assert run.stderr == 'gapbeam: error: --json: standard output goes to "a.json" already; give - or another file\n'


@pytest.mark.parametrize(
    ("study", "option", "name", "suffixes"),
    [
        (None, "--json", "a.csv", ".json"),
        (None, "--json", "a.JSON.gz", ".json"),
        (None, "--csv", "a.png", ".csv"),
        (None, "--plot", "a.json", ".png, .pdf or .svg"),
        (None, "--path", "a.toml", ".png, .pdf or .svg"),
        ("foundation", "--plot", "a.csv", ".png, .pdf or .svg"),
        ("extremes", "--csv", "a.md", ".csv"),
        ("schemes", "--markdown", "a.csv", ".md"),
        ("contact", "--markdown", "a.png", ".md"),
        ("kernel", "--csv", "a.json", ".csv"),
    ],
)
def test_a_file_of_another_format_is_refused(folder, capsys, study, option, name, suffixes):
    words = [study] if study else ["run", "scene.json"]
    message = refused(capsys, *words, option, name, command=studies.command.main if study else main)
    assert message == f'{option}: expected a file that ends in {suffixes}, got "{name}"'
    assert os.listdir() == ["scene.json"]


def test_suffixes_that_fit(folder, capsys):
    assert main(["run", "scene.json", "--quiet", "--json", "a.JSON", "--csv", "no_suffix", "--plot", "a.Svg"]) == 0
    assert sorted(os.listdir()) == ["a.JSON", "a.Svg", "no_suffix", "scene.json"]
    assert json.loads(Path("a.JSON").read_text())["status"] == "solved"


@pytest.mark.parametrize(
    ("name", "problem"),
    [
        ("x" * 300 + ".json", 'cannot write "{name}" (File name too long)'),
        ("a\0b.json", 'expected the name of a file, got "a\\x00b.json"'),
        ("scene.json/a.json", 'the folder of "{name}" does not exist'),
        ("loop.json", 'cannot write "{name}" (Too many levels of symbolic links)'),
        ("nowhere.json", 'the folder of "{name}" does not exist'),
    ],
)
def test_names_that_cannot_be(folder, capsys, name, problem):
    (folder / "loop.json").symlink_to("loop.json")
    (folder / "nowhere.json").symlink_to("none/a.json")
    assert refused(capsys, "run", "scene.json", "--json", name) == "--json: " + problem.replace("{name}", name)


# The scene from standard input


@pytest.mark.parametrize(
    ("data", "problem"),
    [
        (b'{"beam": {"EI": 1, "EI": 2}}', 'the key "EI" stands twice in one table'),
        (b"title = '\xff'", "not a text in UTF-8 (byte 10 is wrong); save it as UTF-8"),
        (b"\xef\xbb\xbftitle = '\xff'", "not a text in UTF-8 (byte 13 is wrong); save it as UTF-8"),
        (b'{"beam":' * 3000, "tables or lists are nested too deeply"),
        (b"a = " + b"[" * 3000, "tables or lists are nested too deeply"),
        (b"a." * 30_000 + b"a = 1", "tables or lists are nested too deeply"),
        (b"[beam]\nEI = " + b"9" * 5000, "a number has more than 4300 digits"),
        (b'{"a": ' + b"9" * 5000 + b"}", "a number has more than 4300 digits"),
        (b"\xff\xfea\0", "not a text in UTF-8 (byte 1 is wrong); save it as UTF-8"),
    ],
)
def test_standard_input_is_read_as_a_file_is(folder, capsys, data, problem):
    name = "a.json" if data.startswith(b"{") else "a.toml"
    (folder / name).write_bytes(data)
    assert refused(capsys, "check", name) == f"{name}: {problem}"
    with open(name, "rb") as scene:
        run = command("check", "-", stdin=scene, stdout=subprocess.PIPE)
    assert (run.returncode, run.stdout, run.stderr) == (2, "", f"gapbeam: error: standard input: {problem}\n")


@pytest.mark.parametrize("mark", [b"", b"\xef\xbb\xbf"])
@pytest.mark.parametrize("environment", [{}, {"PYTHONIOENCODING": "ascii"}, {"LC_ALL": "C", "PYTHONUTF8": "0"}])
def test_standard_input_has_the_encoding_of_a_file(folder, mark, environment):
    data = mark + json.dumps(SCENE | {"title": "Träger \N{CJK UNIFIED IDEOGRAPH-6881}"}, ensure_ascii=False).encode()
    (folder / "a.json").write_bytes(data)
    with open("a.json", "rb") as scene:
        run = command("run", "-", "--json", "b.json", "--quiet", stdin=scene, env=os.environ | environment)
    assert (run.returncode, run.stderr) == (0, "")
    assert json.loads(Path("b.json").read_text())["title"] == "Träger \N{CJK UNIFIED IDEOGRAPH-6881}"


def test_a_closed_standard_input(folder):
    words = " ".join([sys.executable, "-m", "gapbeam", "check", "-"])
    run = subprocess.run(["sh", "-c", f"{words} <&-"], stderr=subprocess.PIPE, text=True)
    assert run.returncode == 2
    assert run.stderr == "gapbeam: error: standard input: is closed; give the name of a file\n"
