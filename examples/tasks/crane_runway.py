"""Crane runway: two cranes alone and together, the uplift at every column, and where the cranes are then."""

import gapbeam as gb
from gapbeam import packs

FIRST, SECOND = [(0.0, 180.0), (3.6, 180.0)], [(0.0, 120.0), (3.2, 120.0)]   # wheels: m behind the first one, kN

runway = gb.Scene(
    title="Crane runway, six bays, two cranes", units=gb.Units("kN", "m"), beam=gb.Beam([7.5] * 6, EI=2.1e5),
    supports=[gb.Support(node=k, name=f"C{k}", side="below") for k in range(7)],
    loads=[gb.UniformLoad(q=3.0, case="dead")],
    trains=[gb.Train(**train) for train in packs.crane_pair(FIRST, SECOND, 5.5)],
)  # fmt: skip

# What a designer asks
result = gb.solve(runway)
print(result)                                            # largest values, each with the position of the crane
for one in result.lifted:
    print(f"{runway.supports[one.support].name} lifts off by {1e3 * one.opening:.2f} mm, {one.train} at {one.position:.2f} m")
most = result.envelope().extremes["moment"]["max"]
print(f"largest moment {most.value:.1f} kN m at x = {most.x:.2f} m, {most.train} at {most.position:.2f} m, "
      f"with a shear of {most.concurrent['shear']:.1f} kN")
least, most = result.reactions["C1"]["min"], result.reactions["C1"]["max"]
print(f"column C1: {least.value:.1f} to {most.value:.1f} kN")
result.plot("crane_runway.svg")
