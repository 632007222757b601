"""Find the stiffness that a slab on a clay mound needs so that it bends no more than it may.

Usage: python examples/slab_on_mound.py [FOLDER]     (the picture goes there; default: build, beside examples)
"""

import sys
from collections.abc import Callable
from math import exp, log
from pathlib import Path

import gapbeam
from gapbeam.plots import plot

HERE = Path(__file__).resolve().parent
SCENE = HERE / "slab_on_mound.toml"

#: What masonry veneer stands: length/600
PERMITTED = 12.0 / 600.0
#: Long-term modulus of concrete, kN/m2
CONCRETE = 1.5e7


def with_stiffness(EI: float) -> gapbeam.Result:
    """Solve the slab with another stiffness."""
    scene = gapbeam.read_scene(SCENE)
    scene.beam.EI = EI
    return gapbeam.solve(scene)


def bending(result: gapbeam.Result) -> float:
    """How much the edges come down against the middle."""
    edge, middle = result.at([0.0, 6.0]).deflection
    return float(edge - middle)


def find_root(f: Callable[[float], float], a: float, b: float, near: float) -> float:
    """Find a zero between two places by false position, the end that stays counting half (the Illinois rule)."""
    fa, fb = f(a), f(b)
    while abs(b - a) > near and fb != 0.0:
        c = b - fb * (b - a) / (fb - fa)
        fc = f(c)
        if fb * fc < 0.0:
            a, fa = b, fb
        else:
            fa /= 2.0
        b, fb = c, fc
        if abs(fb) < 1e-12:
            break
    return b


def find_stiffness(permitted: float) -> float:
    """Find the EI at which the slab bends by what is permitted."""
    return exp(find_root(lambda s: bending(with_stiffness(exp(s))) - permitted, log(1e3), log(1e6), 1e-9))


def main(folder: Path) -> None:
    """Find the stiffness for some permitted values, tell what the slab does, draw it."""
    print("bends by    EI        as thick as   rests from    to         largest moment")
    print("mm          kN m2     mm            m             m          kN m")
    for permitted in (PERMITTED / 2, PERMITTED, 1.5 * PERMITTED):
        EI = find_stiffness(permitted)
        result = with_stiffness(EI)
        zones = result.steps[-1].contact
        least = result.extremes["moment"]["min"].value
        thick = 1e3 * (12.0 * EI / CONCRETE) ** (1 / 3)
        print(f"{1e3 * permitted:5.1f} {EI:13.1f} {thick:10.0f} {zones[0].from_:15.4f} {zones[-1].to:11.4f} {least:16.3f}")
    folder.mkdir(parents=True, exist_ok=True)
    plot(with_stiffness(find_stiffness(PERMITTED)), folder / "slab_on_mound.png")
    print(f"The picture is in {folder / 'slab_on_mound.png'}")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else HERE.parent / "build")
