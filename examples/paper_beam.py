"""Solve the paper's beam and set it beside the published values.

Usage: python examples/paper_beam.py [FOLDER]     (the picture goes there; default: build, beside examples)
"""

import sys
from pathlib import Path

import gapbeam
import msgspec
from gapbeam.plots import plot
from gapbeam.report import print_report

HERE = Path(__file__).resolve().parent
SCENES = {"0.70707": HERE / "paper_beam.toml", "0.7707": HERE / "paper_beam_printed_load.toml"}

#: Who, R2 and R4 in tf, lift-off at support 3 in m
PUBLISHED = (
    ("paper, finite elements", 3.8508, 0.5302, 0.0772),
    ('paper, "analytical"', 3.7872, 0.5302, 0.0772),
    ("LIRA 10", 3.8597, 0.52698, 0.0773),
)

CAUSE = """\
The paper's two values of R2 differ by 1.6 % because of a misprint in the load: its finite
elements have F2 = 0.70707 tf, its "analytical" R2 is that of F2 = 0.7707 tf, to the last digit.
R4 and the lift-off do not depend on F2 and agree; LIRA's values are what is left after 10,000
iterations.
"""


def values(result: gapbeam.Result) -> tuple[float, float, float]:
    """Pick what the paper tabulates: |R2| and R4, and the lift-off at support 3."""
    step = result.steps[-1]
    return abs(step.reaction[1]), step.reaction[3], step.opening[2]


def history() -> None:
    """Print what the paper's rule does, solve by solve.

    A scheme is a scene of its own here: a support that acts holds both ways, one that does not is left out.
    """
    scene = gapbeam.read_scene(SCENES["0.70707"])
    clamp, *one_sided = scene.supports
    acts = [True] * len(one_sided)
    before = None
    print("\nThe paper's rule, solve by solve: R upward, w downward; + acts, - is released\n")
    while acts != before:
        supports = [clamp, *(msgspec.structs.replace(s, side="both") for s, on in zip(one_sided, acts, strict=True) if on)]
        result = gapbeam.solve(msgspec.structs.replace(scene, supports=supports))
        state = iter(result.steps[-1].reaction[1:])
        before, line, wrong = acts, "", {}
        for k, (support, on) in enumerate(zip(one_sided, acts, strict=True)):
            pushes = 1.0 if support.side == "below" else -1.0
            value = next(state) if on else result.at(2.0 * (k + 1)).deflection
            line += f"   {'+' if on else '-'} {k + 2}: {'R' if on else 'w'} = {value:8.4f}"
            if pushes * value * (1.0 if on else -1.0) < 0.0:
                wrong[k] = abs(value)
        pulling = {k: value for k, value in wrong.items() if acts[k]}
        changed = {k for k in wrong if not acts[k]} | ({max(pulling, key=pulling.get)} if pulling else set())
        acts = [on != (k in changed) for k, on in enumerate(acts)]
        words = [f"{'put back' if acts[k] else 'release'} {k + 2}" for k in sorted(changed)]
        print(line + "   " + (", ".join(words) or "the scheme stays: done"))


def compare() -> None:
    """Print the table of gapbeam's and the published values."""
    results = {
        (load, rule): gapbeam.solve(scene, rule=rule)
        for load, scene in SCENES.items()
        for rule in ("block", "single")
    }
    reference = values(results["0.70707", "block"])
    print("\nBeside the published values (difference from the first row, %)\n")
    print(f"{'':31}{'R2, tf':>10}{'%':>7}{'R4, tf':>11}{'%':>7}{'lift-off, m':>13}{'%':>7}")
    for (load, rule), result in results.items():
        show(f"gapbeam, F2 = {load}, {rule}", values(result), reference, 7)
    for name, *published in PUBLISHED:
        show(name, published, reference, 5)
    solves = {rule: results["0.70707", rule].steps[0].solves for rule in ("block", "single")}
    print(f"\nLinear solves, first load step: {solves['block']} by the rule block, {solves['single']} by single.\n")
    print(CAUSE)


def show(name: str, row: tuple[float, float, float], reference: tuple[float, float, float], decimals: int) -> None:
    """Print one row of the table."""
    cells = ""
    for value, true, width in zip(row, reference, (10, 11, 13), strict=True):
        text = f"{value:.{decimals}f}".rstrip("0") if decimals == 5 else f"{value:.{decimals}f}"
        cells += f"{text:>{width}}{100.0 * (value / true - 1.0) + 0.0:7.2f}"
    print(f"{name:31}{cells}")


def main(folder: Path) -> None:
    """Report, compare, draw."""
    result = gapbeam.solve(SCENES["0.70707"])
    print_report(result)
    history()
    compare()
    folder.mkdir(parents=True, exist_ok=True)
    picture = folder / "paper_beam.png"
    plot(result, picture)
    print(f"The picture is in {picture}")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else HERE.parent / "build")
