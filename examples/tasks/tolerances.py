"""Tolerances by Monte Carlo: bearings not set to the millimetre; how often one has no contact, and what the others carry."""

import gapbeam as gb
from gapbeam import sample

CASES = 20_000
girder = gb.Scene(
    title="Girder on six bearings", units=gb.Units("kN", "m"), beam=gb.Beam([8.0] * 5, EI=2.0e4),
    supports=[gb.Support(node=k, name=f"B{k}", side="both" if k in (0, 5) else "below") for k in range(6)],
    loads=[gb.UniformLoad(q=4.0, case="dead"), gb.ForceLoad(x=4.0, F=60.0)],
)  # fmt: skip
heights = {f"supports[{k}].gap": sample.normal(0.003, 0.003) for k in range(1, 5)}   # m

# --8<-- what a designer asks
done = gb.batch(girder, sample.draw(CASES, heights, seed=1), "tolerances")
print(done, done.statuses())
print(done.summary(limits={f"opening.B{k}": 0.0 for k in range(1, 5)}))
for k in range(1, 5):
    print(f"B{k}: without contact in {(done.read([f'opening.B{k}'])[f'opening.B{k}'] > 0.0).mean():.1%} of the cases")
