"""Bearing offsets of a propeller shaft: those that leave no bearing idle, cold, hot and laden, found over batches of offsets.

Usage: python examples/shaft_offsets.py     (needs scipy)
"""

import gapbeam
import numpy as np
from scipy.optimize import differential_evolution

BEARINGS = ("stern tube", "aft line", "forward line", "gear aft", "gear forward")
OFFSETS = BEARINGS[1:4]
"""These are set; a line through the stern tube and the forward bearing of the gear is the reference."""
LARGEST = 0.003
"""Offset of a bearing, at most (m)."""
STATES = {
    "cold": {},
    "hot": {"gear aft": -0.00035, "gear forward": -0.00035},   # the gear box gets warm and rises
    "laden": {"stern tube": 0.0008, "aft line": 0.0012, "forward line": 0.0009},   # the hull bends
}  # fmt: skip
"""How far bearings move in each state (m, positive downward)."""

SHAFT = {
    "title": "Propeller shaft on five bearings",
    "units": {"force": "kN", "length": "m"},
    "beam": {"spans": [1.2, 3.0, 3.5, 3.0, 0.8], "EI": 6.2e4},   # diameter 280 mm, steel
    "supports": [{"name": name, "node": k + 1, "side": "below", "stiffness": 6.0e5} for k, name in enumerate(BEARINGS)],
    "loads": [{"type": "uniform", "q": 4.75}, {"type": "force", "node": 0, "F": 28.0}, {"type": "force", "x": 11.1, "F": 24.0}],
}  # fmt: skip


def loads_of(beam: gapbeam.Prepared, offsets: np.ndarray) -> np.ndarray:
    """Bearing loads, states by sets of offsets by bearings (kN); offsets (m, positive downward) by bearings and sets."""
    count = offsets.shape[1]
    moves = {name: np.zeros(count * len(STATES)) for name in BEARINGS}
    for name, values in zip(OFFSETS, offsets, strict=True):
        moves[name] += np.tile(values, len(STATES))
    for k, state in enumerate(STATES.values()):
        for name, by in state.items():
            moves[name][k * count : (k + 1) * count] += by
    cases = beam.solve(np.ones((count * len(STATES), len(SHAFT["loads"]))), extra_settlement=moves)
    return cases.reaction.reshape(len(STATES), count, len(BEARINGS))


def main() -> None:
    """Find the offsets and print what the bearings carry with and without them."""
    beam = gapbeam.prepare(SHAFT)
    in_line = np.zeros((len(OFFSETS), 1))

    def least(offsets: np.ndarray) -> np.ndarray:
        """Smallest load of all bearings in all states (kN), for every column of offsets."""
        return loads_of(beam, offsets).min(axis=(0, 2))

    bounds = [(-LARGEST, LARGEST)] * len(OFFSETS)
    options = {"seed": 1, "vectorized": True, "updating": "deferred", "polish": False, "maxiter": 150}
    found = differential_evolution(lambda offsets: -least(offsets), bounds, **options)
    print("offsets (mm, downward)   " + "  ".join(f"{name} {1e3 * x:.2f}" for name, x in zip(OFFSETS, found.x, strict=True)))
    print(f"smallest load of a bearing: {least(in_line)[0]:.2f} kN in line, {-found.fun:.2f} kN with these offsets")
    print(f"{'kN':24s}" + "".join(f"{name:>14s}" for name in BEARINGS))
    for words, offsets in (("in line", in_line), ("with offsets", found.x[:, None])):
        for state, loads in zip(STATES, loads_of(beam, offsets)[:, 0], strict=True):
            print(f"{words + ', ' + state:24s}" + "".join(f"{load:14.1f}" for load in loads))


if __name__ == "__main__":
    main()
