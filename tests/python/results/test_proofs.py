"""Proofs: what `gapbeam prove` writes is decided by the checkers, which share nothing with it."""

import copy
import json
import random
import subprocess
import sys
from pathlib import Path

import gapbeam
import pytest
from gapbeam.cli import main
from gapbeam.results.proof import proof_data
from scenes import at, force, foundation, random_scene, scene, uniform
from scenes.law import law_scene

TOP = Path(__file__).resolve().parents[3]
PROVED, REFUTED, NOT_DECIDED = range(3)
KNOWN = ["crane_runway", "lift_off_events", "paper_beam", "paper_beam_printed_load", "pipe_rack", "pipe_rack_states",
         "shaft_clearance", "shaft_jack_up", "snap_through", "three_spans",
         "rail_lift_off", "seabed_pipe", "slab_on_mound", "strip_footing"]  # fmt: skip
NOT_KNOWN = ["pile_head", "rubber_stops", "laterally_loaded_pile", "pile_in_sand", "pile_in_layers"]  # laws that are curves
FREE = "moves freely"

pytest.importorskip("flint", reason="the checkers need python-flint")
import proof_checker  # noqa: E402
import proof_checker_ground  # noqa: E402
from attack import proofs  # noqa: E402
from studies import proof_times  # noqa: E402


@pytest.fixture
def check(tmp_path, capsys):
    """Give the exit status of the checker and its last line."""

    def run(data):
        path = tmp_path / "proof.json"
        path.write_text(json.dumps(data))
        on_ground = data["scene"].get("foundation")
        status = proof_checker.main(path, proof_checker_ground.decide_on_ground if on_ground else proof_checker.decide)
        return status, capsys.readouterr().out.strip()

    return run


@pytest.mark.parametrize("ground", [[], [{"k": 10.0}], [{"k": 10.0, "side": "below"}]])
def test_hinges_with_a_stiffness_are_not_decided(check, ground):
    """Right states were refuted, since such hinges were taken for none."""
    made = scene([3.0, 2.0], [at(0), at(1), at(2)], [force(1.0, 5.0)], EI=100.0)
    status, line = check(proof_data({**made, "hinges": [{"x": 4.0, "stiffness": 50.0}], "foundation": ground}))
    assert status == 2
    assert "does not know elastic hinges" in line


def error_of(line):
    return float(line.split("largest error ")[1].partition(";")[0])


def flipped(data, rng):
    """The same with the state of one support changed, and that support; None where none can be."""
    changes = []
    for i, state in enumerate(data["states"]):
        if state.startswith("branch"):
            k = int(state[7:])
            changes += [(i, f"branch {k + 1}"), (i, f"branch {k - 1}" if k > 1 else "open")]
        elif state != "bilateral":
            law = "law" in data["scene"]["supports"][i]
            changes.append((i, "open" if state == "closed" else "branch 1" if law else "closed"))
    if not changes:
        return None
    i, state = rng.choice(changes)
    new = copy.deepcopy(data)
    new["states"][i] = state
    return new, i


def three_spans():
    supports = [at(i, side="below", gap=0.002 * (i == 2)) for i in range(4)]
    return scene([6.0, 6.0, 6.0], supports, [uniform(2.0, case="dead"), force(3.0, 160.0)], EI=1e4)


@pytest.mark.parametrize("family", ["plain", "hardening"])
def test_random_schemes_are_proved_and_refuted_with_one_state_flipped(family, check):
    counts = {}
    for seed in range(250):
        rng = random.Random(seed)
        made = random_scene(rng) if family == "plain" else law_scene(rng, family, alone=None)
        try:
            data = proof_data(made)
        except gapbeam.SceneError:
            counts["no way to full load", None] = counts.get(("no way to full load", None), 0) + 1
            continue
        status, line = check(data)
        free = status == NOT_DECIDED and FREE in line and gapbeam.solve(data["scene"]).steps[-1].indifferent
        assert status == PROVED or free, (seed, line)
        counts[data["status"], status] = counts.get((data["status"], status), 0) + 1
        if free or data["status"] != "solved":
            continue
        assert error_of(line) < 1e-14, (seed, line)
        change = flipped(data, rng)
        if change is None:
            continue
        status, line = check(change[0])
        # What touches without force may be called closed or open, and a scheme may leave a part free
        touching = float.fromhex(data["values"]["reaction"][change[1]]) == 0.0
        assert status == REFUTED or (status == PROVED and touching) or (status == NOT_DECIDED and FREE in line), (seed, line)
        counts["flipped", status] = counts.get(("flipped", status), 0) + 1
    assert counts.get(("no way to full load", None), 0) < 5
    assert counts["solved", PROVED] > 150
    assert counts["flipped", REFUTED] > 130
    assert counts["flipped", REFUTED] > 9 * sum(counts.get(("flipped", status), 0) for status in (PROVED, NOT_DECIDED))
    if family == "plain":
        assert counts["no-equilibrium", PROVED] > 30


