"""Racks that do not stand where they were drawn: how the largest reaction of a hot pipe is distributed.

Usage: python examples/pipe_rack_gaps.py [FOLDER]     (results go there; default: build/pipe_rack_gaps, beside examples)
"""

import sys
from itertools import pairwise
from pathlib import Path

import gapbeam
import numpy as np
from gapbeam import sample

HERE = Path(__file__).resolve().parent
CASES = 20_000
DEVIATION = 0.005
"""Standard deviation of the height of a rack (m); neighbours are correlated, as the ground is."""
NEIGHBOURS = 0.5


def draws(scene: gapbeam.Scene, cases: int) -> sample.Draws:
    """Draw a gap for every rack, about that of the scene (m, positive: the rack is too low), and the weight of the pipe."""
    columns = {f"supports[{k}].gap": sample.normal(rack.gap, DEVIATION) for k, rack in enumerate(scene.supports)}
    names = list(columns)
    correlation = dict.fromkeys(pairwise(names), NEIGHBOURS)
    return sample.draw(cases, columns | {"factors.dead": sample.lognormal(1.0, 0.05)}, seed=2026, correlation=correlation)


def main(folder: Path = HERE.parent / "build" / "pipe_rack_gaps", cases: int = CASES) -> None:
    """Solve all cases and print what came of them."""
    scene = gapbeam.read_scene(HERE / "pipe_rack.toml")
    drawn = gapbeam.solve(scene).steps[-1].reaction
    done = gapbeam.batch(scene, draws(scene, cases), folder)
    reactions = np.array([done.read([name])[name] for name in done.results if name.startswith("reaction")])
    largest = reactions.max(axis=0)
    print(f"{done.done:,} cases, of which {done.statuses()['solved']:,} are solved")
    print(f"largest reaction of the drawn racks   {drawn.max():6.2f} kN at rack {drawn.argmax()}")
    for share in (0.5, 0.95, 0.99):
        print(f"not exceeded in {100 * share:2.0f} % of the cases      {np.quantile(largest, share):6.2f} kN")
    governs = np.bincount(reactions.argmax(axis=0), minlength=len(reactions)) / done.done
    open_racks = (reactions == 0.0).mean(axis=1)
    print("rack   has the largest reaction   carries nothing")
    for k in range(len(reactions)):
        print(f"{k:4d}{governs[k]:20.1%}{open_racks[k]:21.1%}")


if __name__ == "__main__":
    main(*map(Path, sys.argv[1:2]))
