"""Bridge: uplift of the end bearings under Load Model 1, load patterns by span, and a pier that settles."""

import gapbeam as gb
from gapbeam import packs

bridge = gb.Scene(
    title="Road bridge of three spans, LM1", units=gb.Units("kN", "m"), beam=gb.Beam([18.0, 45.0, 18.0], EI=3.0e7),
    supports=[gb.Support(node=k, name=name, side="below") for k, name in enumerate(("A", "P1", "P2", "B"))],
    loads=[gb.UniformLoad(q=90.0, case="dead"), gb.UniformLoad(q=packs.lm1_lane()["q"], case="udl"),
           gb.CurvatureLoad(kappa=1.0e-4, case="temp")],
    trains=[gb.Train(**packs.lm1((1, 2, 3)) | {"name": "TS"})],   # 600 kN per axle: all lanes on one girder
    combinations=[
        gb.Combination(name="heavy", factors={"dead": 1.35, "udl": 1.35, "ts": 1.35}, expand={"udl": "spans"}),
        gb.Combination(name="light", factors={"dead": 1.0, "udl": 1.35, "ts": 1.35, "temp": 0.9}, expand={"udl": "spans"}),
        gb.Combination(name="settled", factors={"dead": 1.35, "udl": 1.35, "ts": 1.35, "temp": 0.9}, settlements={"P1": 0.015},
                       expand={"temp": "signs"}),
    ],
)  # fmt: skip

# What a designer asks
result = gb.solve(bridge)
print(result)                                            # uplift and largest values with combination and position
for one in result.lifted:
    name = bridge.supports[one.support].name
    print(f"{name}: uplift {1e3 * one.opening:.2f} mm in {one.combination}, tandem at {one.position:.2f} m")
for name in ("A", "P1", "P2", "B"):
    least, most = result.reactions[name]["min"], result.reactions[name]["max"]
    print(f"{name}: {least.value:.0f} kN ({least.combination}) to {most.value:.0f} kN ({most.combination})")
result.plot("bridge.svg")
