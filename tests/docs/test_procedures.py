"""Procedures of Fortran are short and take few arguments; what still is not stands in lists that only shrink."""

import re
from pathlib import Path

import pytest

FORTRAN = Path(__file__).resolve().parents[2] / "fortran"
LINES, ARGUMENTS, FILE = 100, 10, 400


def listed(text):
    """Files, and names of procedures in them."""
    lines = [line.partition(":") for line in text.split("\n") if line]
    return {f"{file} {name}".strip() for file, _, names in lines for name in names.split() or [""]}


LONG = listed("""
cases/lane_fields: recover_link
cases/lane_row_errors: find_sizes
cases/lane_sweeps: sweep_chain sweep_three_moments
contact/find_zones: find_zones
contact/ground_energy: find_least_energy
contact/mesh_zones: zones_of_mesh
continuation/ground_runs: ground_runs
elimination/elements: sweep
moving_load/train_bounds: find_bounds
moving_load/train_curves: find_curves
moving_load/train_elimination: substitute
moving_load/train_envelope: find_envelope
moving_load/train_extremes: find_extreme
moving_load/train_link_bounds: bound_link
moving_load/train_runs: read_way
precision/audit: audit_beam
precision/ground_audit: audit_ground
precision/ground_solver: solve_on_ground
precision/stretch_audit: audit_stretch
scene/assemble_foundations: assemble_foundations
""")
"""Procedures of more lines, those inside counted with their host. None may be added: what is cut is taken out."""
MANY_ARGUMENTS = listed("""
beam/derivatives_along: derive_deflection derive_rotation
beam/fields_along: deflection_at
beam/link: recover_link
beam/recover: recover_beam
cases/lane_audit: audit_along audit_beside audit_nodes check_link check_restraint
cases/lane_certificate: bound_fields bound_links
cases/lane_columns: give_eight
cases/lane_error_ellipses: find_results
cases/lane_fields: recover recover_link
cases/lane_finish: solve
cases/lane_reactions: find_reactions find_sizes
cases/lane_residual: find_rest find_rest_along find_rest_at_restraints
cases/lane_row_errors: find_sizes
cases/lane_search: add_loads find_wrong
cases/lane_shared: find_wrong_beside share_forces
cases/lane_sweeps: pass_restraint sweep_chain sweep_three_moments
cases/lane_two_sided_sweep: go_inward pass_both_ends put_inward
cases/segment_finish: find_reactions find_shears find_sizes
contact/law: share_forces
contact/signs: judge judge_elastic
contact/zone_margin: search_stretch
contact/zones: polish_zones settle_zones
continuation/outgoing_directions: find_outgoing try_motion
elimination/elements: sweep
elimination/residual_along: residual_of_block
precision/audit: audit_beam
precision/certificate: certify
precision/ground_solver: settle_finely
response/query: fields_in_pieces
""")
"""Procedures of more arguments outside `fortran/face`. None may be added."""
LONG_FILES = listed("""

""")
"""Files of more lines. None may be added."""
BEGINS = re.compile(r"(?!end\b)(?:[\w()=,* ]* )?(?:subroutine|function) +(\w+) *(?:\(([^()]*)\))?", re.I)
ENDS = re.compile(r"end +(?:subroutine|function)\b", re.I)


def sources():
    """All sources but the other methods that studies compare with."""
    return [path for path in FORTRAN.rglob("*") if path.suffix in (".f90", ".F90", ".inc") and path.parent.name != "yardsticks"]


def procedures(path):
    """Name, lines, arguments and depth of every procedure of a source."""
    joined, begin = "", 0
    open_ones = []
    for number, line in enumerate(path.read_text().splitlines(), 1):
        code = line.strip()
        if not joined:
            begin = number
        joined += code.partition(" !")[0].removesuffix("&").strip().removeprefix("&") + " "
        if code.endswith("&") and not code.startswith("!"):
            continue
        whole, joined = joined.strip(), ""
        if re.match(r"(abstract +)?interface\b", whole, re.I):
            open_ones.append(None)
        elif re.match(r"end +interface\b", whole, re.I):
            open_ones.pop()
        elif ENDS.match(whole):
            name, first, arguments, inside = open_ones.pop()
            if None not in open_ones:
                yield name, number - first + 1, arguments, inside
        elif found := BEGINS.match(whole):
            open_ones.append((found[1], begin, len((found[2] or "").split(",")) if found[2] else 0, len(open_ones)))


def named(path, name):
    """What a list calls a procedure."""
    return f"{path.relative_to(FORTRAN).with_suffix('')} {name}"


def test_no_procedure_is_long():
    assert {named(path, name) for path in sources() for name, lines, _, _ in procedures(path) if lines > LINES} <= LONG


def test_no_procedure_takes_many_arguments():
    many = {named(path, name) for path in sources() if path.parent.name != "face"
            for name, _, arguments, _ in procedures(path) if arguments > ARGUMENTS}  # fmt: skip
    assert many <= MANY_ARGUMENTS


def test_no_file_is_long():
    long = {path for path in sources() if path.read_text().count("\n") > FILE}
    assert {path.relative_to(FORTRAN).with_suffix("").as_posix() for path in long} <= LONG_FILES


def test_what_is_listed_is_there():
    there = {named(path, name) for path in sources() for name, *_ in procedures(path)}
    assert there >= LONG | MANY_ARGUMENTS


@pytest.mark.parametrize(("text", "found"), [
    ("subroutine one(a, &\n    b)\nend subroutine one\n", [("one", 3, 2, 0)]),
    ("pure function two() result(r)\ncontains\nfunction three(c)\nend function three\nend function two\n",
     [("three", 2, 1, 1), ("two", 5, 0, 0)]),
    ("interface\nsubroutine four(a)\nend subroutine four\nend interface\n", []),
])  # fmt: skip
def test_procedures_are_found(text, found, tmp_path):
    path = tmp_path / "some.f90"
    path.write_text(text)
    assert list(procedures(path)) == found
