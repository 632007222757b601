"""Laterally loaded pile: p-y curves of soft clay by depth (Matlock 1970), deflection of the head and largest moment."""

import gapbeam as gb
import numpy as np

DIAMETER, STRAIN, WEIGHT, J = 0.6, 0.01, 8.0, 0.5   # m, -, kN/m3, -
Y50 = 2.5 * STRAIN * DIAMETER
SHARES = np.array([0.0125, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0])


def curve(z: float) -> list[tuple[float, float]]:
    """Resistance (kN/m) over displacement (m) at a depth."""
    strength = 20.0 + 2.0 * z
    most = min(3.0 * strength * DIAMETER + WEIGHT * z * DIAMETER + J * strength * z, 9.0 * strength * DIAMETER)
    return [(y, p) for y, p in zip(SHARES * Y50, 0.5 * most * np.cbrt(SHARES), strict=True)] + [(0.2, most)]


depths = np.arange(0.0, 15.0, 0.5)
pile = gb.Scene(
    title="Pile in soft clay", units=gb.Units("kN", "m"), beam=gb.Beam([15.0], EI=1.5e5),
    foundation=[gb.Foundation(from_=z, to=z + 0.5, law=curve(z + 0.25)) for z in depths],
    loads=[gb.ForceLoad(x=0.0, F=120.0)],
)  # fmt: skip

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
