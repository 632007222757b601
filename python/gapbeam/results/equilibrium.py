"""Sums of loads beside sums of reactions: what every calculation sheet is checked by first."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..scene.loads import AxialLoad, AxialUniformLoad, ForceLoad, LinearLoad, MomentLoad, UniformLoad
from ..scene.names import DEAD
from ..scene.table import Point
from ..scene.temperature import is_held_along
from . import formatting as fmt
from .paths.compression_check import TENSION, ends_of_pieces

if TYPE_CHECKING:
    from collections.abc import Iterable

    from ..scene.structs import Scene
    from .result import Result
    from .state.step import Step

NONE, SAME = 1e-12, 1e-9
"""Sums below this share of what is added up are said to be zero; two that differ by a smaller share are the same."""
FAR = 2.0**960
"""Numbers above this are added up in this unit."""
SAME = 1e-12
"""Share of an axial force by which it may change along a stretch and is constant."""
BENT = 1e-9
"""Share of its slope by which that may change and is the same."""
PANELS, (POINTS, WEIGHTS) = 8, np.polynomial.legendre.leggauss(8)
"""Of the mean of a deflection along a stretch."""


class Sums(NamedTuple):
    """Resultants of loads, or of reactions.

    Attributes
    ----------
    force : float
        Across the beam; of loads downward, of reactions upward.
    moment : float
        About x = 0; of loads clockwise, of reactions counter-clockwise.
    axial : float
        Along the beam; of loads to the right, of reactions to the left.
    """

    force: float
    moment: float
    axial: float


def sum_of_loads(scene: Scene, factor: float) -> Sums:
    """Add up the loads of a scene.

    Parameters
    ----------
    scene : Scene
    factor : float
        Load factor of all loads but the dead ones.

    Examples
    --------
    >>> from gapbeam import Beam, ForceLoad, LinearLoad, Scene
    >>> scene = Scene(beam=Beam([6.0], EI=1.0), loads=[LinearLoad(q=(0.0, 4.0), case="dead"), ForceLoad(x=2.0, F=5.0)])
    >>> sum_of_loads(scene, 2.0)
    Sums(force=22.0, moment=68.0, axial=0.0)
    """
    found = resultants_of_loads(scene, factor)
    return Sums(*(_sum([getattr(one, name) for one in found]) for name in Sums._fields))


def resultants_of_loads(scene: Scene, factor: float) -> list[Sums]:
    """Give the resultant of every load of a scene.

    Parameters
    ----------
    scene, factor
        As for `sum_of_loads`.

    Returns
    -------
    list of Sums
        In the order of the loads; of imposed curvatures and movements of supports zeros.
    """
    found = []
    end, x = float(scene.span_ends()[-1]), scene.positions([one for one in scene.loads if isinstance(one, Point)])
    places = iter(np.asarray(x, dtype=float).tolist())
    for load in scene.loads:
        share = 1.0 if load.case == DEAD else factor
        at = next(places) if isinstance(load, Point) else 0.0
        force = moment = axial = 0.0
        if isinstance(load, ForceLoad):
            force, moment = share * load.F, share * load.F * at
        elif isinstance(load, MomentLoad):
            moment = share * load.M
        elif isinstance(load, AxialLoad):
            axial = share * load.F
        elif isinstance(load, AxialUniformLoad):
            axial = share * load.q * ((end if load.to is None else load.to) - load.from_)
        elif isinstance(load, UniformLoad | LinearLoad):
            first, last = (load.q, load.q) if isinstance(load, UniformLoad) else load.q
            length = (end if load.to is None else load.to) - load.from_
            force = share * 0.5 * (first + last) * length
            moment = share * length * (0.5 * (first + last) * load.from_ + length * (first + 2.0 * last) / 6.0)
        found.append(Sums(force, moment, axial))
    return found


def sum_of_reactions(scene: Scene, step: Step) -> Sums:
    """Add up the reactions of supports and ground.

    Parameters
    ----------
    scene : Scene
    step : Step
        A state of it.

    Returns
    -------
    Sums
        Its moment is that of the supports alone.
    """
    directions = np.array([support.direction for support in scene.supports], dtype=object)
    normal, axial = directions == "normal", directions == "axial"
    x, reaction = np.asarray(scene.positions(scene.supports), dtype=float), step.reaction
    across = np.where(normal, reaction, 0.0)
    ground = [zone.resultant for zone in step.contact]
    with np.errstate(over="ignore"):
        moment = across * x
    return Sums(
        _sum([*across.tolist(), *ground]), _sum([*moment.tolist(), *(-step.couple).tolist()]),
        -_sum([*reaction[axial].tolist(), *step.friction.tolist(), *_ground_along(scene, step)]),
    )  # fmt: skip


def _ground_along(scene: Scene, step: Step) -> list[float]:
    """Forces on the beam, to the right, of ground along it: what axial forces leave between the ends of pieces, less the loads."""
    if not step._beam.is_on_axial_ground:
        return []
    left, right = (step.values(*ends)[TENSION] for ends in ends_of_pieces(step._beam))
    taken = left - right
    # Beside what it takes both ways, rounding
    taken[np.abs(taken) <= NONE * max((abs(one.friction) for one in step.slip_zones), default=0.0)] = 0.0
    loads = zip(scene.loads, resultants_of_loads(scene, step.factor), strict=True)
    return [*taken.tolist(), *(-sums.axial for load, sums in loads if isinstance(load, AxialUniformLoad))]


class AxialRun(NamedTuple):
    """A stretch of the beam along which its axial force is constant or linear.

    Attributes
    ----------
    from_, to : float
        Its ends.
    left, right : float
        The force there, tension positive.
    """

    from_: float
    to: float
    left: float
    right: float


def axial_forces(scene: Scene) -> list[AxialRun]:
    """Give the axial forces that are given, from left to right.

    Examples
    --------
    >>> from gapbeam import Beam, Scene, Section
    >>> for run in axial_forces(Scene(beam=Beam([4.0, 4.0], EI=1.0, N=5.0), sections=[Section(from_=6.0, N=-2.0)])):
    ...     print(run)
    AxialRun(from_=0.0, to=6.0, left=5.0, right=5.0)
    AxialRun(from_=6.0, to=8.0, left=-2.0, right=-2.0)
    """
    ends = scene.span_ends()
    sections = [(*fmt.stretch(scene, one), one.N) for one in scene.sections if one.N is not None]
    cuts = np.unique([*ends, *(x for from_, to, _ in sections for x in (from_, to))])
    middle = (cuts[:-1] + cuts[1:]) / 2.0
    force = np.broadcast_to(np.asarray(scene.beam.N, dtype=float), len(ends) - 1)[np.searchsorted(ends, middle) - 1].copy()
    for from_, to, N in sections:
        force[(from_ <= middle) & (middle <= to)] = N
    return _runs(cuts, force, force)


def feels_axial_force(result: Result) -> bool:
    """Tell whether bending feels an axial force, not only a shear of the ground.

    Parameters
    ----------
    result : Result
        Of one load or of combinations.
    """
    return result._beam.feels_axial_loads or any(run.left for run in axial_forces(result.scene))


def _runs(cuts: np.ndarray, left: np.ndarray, right: np.ndarray) -> list[AxialRun]:
    """Stretches along which the force is constant or linear, from those between the cuts."""
    slope, size = (right - left) / np.diff(cuts), np.maximum(np.abs(left), np.abs(right))
    jumps = np.abs(left[1:] - right[:-1]) > SAME * np.minimum(size[1:], size[:-1])
    bends = np.abs(np.diff(slope)) > BENT * np.minimum(np.abs(slope[1:]), np.abs(slope[:-1]))
    first = np.flatnonzero(np.append(True, jumps | bends))
    last = np.append(first[1:], len(left)) - 1
    columns = cuts[first], cuts[last + 1], left[first], right[last]
    return [AxialRun(*row) for row in zip(*(column.tolist() for column in columns), strict=True)]


def acting_axial_forces(result: Result, step: Step) -> list[AxialRun]:
    """Give the axial forces that bending feels in a state: those given, as far as they have grown, and those of axial loads.

    Parameters
    ----------
    result : Result
        Of one load.
    step : Step
        One of its states.
    """
    scene, beam = result.scene, result._beam
    share = step.factor if scene.analysis.N_with == "live" else 1.0
    runs = [AxialRun(from_, to, share * left, share * right) for from_, to, left, right in axial_forces(scene)]
    if not beam.feels_axial_loads:
        return runs
    x = beam.places.point_x
    middle, quarter = (x[:-1] + x[1:]) / 2.0, (x[1:] - x[:-1]) / 4.0
    given = np.array([run.left for run in runs])[np.searchsorted([run.to for run in runs[:-1]], middle)]
    inside = result.at_state(step, middle).axial_force
    changes = np.zeros(len(middle))
    if any(isinstance(load, AxialUniformLoad) for load in scene.loads):
        before, after = (result.at_state(step, middle + sign * quarter).axial_force for sign in (-1, 1))
        changes = after - before
        changes[np.abs(changes) <= SAME * np.abs(inside)] = 0.0
    return _runs(x, given + inside - changes, given + inside + changes)


class Turning(NamedTuple):
    """A moment about x = 0, clockwise, of a force along the deflected beam."""

    of: str
    x: float
    moment: float


def moments_on_deflected_axis(result: Result, step: Step) -> list[Turning]:
    """Give the moments about x = 0 of axial forces that bending feels, and of ground that resists slopes.

    Parameters
    ----------
    result : Result
        Of one load.
    step : Step
        One of its states.

    Returns
    -------
    list of Turning
        One for each place where the axial force begins, changes or ends.
    """
    scene, changes = result.scene, []
    if result._beam.has_axial_force:
        runs = acting_axial_forces(result, step)
        before, after = [0.0, *(run.right for run in runs)], [*(run.left for run in runs), 0.0]
        places = [0.0, *(run.to for run in runs)]
        changes += [("axial force N", x, right - left) for x, left, right in zip(places, before, after, strict=True)]
    for one in scene.foundation:
        if one.shear:
            from_, to = fmt.stretch(scene, one)
            changes += [("shear of the ground", from_, one.shear), ("shear of the ground", to, -one.shear)]
    if not changes:
        return []
    deflection = result.at_state(step, np.array([x for _, x, _ in changes])).deflection.tolist()
    return [Turning(of, x, w * by) for (of, x, by), w in zip(changes, deflection, strict=True) if w * by] + _along(result, step)


def _along(result: Result, step: Step) -> list[Turning]:
    """Moments of what the axial force changes by along a stretch, from the mean deflection there."""
    found = []
    for from_, to, left, right in acting_axial_forces(result, step) if result._beam.has_axial_force else ():
        if left != right:
            x = from_ + (to - from_) * (np.arange(PANELS)[:, None] + (POINTS + 1.0) / 2.0).ravel() / PANELS
            mean = float(np.tile(WEIGHTS, PANELS) @ result.at_state(step, x).deflection) / (2.0 * PANELS)
            found.append(Turning("axial force N", (from_ + to) / 2.0, mean * (right - left)))
    return found


def _sum(values: Iterable[float]) -> float:
    """Add up; what is left of nothing but rounding is zero."""
    values = list(values)
    if not all(map(math.isfinite, values)):
        return float(np.sum(values))
    largest = max(map(abs, values), default=0.0)
    # A sum on the way may be out of range where the last one is not
    unit = FAR if largest > FAR else 1.0
    total = unit * math.fsum(value / unit for value in values)
    return 0.0 if abs(total) <= NONE * largest else total


def without_rounding(reactions: float, loads: float) -> tuple[float, float]:
    """Give both sums as one number where they are: rounding would be seen where it decides on the last digit that is shown."""
    return (loads if math.isclose(reactions, loads, rel_tol=SAME) else reactions, loads)


def balance_in_words(result: Result, step: Step) -> list[str]:
    """Set the sums of reactions above those of loads.

    Parameters
    ----------
    result : Result
        Of one load.
    step : Step
        A state of it.

    Returns
    -------
    list of str
        Two lines: forces; moments where only supports carry; forces along the beam where supports hold it.
    """
    scene = result.scene
    sums = sum_of_reactions(scene, step), sum_of_loads(scene, step.factor)
    parts = [("", "force", [one.force for one in sums])]
    if not len(scene.foundation):
        along = [one.moment for one in moments_on_deflected_axis(result, step)]
        parts.append(("moment about x = 0", "moment", [sums[0].moment, _sum([sums[1].moment, *along])]))
    if is_held_along(scene):
        parts.append(("along the beam", "force", [one.axial for one in sums]))
    lines = ["Sum of reactions  ", "Sum of loads      "]
    for name, quantity, values in parts:
        texts = [fmt.value(scene, quantity, value) for value in without_rounding(*values)]
        width = max(map(len, texts))
        lead = f"   {name}  " if name else ""
        lines = [f"{line}{lead if k == 0 else ' ' * len(lead)}{texts[k]:<{width}}" for k, line in enumerate(lines)]
    return [line.rstrip() for line in lines]