def test_a_motion_the_wrong_way_proves_nothing(check):
    found = 0
    for seed in range(150):
        data = proof_data(random_scene(random.Random(seed)))
        if data["status"] != "no-equilibrium":
            continue
        data["motion"] = [(-float.fromhex(w)).hex() for w in data["motion"]]
        assert check(data)[0] == REFUTED
        data["motion"] = ["0x0p+0"] * len(data["motion"])
        assert check(data)[0] == REFUTED
        found += 1
    assert found > 20


def test_a_motion_that_supports_hinder_proves_nothing(check):
    data = proof_data(scene([4.0], [at(0)], [force(3.0, 1.0)], EI=5.0))
    assert check(data) == (PROVED, "proved with 64 bits and rationals, largest error 0; nothing holds it")
    data["scene"]["supports"].append({"node": 1, "side": "below"})
    assert check(data) == (REFUTED, "refuted: supports hinder the motion")


def test_how_far_values_are_off(check):
    data = proof_data(three_spans())
    assert data["states"] == ["closed", "closed", "open", "closed"]
    status, line = check(data)
    assert status == PROVED
    assert error_of(line) < 4e-16
    data["values"]["reaction"][1] = (119.75 * (1 + 2.0**-40)).hex()
    status, line = check(data)
    assert status == PROVED
    assert error_of(line) == pytest.approx(2.0**-40, rel=0.06)
    data["values"]["reaction"][1] = (119.75 * (1 + 2.0**-20)).hex()
    assert check(data) == (REFUTED, "refuted: the states are right, but values are off by 9.5e-07 of the largest")
    data = proof_data(three_spans())
    data["values"]["deflection"][2] = (-0.02431).hex()
    assert check(data)[0] == REFUTED


def test_a_tie_is_decided_in_rationals(check):
    """The middle support touches without force, exactly: 5 q L^4 / (384 EI) is the gap."""
    data = proof_data(scene([2.0, 2.0], [at(0), at(1, side="below", gap=0.3125), at(2)], [uniform(3.0)], EI=32.0))
    for state in ("open", "closed"):
        data["states"][1] = state
        status, line = check(data)
        assert status == PROVED
        assert "rationals" in line
    data["scene"]["supports"][1]["gap"] *= 1 + 2.0**-52
    assert check(data)[0] == REFUTED


@pytest.mark.parametrize("law", [[[0.0, 2.0]], [[0.5, 2.0]], [[0.5, 2.0], [1.0, 9.0]]])
@pytest.mark.parametrize("F", [-100.0, 100.0])
def test_a_law_of_both_sides_is_mirrored_and_its_last_piece_goes_on(law, F, check):
    data = proof_data(scene([2.0, 2.0], [at(0), at(1, law=law), at(2)], [force(2.5, F)], EI=20.0))
    assert data["states"][1] == f"branch {len(law)}"
    assert check(data)[0] == PROVED
    data["states"][1] = f"branch {3 - len(law)}"
    assert check(data)[0] == REFUTED


def test_what_the_checker_does_not_know(check):
    data = proof_data(three_spans())
    for change in (
        lambda d: d["scene"]["supports"][0].update(friction=0.3),
        lambda d: d["scene"].update(foundation=[{"k": [5.0, 6.0]}]),
        lambda d: d["scene"].update(foundation=[{"k": 5.0, "shear": 1.0}]),
        lambda d: d["scene"]["loads"].append({"type": "axial", "node": 0, "F": 1.0}),
        lambda d: d["scene"]["supports"].append({"node": 0, "direction": "axial"}),
        lambda d: d["scene"]["supports"][0].update(law={"type": "tanh", "stiffness": 5.0, "limit": 1.0}),
        lambda d: d["scene"]["supports"][0].update(law=[[1.0, 1.0]], unloading="plastic"),
        lambda d: d.update(format="gapbeam-proof 2"),
        lambda d: d["states"].pop(),
        lambda d: d.pop("values"),
    ):
        new = copy.deepcopy(data)
        change(new)
        status, line = check(new)
        assert status == NOT_DECIDED
        assert line.startswith("not decided: ")
    new = copy.deepcopy(data)
    new["states"][0] = "bilateral"
    assert check(new)[0] == REFUTED


