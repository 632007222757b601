"""Long prepared beams, once a segmentation fault: spans and cases as arguments, those with which it was found if there are none.

Whether it comes to one depends on what lies in the memory beyond the end of an array; `test_segments.f90` sees it always.
"""

import sys

import gapbeam
import numpy as np


def try_beams(given):
    """Solve beams of so many spans in so many cases, side by side and alone."""
    for n, cases in zip(given[::2], given[1::2], strict=True):
        forces = [{"type": "force", "x": 6.0 * k + 3, "F": 30.0} for k in range(0, n, 9)]
        beam = gapbeam.prepare({
            "beam": {"spans": [6.0] * n, "EI": 1e4},
            "supports": [{"node": i, "side": "below", "gap": 0.001 * ((i * 7) % 5)} for i in range(n + 1)],
            "loads": [{"type": "uniform", "q": 2.0, "case": "dead"}, *forces],
        })  # fmt: skip
        factors = np.ones(len(forces) + 1) if cases == 1 else np.ones((cases, len(forces) + 1))
        for _ in range(10):
            beam.solve(factors)
        solved, alone = beam.solve(factors), gapbeam.solve(beam.scene).steps[-1]
        assert (solved.status == 0).all()
        assert (solved.closed == [state != "open" for state in alone.state]).all()
        for mine, theirs in ((solved.reaction, alone.reaction), (solved.deflection, alone.deflection)):
            assert np.abs(mine - theirs).max() <= 1e-13 * np.abs(theirs).max()
        assert np.abs(solved.reaction.sum(axis=-1) - 12.0 * n - 30.0 * len(forces)).max() <= 1e-11 * n
        print(n, cases)


if __name__ == "__main__":
    try_beams([int(word) for word in sys.argv[1:]] or [2000, 1, 3000, 1, 4000, 1, 5000, 1])
