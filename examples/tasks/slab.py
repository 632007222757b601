"""Slab on reactive clay: edge heave and centre heave, where the slab hangs free and the moments it is designed for."""

import gapbeam as gb

EDGE = [(0.0, 0.0), (0.5, 0.012), (1.0, 0.022), (1.5, 0.030), (10.5, 0.030), (11.0, 0.022), (11.5, 0.012), (12.0, 0.0)]
CENTRE = [(0.0, 0.030), (0.5, 0.018), (1.0, 0.008), (1.5, 0.0), (10.5, 0.0), (11.0, 0.008), (11.5, 0.018), (12.0, 0.030)]


def slab(title: str, mound: list[tuple[float, float]]) -> gb.Scene:
    """A strip of the slab of 1 m on a mound: how far the ground is below the slab before it is loaded."""
    return gb.Scene(
        title=title, units=gb.Units("kN", "m"), beam=gb.Beam([12.0], EI=1.5e4, width=1.0),
        foundation=[gb.Foundation(k=1000.0, side="below", profile=mound)],
        loads=[gb.UniformLoad(q=5.0), *(gb.ForceLoad(x=x, F=F) for x, F in ((0.0, 10.0), (6.0, 12.0), (12.0, 10.0)))],
    )  # fmt: skip


# What a designer asks
results = {name: gb.solve(slab(name, mound)) for name, mound in (("edge heave", EDGE), ("centre heave", CENTRE))}
for name, result in results.items():
    print(result)
    moment = result.extremes["moment"]
    print(f"{name}: M from {moment['min'].value:.2f} to {moment['max'].value:.2f} kN m per metre")
    for span in result.steps[-1].free_spans:
        print(f"  free from x = {span.from_:.2f} to {span.to:.2f} m, up to {1e3 * span.sag:.1f} mm above the ground")
    result.plot(f"{name.replace(' ', '_')}.svg")
