"""Strip footing: how much of it carries under an eccentric column, and the bearing pressure beside what is allowed."""

import gapbeam as gb

footing = gb.Scene(
    title="Strip footing, eccentric load", units=gb.Units("kN", "m"), beam=gb.Beam([4.0], EI=5.0e5, width=1.5),
    foundation=[gb.Foundation(k=3.0e4, side="below")],
    loads=[gb.UniformLoad(q=25.0, case="dead"), gb.ForceLoad(x=0.8, F=500.0)],
    limits=gb.Limits(pressure=280.0, moment=150.0),
)  # fmt: skip

# What a designer asks
result = gb.solve(footing)
print(result)                                            # contact, free span, pressure in kPa, limits
step = result.steps[-1]
carries = sum(zone.to - zone.from_ for zone in step.contact)
pressure = result.utilisations["pressure"]
print(f"{carries:.3f} m of 4 m carry; {pressure.value:.1f} kPa at x = {pressure.x:.2f} m, {pressure.ratio:.0%} of what is allowed")
result.plot("footing.svg")
