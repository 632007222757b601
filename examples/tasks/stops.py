"""Stops: a shear pin breaks, the arm falls onto a rubber stop; at which load, and what the stop takes."""

import gapbeam as gb

arm = gb.Scene(
    title="Arm: shear pin breaks, rubber stop", units=gb.Units("kN", "m"), beam=gb.Beam([3.0, 2.0], EI=8.0e3),
    supports=[
        gb.Support(node=0, name="bolt"),
        gb.Support(node=1, name="pin", side="below", unloading="broken",
                   law={"type": "brittle", "stiffness": 5.0e5, "limit": 90.0}),
        gb.Support(node=2, name="rubber", side="below", gap=0.04,
                   law={"type": "hardening", "stiffness": 400.0, "limit": 20.0, "slope": 4.0e3}),
    ],
    loads=[gb.ForceLoad(node=2, F=80.0)],
    analysis=gb.Analysis(follow="events", at_limit="jump"),
)  # fmt: skip

# What a designer asks
result = gb.solve(arm)
print(result.report())                                   # the pin breaks, at which load and reaction; largest values on the way
limit = result.limits[0]
print(f"the pin breaks at {80.0 * limit.factor:.2f} kN; then the stop takes {limit.landing.reaction[2]:.2f} kN")
worst = result.history_extremes["moment"]["min"]
print(f"worst moment {worst.value:.1f} kN m at {worst.factor:.2%} of the load, at its end {float(result.at(3.0).moment):.1f}")
print(f"tip {1e3 * float(result.at(5.0).deflection):.1f} mm at the end")
result.plot("path")
result.plot("stops.svg")
