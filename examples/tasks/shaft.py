"""Shaft with bearing clearance: which shell of every bearing carries, and at which share of the load it changes."""

import gapbeam as gb

CLEARANCE = 0.1   # mm
BEARINGS = {"front": (0, 0.0), "middle": (1, 0.0), "rear": (2, 0.15)}   # node, and how far the bearing is too low (mm)
shaft = gb.Scene(
    title="Shaft in three bearings, clearance 0.1 mm", units=gb.Units("N", "mm"), beam=gb.Beam([500.0, 600.0, 150.0], EI=1.3e11),
    supports=[
        gb.Support(node=node, name=f"{name}, {shell} shell", side=side, settlement=low, gap=gap)
        for name, (node, low) in BEARINGS.items()
        for shell, side, gap in (("lower", "below", 0.0), ("upper", "above", CLEARANCE))
    ],
    loads=[gb.UniformLoad(q=0.15, case="dead"), gb.ForceLoad(x=250.0, F=-2500.0, case="gear"),
           gb.ForceLoad(node=3, F=900.0, case="belt")],
    analysis=gb.Analysis(follow="events"),
)  # fmt: skip

# What a designer asks
result = gb.solve(shaft)
print(result)
for event in result.events:
    print(f"{event.factor:.1%} of the load: {shaft.supports[event.support].name} {event.event}")
for name, force in result.reactions.to_dict().items():
    print(f"{name:20} {force:9.1f} N  {result.states[name]}")
print(f"slope at the gear {float(result.at(250.0).rotation):.2e} rad")
result.plot("shaft.svg")
