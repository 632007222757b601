"""How many bits and seconds a proof takes, over the number of spans.

    python tests/studies/proof_times.py --markdown docs/proof.md
"""

import argparse
import random
import re
import sys
import time
from pathlib import Path

from gapbeam.results.proof import proof_data

sys.path.insert(0, str(Path(__file__).parents[1] / "oracle" / "checkers"))
import proof_checker

BEGIN = "| spans |"


def rack(spans):
    """A pipe on one-sided supports of different heights, some of them springs, with a hinge every tenth span."""
    rng = random.Random(spans)
    supports = [{"node": i, "side": "below", "gap": rng.randint(0, 8) / 1024} for i in range(spans + 1)]
    for support in supports[1::5]:
        support["stiffness"] = 2000.0
    loads = [{"type": "uniform", "q": 2.0, "case": "dead"}]
    loads += [{"type": "force", "x": 6.0 * i + 2.0, "F": float(rng.randint(-8, 60))} for i in range(0, spans, 3)]
    return {"beam": {"spans": [6.0] * spans, "EI": 1e4}, "supports": supports, "loads": loads}


def measure(spans):
    """Give a row of the table."""
    data = proof_data(rack(spans))
    begin = time.perf_counter()
    words = proof_checker.decide(data)
    seconds = time.perf_counter() - begin
    bits, error = re.match(r"(\d+) bits.*largest error ([\de.+-]+)", words).groups()
    opened = data["states"].count("open")
    return f"| {spans:,} | {opened:,} | {int(bits):,} | {seconds:.2g} | {float(error):.1e} |"


def main(arguments=None):
    """Print the table, and put it into the page."""
    parser = argparse.ArgumentParser("python tests/studies/proof_times.py", description=__doc__)
    parser.add_argument("--largest", type=int, default=10_000, metavar="N", help="most spans (default 10000, which take a minute)")
    parser.add_argument("--markdown", type=Path, metavar="FILE", help="the page whose table is made anew")
    chosen = parser.parse_args(arguments)
    head = [f"{BEGIN} open supports | bits | seconds | largest error |", "|---:|---:|---:|---:|---:|"]
    table = "\n".join([*head, *(measure(n) for n in (10, 30, 100, 300, 1000, 3000, 10_000) if n <= chosen.largest)])
    print(table)
    if chosen.markdown:
        text = chosen.markdown.read_text(encoding="utf-8")
        before, after = text.split(BEGIN)
        chosen.markdown.write_text(before + table + after[after.index("\n\n") :], encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
