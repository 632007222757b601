"""States followed as the axial forces grow, and shapes of modes, by `axial_force` and `axial_modes`; see there.

Independent of gapbeam. A path is a row of states, near enough to each other that the next is never in doubt; a shape is
what loads of any kind make of the beam when it is almost at its buckling factor or frequency.
"""

from __future__ import annotations

import copy
from dataclasses import dataclass, field

import mpmath as mp

from .axial_cells import DIGITS
from .axial_force import Mechanism, Solution, solve

EVENT = 1e-4  # changes are known to this part of the path


@dataclass
class Path:
    """States from no axial force to all of it.

    Attributes
    ----------
    status : str
        "solved", or "buckles": no stable state at the end.
    end : Solution
        The last state.
    states : list of (factor, active)
        Every change, at a part of N_factor beyond it.
    jumps : list of float
        Parts of N_factor beyond which the next stable state is not near the last.
    """

    status: str = "solved"
    end: Solution | None = None
    states: list = field(default_factory=list)
    jumps: list = field(default_factory=list)


def stable_states(beam, factor, load_factor):
    """(active, deflections of one-sided supports) of all stable states."""
    found = solve(beam, factor, load_factor)
    if found.status != "solved":
        return []
    some = [active for active, negative, _ in found.sets if not negative]
    return [(active, solve(beam, factor, load_factor, active=active, stable=False)) for active in some]


def follow(beam, N_factor=1, load_factor=1, steps=16, least=1e-9):
    """The path as all axial forces grow from 0 to N_factor, with all loads in full.

    Parameters
    ----------
    beam : dict
        A scene with at most ten one-sided supports.
    N_factor, load_factor : number
    steps, least : int, float
        Steps to begin with; the shortest one, in parts of the whole: what is not near after it is a jump.

    Returns
    -------
    Path
    """
    with mp.workdps(DIGITS):
        path, done, step = Path(), mp.mpf(0), mp.mpf(1) / steps
        first = stable_states(beam, 0, load_factor)
        if not first:
            return Path("no-equilibrium")
        active, path.end = first[0]
        path.states.append((0.0, active))
        while done < 1:
            to = min(done + step, mp.mpf(1))
            states = stable_states(beam, to * N_factor, load_factor)
            states.sort(key=lambda one: apart(one[1], path.end))
            size = max(map(abs, path.end.deflection), default=mp.mpf(0))
            near = states and apart(states[0][1], path.end) <= size / 4
            sure = near and (len(states) == 1 or 4 * apart(states[0][1], path.end) < apart(states[1][1], path.end))
            changed = near and states[0][0] != path.states[-1][1]
            if path.status == "solved" and ((not sure and step > least) or (changed and step > EVENT)):
                step /= 4
                continue
            if not near and path.status == "solved" and not (path.jumps and done - path.jumps[-1] < EVENT):
                path.jumps.append(float(done))
            if states:
                path.status = "solved"
                if states[0][0] != path.states[-1][1]:
                    path.states.append((float(to), states[0][0]))
                path.end = states[0][1]
            else:
                path.status = "buckles"
            done, step = to, step * 2 if near else mp.mpf(1) / steps
        return path


def apart(one, other):
    """How far two states are from each other: at all marks, but the ends of cells."""
    marks = range(len(one.beam.marks))
    return max(abs(one.values["r", j, 0] - other.values["r", j, 0]) for j in marks)


class Mode:
    """The shape of a mode, its largest deflection 1 downward or upward.

    Parameters
    ----------
    beam : dict
    active : sequence of int
        One-sided supports that act, by their place in the scene.
    N_factor, omega : number
        A factor of `buckling`, or a frequency of `frequencies` at this factor; a simple one.

    Attributes
    ----------
    deflection, reaction : list of mpf
        Of the supports; a reaction is that of supports that act.
    """

    def __init__(self, beam, active=(), N_factor=1, omega=0):
        with mp.workdps(DIGITS):
            made = copy.deepcopy(beam)
            for s in made["supports"]:
                s.update(settlement=0, **({"gap": 0} if s.get("side", "both") != "both" else {}))
            made["loads"] = [{"type": "linear", "q": [1, -2]}, {"type": "curvature", "kappa": [1, 3]}]
            off = 1 + mp.mpf(10) ** -25
            found = solve(made, *((N_factor, 1, omega * off) if omega else (N_factor * off, 1)), active=active, stable=False)
            if not found.beam:
                raise Mechanism
            ends = found.extremes()["deflection"]
            self.size = max(ends["max"][0], ends["min"][0], key=abs)
            self.found = found
            self.deflection = [w / self.size for w in found.deflection]
            self.reaction = [r / self.size for r in found.reaction]

    def at(self, x):
        """Deflection at a place."""
        return self.found.at(x).deflection / self.size
