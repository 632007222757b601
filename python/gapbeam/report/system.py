"""The system of equations in the report: beam, supports, loads, what was solved and what was left out."""

import math
from collections import Counter
from typing import TYPE_CHECKING

import numpy as np

from ..base.characters import visible
from ..results import formatting as fmt
from ..results.equilibrium import feels_axial_force
from ..scene.names import DEAD, cases_of
from ..scene.structs import Scene
from ..scene.tapers import ends_of, is_tapered

if TYPE_CHECKING:
    from ..results.result import Result
    from .writer import Writer

LEFT_OUT = {
    "axial": "axial forces",
    "shear": "shear flexibility",
    "foundation": "foundation",
    "hinges": "hinges",
    "iteration": "iteration of the contact state",
    "deflections": "deflections as unknowns",
}
MOST_CASES = 8
"""Load cases that are named in one line."""

OTHERS = {
    "axial": "axial", "rotational": "of a rotation with a law", "at_hinge": "of a rotation at a hinge",
    "hinge": "hinges with a law",
}  # fmt: skip
"""Kinds of supports that are not across the beam, by their direction, or by what has it."""

def write_system(say: "Writer", result: "Result") -> None:
    """Print what was solved: beam, supports, loads, equations, and what was left out."""
    scene, system = result.scene, result.system
    say.heading("System")
    words = LEFT_OUT | ({"axial": "axial displacements"} if feels_axial_force(result) else {})
    left_out = [words.get(name, name) for name in system.left_out if name != "second order"]
    equations = f"{system.method}: {fmt.count(system.nodes, 'node')}, {fmt.count(system.unknowns, 'unknown')}"
    equations += f", half bandwidth {system.half_bandwidth}"
    if system.axial_unknowns:
        equations += f"; apart from it {fmt.count(system.axial_unknowns, 'axial unknown')}"
    say.pairs(
        [
            ("beam", _beam(scene)),
            ("supports", _supports(scene)),
            *([("foundations", _foundations(scene))] if scene.foundation else []),
            ("loads", _loads(scene)),
            ("equations", equations),
            ("left out", ", ".join(left_out) + " (this scene needs none)" if left_out else "nothing"),
            *([("", f"effect of axial forces on bending: {system.compression.in_words()}")] if system.compression else []),
        ]
    )


def _beam(scene: Scene) -> str:
    """Tell spans, length and stiffness in one line."""
    beam = scene.beam
    stiffness = [beam.EI] if isinstance(beam.EI, int | float) else list(beam.EI)
    stiffness += [end for section in scene.sections if section.EI is not None for end in ends_of(section.EI)[:2]]
    low, high = min(stiffness), max(stiffness)
    values = fmt.number(low) if low == high else f"{fmt.number(low)} to {fmt.number(high)}"
    words = [fmt.count(len(beam.spans), "span"), f"{fmt.number(float(scene.span_ends()[-1]))} {fmt.unit(scene, 'x')}".rstrip()]
    words.append("EI " + f"{values} {fmt.unit(scene, 'EI')}".rstrip())
    if scene.sections:
        tapered = sum(map(is_tapered, scene.sections))
        words.append(fmt.count(len(scene.sections), "section") + (f" ({tapered} tapered)" if tapered else ""))
    if count := len(beam.hinges) + len(scene.hinges):
        words.append(fmt.count(count, "hinge"))
    return ", ".join(words)


def _supports(scene: Scene) -> str:
    """Tell how many supports there are of which kind, in one line."""
    normal = [support for support in scene.supports if support.direction == "normal"]
    others = ["at_hinge" if support.at_hinge else support.direction for support in scene.supports]
    kinds = [
        (sum(support.side == "both" for support in normal), "two-way"),
        (sum(support.side == "below" for support in normal), "one-sided from below"),
        (sum(support.side == "above" for support in normal), "one-sided from above"),
        *((others.count(way), kind) for way, kind in OTHERS.items()),
        (sum(support.gap > 0 for support in normal), "with a gap"),
        (sum(support.gap < 0 for support in normal), "set high (negative gap)"),
        (sum(math.isfinite(support.stiffness) for support in normal), "elastic"),
        (sum(support.law is not None for support in normal), "with a curve"),
        (sum(support.settlement != 0 for support in normal), "settling"),
        (sum(support.rotation == "fixed" for support in normal), "clamped"),
    ]
    words = [f"{quantity:,} {kind}" for quantity, kind in kinds if quantity]
    return f"{len(scene.supports):,}: " + ", ".join(words) if words else "none"


def _foundations(scene: Scene) -> str:
    """Tell how many foundations there are of which kind, in one line."""
    foundations = scene.foundation
    kinds = [
        (sum(item.side == "both" for item in foundations), "two-way"),
        (sum(item.side == "below" for item in foundations), "one-sided from below"),
        (sum(item.side == "above" for item in foundations), "one-sided from above"),
        (sum(np.max(item.gap) > 0.0 for item in foundations), "with a gap"),
        (sum(np.min(item.gap) < 0.0 for item in foundations), "set high (negative gap)"),
        (sum(item.profile is not None for item in foundations), "with a profile"),
        (sum(item.law is not None for item in foundations), "with a curve"),
    ]
    words = [f"{quantity:,} {kind}" for quantity, kind in kinds if quantity]
    return f"{len(foundations):,}: " + ", ".join(words) if words else "none"


def _loads(scene: Scene) -> str:
    """Tell how many loads there are of which kind and of which case, in one line."""
    kinds = Counter(type(load).__struct_config__.tag for load in scene.loads)
    if not kinds:
        return "none"
    words = ", ".join(f"{quantity:,} {kind}" for kind, quantity in kinds.items())
    cases = Counter(cases_of(scene.loads))
    order = sorted(cases, key=lambda case: case != DEAD)
    each = ", ".join(f"{cases[case]:,} {visible(case)}" for case in order[:MOST_CASES])
    more = f" and {len(order) - MOST_CASES} more cases" if len(order) > MOST_CASES else ""
    return f"{len(scene.loads):,}: {words} ({each + more if len(order) > 1 else f'all {visible(order[0])}'})"