def test_the_state_at_a_factor_and_of_a_combination(check, tmp_path):
    out = str(tmp_path / "p.json")
    light, heavy = {"name": "light", "factors": {"dead": 1.0, "live": 0.1}}, {"name": "heavy", "factors": {"live": 2.0}}
    (tmp_path / "scene.json").write_text(json.dumps(three_spans() | {"combinations": [light, heavy]}))
    for options, states in (
        ([], ["closed", "closed", "open", "open"]),
        (["--combination", "light"], ["closed"] * 4),
        (["--combination", "heavy", "--factor", "0.01"], ["closed", "closed", "open", "open"]),
    ):
        assert main(["prove", str(tmp_path / "scene.json"), "-o", out, *options]) == 0
        data = json.loads(Path(out).read_text())
        assert list(data) == ["format", "scene", "status", "states", "values", "motion", "zones"]
        assert data["states"] == states
        assert check(data)[0] == PROVED
    assert main(["prove", str(tmp_path / "scene.json"), "-o", out, "--combination", "none"]) == 2
    assert main(["prove", str(tmp_path / "scene.json"), "-o", out, "--factor", "nan"]) == 2


@pytest.mark.parametrize("name", [*KNOWN, *NOT_KNOWN])
def test_examples(name, tmp_path):
    out = str(tmp_path / "p.json")
    assert main(["prove", str(TOP / "examples" / f"{name}.toml"), "-o", out]) == 0
    assert main(["check-proof", out]) == (PROVED if name in KNOWN else NOT_DECIDED)


def moved(x, by):
    return (float.fromhex(x) + by).hex()


def test_zones_on_the_ground(check):
    data = proof_data(TOP / "examples" / "rail_lift_off.toml")
    assert len(data["zones"]) == 3
    status, line = check(data)
    assert status == PROVED
    assert error_of(line) < 1e-15
    for by in (1e-6, -1e-6):
        for i, j in ((0, 2), (1, 1), (1, 2), (2, 1), (0, 1), (2, 2)):
            new = copy.deepcopy(data)
            new["zones"][i][j] = moved(new["zones"][i][j], by)
            before_the_beam = (i, j, by) == (0, 1, -1e-6)
            assert check(new)[0] in ((REFUTED, NOT_DECIDED) if before_the_beam else (REFUTED,)), (i, j, by)
    for i in range(3):
        new = copy.deepcopy(data)
        del new["zones"][i]
        assert check(new)[0] == REFUTED
    new = copy.deepcopy(data)
    new["zones"][0][2] = new["zones"][1][1]  # two zones are one
    assert check(new)[0] == REFUTED
    for zone in ([1, *data["zones"][0][1:]], data["zones"][0]):
        assert check(data | {"zones": [*data["zones"], zone]})[0] == REFUTED
    assert check(data | {"zones": [*data["zones"], [0, "0x1.4p+3", "0x1.4p+3"]]})[0] == NOT_DECIDED  # touches
    new = copy.deepcopy(data)
    new["scene"]["loads"][1]["F"] *= 1 + 1e-6
    assert check(new)[0] == REFUTED


def test_values_and_supports_on_the_ground(check):
    """A clamped end, a spring above the ground, shear, a profile: deflections and reactions of supports."""
    supports = [at(0, rotation="fixed"), at(1, side="below", stiffness=900.0), at(2)]
    made = scene([3.0, 4.0], supports, [uniform(2.0), force(1.5, 40.0)], EI=800.0)
    made["beam"]["GA"] = 5e3
    made["foundation"] = [{"k": 300.0, "side": "below", "from": 0.5, "profile": [[0.5, 0.002], [4.0, 0.01], [6.5, -0.001]]}]
    data = proof_data(made)
    status, line = check(data)
    assert status == PROVED
    assert error_of(line) < 1e-14
    new = copy.deepcopy(data)
    new["scene"]["foundation"][0]["k"] = [[0.0, 300.0]]
    assert check(new)[0] == NOT_DECIDED  # a table
    for kind in ("deflection", "reaction"):
        new = copy.deepcopy(data)
        new["values"][kind][1] = (float.fromhex(new["values"][kind][1]) * (1 + 1e-6)).hex()
        assert check(new)[0] == REFUTED
    new = copy.deepcopy(data)
    new["states"][1] = "open" if new["states"][1] == "closed" else "closed"
    assert check(new)[0] == REFUTED


