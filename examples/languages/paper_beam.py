"""The paper's beam in Python: solved in ten load steps, followed from event to event.

The programs beside it do the same in C, Fortran and Fortran 77 and print the same digits.
"""

import math
from collections.abc import Iterable

import gapbeam
from gapbeam import Analysis, Beam, ForceLoad, Scene, Support


def row(name: str, values: Iterable[float]) -> None:
    """Print a name and its values, all digits of them."""
    print(f"{name:12}" + "".join(f"{value:25.16E}" for value in values))


# A clamped beam of three spans, in tf and m; the middle one of its one-sided supports lifts off
scene = Scene(
    beam=Beam(spans=[2.0, 2.0, 2.0], EI=44.5, GA=math.inf),
    supports=[
        Support(node=0, rotation="fixed"),
        Support(node=1, side="above"),
        Support(node=2, side="below"),
        Support(node=3, side="below"),
    ],
    loads=[ForceLoad(node=1, F=0.70707), ForceLoad(node=2, F=-4.3597), ForceLoad(node=3, F=2.1155)],
    analysis=Analysis(steps=10),
)
result = gapbeam.solve(scene)
step = result.steps[-1]
row("reaction", step.reaction)
row("deflection", step.deflection)
row("opening", step.opening)
row("couple", step.couple)
codes = {"open": 0, "closed": 1, "bilateral": 2}
print(f"{'condition':12}" + "".join(f"{codes[state]:4d}" for state in step.state))
fields = result.at([1.0, 3.0, 5.0])
row("moment", fields.moment)
row("shear", fields.shear)
row("rotation", fields.rotation)
extremes = result.extremes["deflection"]
row("largest", (extremes["max"].value, extremes["min"].value))
row("at", (extremes["max"].x, extremes["min"].x))
row("certificate", (step.residuals["equilibrium"], step.residuals["compatibility"], *step.bounds))
scene.analysis = Analysis(follow="events")
print(f"{'events':12}{len(gapbeam.solve(scene).events):4d}")
