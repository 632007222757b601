"""What holds rotations in reports, pages, limits and tables: couples and angles are never told as forces and lengths."""

import re
import subprocess
import sys
from pathlib import Path

import gapbeam
import pytest
from gapbeam.cli import main
from gapbeam.report.text import report_text

CHECKER = Path(__file__).resolve().parents[3] / "oracle" / "checkers" / "proof_checker.py"
SCENE = {
    "units": {"force": "kN", "length": "m"},
    "beam": {"spans": [4.0, 4.0], "EI": 1e4},
    "supports": [{"node": 0, "name": "A", "rotation": {"slack": 0.001}}, {"node": 1, "side": "below"},
                 {"node": 2, "rotation": {"side": "clockwise", "stiffness": 4e6}}],
    "hinges": [{"x": 2.0, "slack": 0.0005}],
    "loads": [{"type": "uniform", "q": 10.0}, {"type": "uniform", "q": 4.0, "case": "dead"}],
}  # fmt: skip


def test_limits_of_reactions_know_no_couples():
    """A couple greater than every reaction, and an angle where an opening is limited."""
    scene = {**SCENE, "loads": [{"type": "moment", "x": 3.9, "M": 900.0}], "limits": {"reaction": 10.0, "opening": 1.0}}
    result = gapbeam.solve(scene)
    step = result.steps[-1]
    assert abs(step.reaction[3:]).max() > abs(step.reaction[:3]).max()
    assert abs(result.utilisations["reaction"].value) == pytest.approx(abs(step.reaction[:3]).max(), rel=1e-12)
    assert result.utilisations["opening"].support in (None, 0, 1, 2)


def test_report():
    text = report_text(gapbeam.solve(SCENE), verbose=True)
    sums = re.search(r"Sum of reactions\s+(\S+) kN.*\nSum of loads\s+(\S+) kN", text)
    assert sums[1] == sums[2] == "112"
    assert "1 one-sided from below, 2 of a rotation with a law, 1 hinges with a law" in " ".join(text.split())
    assert "hinges, rotational" not in " ".join(text.split())
    table = text[text.index("Rotations at load factor 1") :]
    assert re.search(r"rotation of A\s+0\s+both\s+1 segment 1\s+\S+\s+0\.001", table)


def test_sets_and_slacks_of_rotations_are_told_with_rotations():
    """A joint that has yielded keeps (14 - 10)/300 - 0.01; supports across the beam have no column of zeros for it."""
    joint = {"law": [[0.01, 10.0], [1.0, 10.0]], "unloading": "plastic"}
    text = report_text(gapbeam.solve({
        "beam": {"spans": [1.0], "EI": 100.0},
        "supports": [{"node": 0, "rotation": joint}, {"node": 1, "rotation": {"slack": 0.5}}],
        "loads": [{"type": "moment", "node": 0, "M": 14.0}], "analysis": {"follow": "events", "history": [1.0, 0.0]},
    }))  # fmt: skip
    supports, rotations = text[text.index("Supports at") :].split("Rotations at")
    heads = next(line for line in supports.splitlines() if "side" in line)
    assert "set" not in heads
    assert "opening" not in heads
    lines = rotations.splitlines()
    row = next(k for k, line in enumerate(lines) if "side" in line)
    joint = next(line for line in lines if "segment 1" in line)
    assert [line.split()[-1] for line in lines[row - 1 : row + 1]] == ["set", "rad"]
    assert joint.split()[-1] == "0.0033333"


def test_combinations_tell_couples_apart():
    combinations = [{"name": "a", "factors": {"dead": 1.0, "live": 1.0}}, {"name": "b", "factors": {"dead": 1.0, "live": -1.0}}]
    result = gapbeam.solve({**SCENE, "combinations": combinations})
    text = report_text(result)
    assert "Couples by combination [kN m]" in text
    reactions = text[text.index("Reactions by combination") : text.index("Couples by combination")]
    assert "hinge 0" not in reactions
    assert "rotation of A" not in reactions


def test_page_adds_up(tmp_path):
    page = tmp_path / "page.html"
    gapbeam.solve(SCENE).to_html(page)
    words = re.sub(r"\s+", " ", re.sub(r"<[^>]+>", " ", re.sub(r"<script.*?</script>", "", page.read_text(), flags=re.DOTALL)))
    assert "reaction rotation of A" not in words
    assert re.search(r"With all digits Σ V leaves \S*e-1\d|With all digits .* exactly", words)


def test_proofs_are_not_decided(tmp_path):
    scene, proof = tmp_path / "scene.json", tmp_path / "proof.json"
    import json

    scene.write_text(json.dumps(SCENE))
    assert main(["prove", str(scene), "-o", str(proof)]) == 0
    done = subprocess.run([sys.executable, CHECKER, proof], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout.split(":")[0]) == (2, "not decided")


def test_the_study_refuses_it(tmp_path, capsys):
    import json

    scene = tmp_path / "scene.json"
    scene.write_text(json.dumps(SCENE))
    assert main(["study", "accuracy", str(scene)]) != 0
    assert "does not know restraints and hinges with laws" in capsys.readouterr().err


def test_while_trains_pass():
    scene = {
        "units": {"force": "kN", "length": "m"}, "beam": {"spans": [9.0, 12.0, 9.0], "EI": 3e5},
        "hinges": [{"x": 12.0, "stiffness": 2e4, "slack": 0.0005, "name": "splice"}],
        "supports": [{"node": 0, "side": "below"}, *({"node": k} for k in (1, 2, 3))],
        "trains": [{"name": "a", "axles": [[0.0, 90.0]]}],
    }  # fmt: skip
    result = gapbeam.solve(scene)
    table = result.report().partition("Supports while trains pass")[2].partition("What changes")[0]
    couple, angle = (result.envelope().supports[4][name]["max"].value for name in ("reaction", "opening"))
    assert re.search(rf"4 splice \[kN m, rad\]\s+largest\s+{couple:.5g}\s", table)
    assert re.search(rf"opening\s+{angle:.5g}\s+a at", table.partition("splice")[2])
    assert angle <= 0.0011