def test_random_beams_on_the_ground_are_proved_and_refuted_with_an_end_moved(check):
    counts, seed = {}, -1
    while sum(n for (kind, _), n in counts.items() if kind == "right") < 60:
        seed += 1
        made = foundation.random_scene(seed)
        if any("law" in ground for ground in made["foundation"]):
            continue
        data = proof_data(made)
        status, line = check(data)
        assert status in (PROVED, NOT_DECIDED), (seed, line)
        counts["right", status] = counts.get(("right", status), 0) + 1
        if status != PROVED:
            continue
        assert error_of(line) < 1e-14, (seed, line)
        ends = {x for ground in data["scene"]["foundation"] for x in (ground["from"], ground.get("to", sum(made["beam"]["spans"])))}
        zones = data["zones"]
        for i, j in ((i, j) for i in range(len(zones)) for j in (1, 2) if float.fromhex(zones[i][j]) not in ends):
            new = copy.deepcopy(data)
            new["zones"][i][j] = moved(zones[i][j], 1e-6)
            status, line = check(new)
            assert status == REFUTED, (seed, line)
            counts["moved", status] = counts.get(("moved", status), 0) + 1
    assert counts["right", PROVED] >= 20
    assert counts["moved", REFUTED] >= 20


def test_where_the_load_ends(tmp_path, capsys):
    law = [[0.1, 1.0], [0.2, 0.5], [0.3, 0.0], [0.4, 0.0]]
    made = scene([2.0], [at(0), at(1, side="below", law=law)], [force(1.0, 9.0)])
    (tmp_path / "s.json").write_text(json.dumps(made))
    assert main(["prove", str(tmp_path / "s.json"), "-o", str(tmp_path / "p.json"), "--factor", "7.5"]) == 2
    assert "factor" in capsys.readouterr().err


def test_commands_say_what_is_missing(tmp_path, monkeypatch, capsys):
    (tmp_path / "p.json").write_text(json.dumps(proof_data(three_spans())))
    monkeypatch.chdir(tmp_path)
    assert main(["check-proof", "p.json"]) == 2
    assert "run this there" in capsys.readouterr().err
    monkeypatch.chdir(TOP / "docs")
    assert main(["check-proof", str(tmp_path / "p.json")]) == 0
    (tmp_path / "other.json").write_text("[]")
    assert main(["check-proof", str(tmp_path / "other.json")]) == 2
    monkeypatch.setitem(sys.modules, "flint", None)
    assert main(["check-proof", str(tmp_path / "p.json")]) == 2
    assert "pip install python-flint" in capsys.readouterr().err


def test_the_checkers_are_short_and_stand_alone(tmp_path):
    for checker, lines in ((proof_checker, 150), (proof_checker_ground, 200)):
        text = Path(checker.__file__).read_text()
        assert text.count("\n") <= lines
        assert "import gapbeam" not in text
    (tmp_path / "p.json").write_text(json.dumps(proof_data(three_spans())))
    command = [sys.executable, "-P", proof_checker.__file__, tmp_path / "p.json"]
    told = subprocess.run(command, capture_output=True, text=True, check=True)
    assert told.stdout.splitlines()[-1].startswith("proved with 128 bits, largest error ")


def test_the_page_has_the_table_of_its_command(tmp_path, capsys):
    page = (TOP / "docs" / "proof.md").read_text(encoding="utf-8")
    (tmp_path / "proof.md").write_text(page, encoding="utf-8")
    assert proof_times.main(["--largest", "30", "--markdown", str(tmp_path / "proof.md")]) == 0
    made = (tmp_path / "proof.md").read_text(encoding="utf-8")
    table = capsys.readouterr().out.strip().splitlines()
    there = [row for row in page.splitlines() if row.count("|") == 6][:4]
    assert [row.split("|")[1:4] for row in table] == [row.split("|")[1:4] for row in there]  # times differ
    before, after = (text[: text.index(proof_times.BEGIN)] for text in (page, made))
    assert before == after
    assert made.endswith(page[page.index("\n\nMade by") :])


def test_the_attack_sees_what_the_checker_refutes(monkeypatch):
    made = three_spans()
    assert proofs.proof_faults(made, 0) == []
    right = proofs.proof_data

    def wrong(made):
        data = right(made)
        data["states"][0] = "open"
        return data

    monkeypatch.setattr(proofs, "proof_data", wrong)
    assert proofs.proof_faults(made, 0) == ["proof: refuted: support 0 is not open"]
    assert proofs.proof_faults(made, 1) == []  # another seed than those of the sample


@pytest.mark.parametrize(
    ("keys", "problem"),
    [
        ({"foundation": [{"k": float("inf"), "side": "below"}]}, r"foundation\[0\].k: proofs do not know rigid ground"),
        (
            {"foundation": [{"k": 2.0, "side": "below"}], "loads": [{"type": "movement", "foundation": 0, "value": 0.1}]},
            r"loads\[0\]: proofs do not know ground that moves",
        ),
    ],
)
def test_what_no_proof_knows(keys, problem):
    with pytest.raises(gapbeam.SceneError, match=problem):
        proof_data({**scene([6.0], [], [uniform(1.0)]), **keys})
