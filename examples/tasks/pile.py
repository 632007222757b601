"""Laterally loaded pile: p-y curves of soft clay by depth (Matlock 1970), deflection of the head and largest moment."""

import gapbeam as gb
from gapbeam import packs

CLAY = {"law": "matlock_clay", "to": 15.0, "cu": (20.0, 50.0), "gamma": 8.0, "eps50": 0.01}   # m, kN/m2, kN/m3
pile = gb.read_scene({
    "title": "Pile in soft clay", "units": {"force": "kN", "length": "m"},
    "beam": {"spans": [15.0], "EI": 1.5e5, "direction": "down"},
    "foundation": packs.pile_ground([CLAY], D=0.6),
    "loads": [{"type": "force", "x": 0.0, "F": 120.0}],
})  # fmt: skip

# What a designer asks
result = gb.solve(pile)
print(result)
print(f"head {1e3 * float(result.at(0.0).deflection):.1f} mm, {float(result.at(0.0).rotation):.4f} rad")
for force in (40.0, 80.0, 120.0, 160.0):
    again = gb.solve(gb.replace(pile, "loads[0].F", force))
    least = again.extremes["moment"]["min"]
    head = 1e3 * float(again.at(0.0).deflection)
    print(f"{force:5.0f} kN: head {head:6.2f} mm, moment {least.value:7.1f} kN m at {least.x:.2f} m")
result.plot("pile.svg")
