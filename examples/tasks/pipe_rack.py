"""Pipe rack: which rack a steam line leaves when it is hot, and what the others carry then, cold, hot and under test."""

import gapbeam as gb

RACKS = ("nozzle", "R1", "R2", "R3", "R4", "anchor")
line = gb.Scene(
    title="Steam line DN200 on four racks", units=gb.Units("kN", "m"), beam=gb.Beam([6.0, 6.0, 6.0, 6.0, 4.0], EI=7.8e3),
    supports=[gb.Support(node=k, name=name, side="below" if name[0] == "R" else "both") for k, name in enumerate(RACKS)],
    loads=[gb.UniformLoad(q=0.85, case="dead"), gb.UniformLoad(q=0.35, case="water")],
    combinations=[
        gb.Combination(name="cold", factors={"dead": 1.0}),
        gb.Combination(name="hot", factors={"dead": 1.0}, settlements={"nozzle": -0.045}),
        gb.Combination(name="hydrotest", factors={"dead": 1.0, "water": 1.0}),
    ],
    limits=gb.Limits(moment=14.5, reaction=15.0),
)  # fmt: skip
line.supports[-1].rotation = "fixed"

# What a designer asks
result = gb.solve(line)
print(result.report())                                   # what lifts, reactions by combination, what governs, limits
for one in result.lifted:
    print(f"{RACKS[one.support]} lifts off by {1e3 * one.opening:.2f} mm when {one.combination}")
print(f"R2: {result.reactions['cold']['R2']:.2f} kN cold, {result.reactions['hot']['R2']:.2f} kN hot")
print({name: f"{used.ratio:.0%}" for name, used in result.utilisations.items()})
result.plot("pipe_rack.svg")
