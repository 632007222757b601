"""Tolerances by Monte Carlo: bearings not set to the millimetre; how often one has no contact, and what the others carry."""

import gapbeam as gb
import numpy as np
from gapbeam import sample

CASES = 20_000
girder = gb.Scene(
    title="Girder on six bearings", units=gb.Units("kN", "m"), beam=gb.Beam([8.0] * 5, EI=2.0e5),
    supports=[gb.Support(node=k, name=f"B{k}", side="both" if k in (0, 5) else "below") for k in range(6)],
    loads=[gb.UniformLoad(q=4.0, case="dead"), gb.ForceLoad(x=4.0, F=60.0)],
)  # fmt: skip
heights = {f"supports[{k}].gap": sample.normal(0.0, 0.005) for k in range(1, 5)}   # m

# What a designer asks
done = gb.batch(girder, sample.draw(CASES, heights, seed=1), "tolerances")
print(f"{done.done:,} cases, {done.statuses()}")
for k in range(1, 5):
    opening, reaction = done.read([f"opening.B{k}", f"reaction.B{k}"]).values()
    print(f"B{k}: no contact in {(opening > 0.0).mean():.1%} of the cases; "
          f"reaction beyond {np.quantile(reaction, 0.95):.1f} kN in 5 %")
summary = done.summary(limits={"moment.max": 150.0})
print(f"moment above 150 kN m in {summary.columns['moment.max'].above[150.0] / done.done:.1%} of the cases")
