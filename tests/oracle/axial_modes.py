"""Negative modes, buckling factors and frequencies of a beam with given supports, in many digits; see `axial_force`.

Independent of gapbeam: the dynamic stiffness of cells (w and psi at their ends), so short that none of them buckles or
swings between clamped ends, eliminated from left to right. The negative pivots are the count of Wittrick and Williams; a
bracket that holds one more is closed with the determinant, which has no poles there.

Examples
--------
>>> column = {"beam": {"spans": [1.0], "EI": 1.0, "N": -1.0}, "supports": [{"node": 0}, {"node": 1}]}
>>> [round(float(one), 12) for one in buckling(column, (), 2)]
[9.869604401089, 39.478417604357]
"""

from __future__ import annotations

import mpmath as mp

from .axial_cells import DIGITS, Beam, Cell, stiffness_of

RIGID = mp.mpf(10) ** 40  # times the stiffest part: EI of a rigid one, far beyond the digits asked for
CLOSE = 30  # digits of factors and frequencies


class Chain:
    """Elimination of a beam's dynamic stiffness from left to right: `negative` modes, `zero` pivots and the `determinant`.

    Parameters
    ----------
    scene : dict
    active : sequence of int
        One-sided supports that act, by their place in the scene.
    N_factor, omega : number
    like : Chain, optional
        Whose cells are taken.
    """

    def __init__(self, scene, active=(), N_factor=1, omega=0, like=None):
        self.beam = beam = Beam(scene, N_factor, 1, omega)
        self.negative, self.zero, self.determinant, self.known = 0, 0, mp.mpf(1), {}
        self.parts, self.like = [], like.parts if like else None
        self.size = {"w": mp.mpf(0), "p": mp.mpf(0)}  # of what pivots are the sum of
        sizes = [abs(c[0].N) * beam.length**2 + c[0].EI for c in beam.cells if mp.isfinite(c[0].EI)]
        self.rigid = RIGID * max([*sizes, mp.mpf(1)])
        S = {}  # stiffness of what is left of here: (i, j) -> value, over "w", "p"
        free = []
        for j, x in enumerate(beam.marks):
            S, free = self.node(x, S, free, active)
            if j < len(beam.cells):
                for cell in self.short(beam.cells[j], beam.tapers[j]):
                    S, free = self.over(cell, S, free)
        self.reduce(S, free)

    def node(self, x, S, free, active):
        """Add what stands at a mark, and hold what it holds."""
        beam = self.beam
        S = {(a, b): S.get((a, b), mp.mpf(0)) for a in "wp" for b in "wp"}
        free = list("wp")
        here = [(i, s) for i, s in enumerate(beam.supports) if s.x == x]
        stiff = {"w": mp.mpf(0), "left": mp.mpf(0), "right": mp.mpf(0)}
        for i, s in here:
            if not s.side or i in active:
                stiff["w"] += s.stiffness
            stiff[s.at_hinge if x in beam.hinges and s.at_hinge else "left"] += s.rotation
        S["w", "w"] -= sum((m for at, m in beam.masses if at == x), mp.mpf(0)) * beam.omega**2
        S, free = self.spring(S, free, "w", stiff["w"])
        S, free = self.spring(S, free, "p", stiff["left"])
        if x in beam.hinges:
            c, beyond = beam.hinges[x], {"w": "w", "q": "p"}  # q: rotation right of it
            S = {(a, b): S.get((a, b), mp.mpf(0)) for a in "wpq" for b in "wpq"}
            S["p", "p"], S["q", "q"], S["p", "q"], S["q", "p"] = S["p", "p"] + c, c, -c, -c
            if "p" in free:
                self.size["p"] += c
                S, _ = self.pivot(S, [*free, "q"], "p")
            free = ["w", "p"] if "w" in free else ["p"]
            S = {(a, b): S.get((a, b), mp.mpf(0)) for a in "wq" for b in "wq"}
            S = {(beyond[a], beyond[b]): v for (a, b), v in S.items()}
            S, free = self.spring(S, free, "p", stiff["right"])
        return S, free

    @staticmethod
    def spring(S, free, name, stiffness):
        if mp.isinf(stiffness):
            return S, [a for a in free if a != name]
        return {**S, (name, name): S[name, name] + stiffness}, free

    def pivot(self, S, free, name):
        """Eliminate one displacement."""
        d = S[name, name]
        if abs(d) <= mp.mpf(10) ** (-mp.mp.dps * 2 // 3) * self.size[name]:  # rounding: a motion that costs nothing
            self.zero += 1
            d = mp.mpf(10) ** (-mp.mp.dps // 3) * self.size[name]
        self.negative += d < 0
        self.determinant *= d
        rest = [a for a in free if a != name]
        return {(a, b): S[a, b] - S[a, name] * S[name, b] / d for a in rest for b in rest}, rest

    def reduce(self, S, free):
        for name in list(free):
            S, free = self.pivot(S, free, name)

    def short(self, cells, tapered):
        """A part of the beam in cells that have no mode of their own between clamped ends."""
        cell, length, parts = cells[0], cells[0].h * len(cells), len(cells)
        EI = min(one.EI * min(mp.mpf(1), (1 + one.growth) ** one.power) for one in cells)
        EI = EI if mp.isfinite(EI) else self.rigid
        lift = max(-cell.k[0], -(cell.k[0] + cell.k[1] * length), mp.mpf(0))
        while True:
            h = length / parts
            push, room = max(-cell.N, mp.mpf(0)) + lift * (h / mp.pi) ** 2, EI * (mp.pi / h) ** 2
            if push == 0 or (room > push and push * room / (room - push) < cell.GA):
                break
            parts *= 2
            if parts > 10**6:
                raise ValueError("the compression reaches GA")
        parts = self.like[len(self.parts)] if self.like else parts
        self.parts.append(parts)
        h, none = length / parts, (mp.mpf(0),) * 2
        for n in range(parts):
            yield Cell(cell.a + n * h, h, **stiffness_of(tapered, EI, cell.a + n * h, h), GA=cell.GA, N=cell.N,
                       k=(cell.k[0] + cell.k[1] * n * h, cell.k[1]), q=none, kappa=none)  # fmt: skip

    def over(self, cell, S, free):
        """What is left of the right end of a cell."""
        key = (cell.h, cell.EI, cell.GA, cell.N, cell.k, cell.growth, cell.power)
        if key not in self.known:
            self.known[key] = stiffness(cell.transfer({})[0])
        K = self.known[key]
        whole = {(a, b): S[a, b] + K[a, b] for a in free for b in free}
        for a in "wp":
            self.size[a] += abs(K[a, a])
        for a in free:
            for b in "WP":
                whole[a, b] = whole[b, a] = K[a, b]
        for a in "WP":
            for b in "WP":
                whole[a, b] = K[a, b]
        names = [*free, "W", "P"]
        for name in free:
            whole, names = self.pivot(whole, names, name)
        self.size = {"w": abs(K["W", "W"]), "p": abs(K["P", "P"])}
        return {(a.lower(), b.lower()): v for (a, b), v in whole.items()}, ["w", "p"]


def stiffness(columns):
    """Stiffness over w, p at the left and W, P at the right end from the transfer of (w, psi, M, T)."""
    E = [[columns[j][i] for j in range(4)] for i in range(4)]
    det = E[0][2] * E[1][3] - E[0][3] * E[1][2]
    inverse = [[E[1][3] / det, -E[0][3] / det], [-E[1][2] / det, E[0][2] / det]]  # of d_b by (M_a, T_a)
    K = {}
    for name, d in (("w", (1, 0, 0, 0)), ("p", (0, 1, 0, 0)), ("W", (0, 0, 1, 0)), ("P", (0, 0, 0, 1))):
        rest = [d[2 + i] - E[i][0] * d[0] - E[i][1] * d[1] for i in range(2)]
        M, T = (inverse[i][0] * rest[0] + inverse[i][1] * rest[1] for i in range(2))
        start = (d[0], d[1], M, T)
        Mb, Tb = (sum(E[i][j] * start[j] for j in range(4)) for i in (2, 3))
        K.update({("w", name): -T, ("p", name): M, ("W", name): Tb, ("P", name): -Mb})
    return K


def inertia(beam, active=(), N_factor=1, omega=0):
    """Number of negative eigenvalues of the (dynamic) stiffness with given supports; motions that cost nothing are not counted.

    Parameters
    ----------
    beam : dict
        A scene.
    active : sequence of int
        One-sided supports that act, by their place in the scene.
    N_factor, omega : number

    Returns
    -------
    int
    """
    with mp.workdps(digits(beam)):
        return int(Chain(beam, active, N_factor, omega).negative)


def first_values(chain_at, n, scale, most=mp.inf):
    """The first n values above 0 at which the count of negative modes rises; fewer where doubling finds no more.

    Parameters
    ----------
    chain_at : function of (value, chain or None)
        The elimination at a value, cut like another.
    n : int
    scale, most : number
        To begin with, and to end with.

    Returns
    -------
    list of mpf
    """
    chains = {mp.mpf(0): chain_at(mp.mpf(0), None)}
    base, found, high = chains[0].negative, [], mp.mpf(scale)

    def count(value, fine=False):
        if value not in chains:
            with mp.workdps(mp.mp.dps if fine else mp.mp.dps // 2):
                chains[value] = chain_at(value, None)
        return chains[value].negative - base

    for _ in range(100):
        if count(high) >= n or high > most:
            break
        high *= 2
    while len(found) < min(n, count(high)):
        k = len(found)
        a, b = max(t for t in chains if count(t) <= k), min(t for t in chains if count(t) > k)
        while b - a > mp.mpf(10) ** -CLOSE * b and b > scale * mp.mpf(10) ** -18:
            if a and count(a) == k and count(b) == k + 1 and b < a * mp.mpf("1.6"):
                break
            middle = (a + b) / 2 if a else b / 8
            a, b = (a, middle) if count(middle, b - a < b / 10**9) > k else (middle, b)
        if count(b) > k + 1 or not a:
            found += [b if a else mp.mpf(0)] * (count(b) - k)  # several at once, or motions that cost nothing
        else:
            found.append(zero(lambda t, like=chains[b]: chain_at(t, like).determinant, a, b))
    return found[:n]


def zero(f, a, b):
    """A bracketed simple zero (Anderson and Bjorck), to a few digits more than asked for."""
    fa, fb = f(a), f(b)
    for step in range(200):
        if abs(b - a) <= mp.mpf(10) ** (-CLOSE - 5) * abs(b) or fb == 0:
            break
        c = b - fb * (b - a) / (fb - fa) if step % 8 < 7 else (a + b) / 2
        fc = f(c)
        if fc * fb < 0:
            a, fa = b, fb
        else:
            share = 1 - fc / fb
            fa *= share if share > 0 else mp.mpf("0.5")
        if abs(c - b) <= mp.mpf(10) ** (-CLOSE - 5) * abs(c):
            return c
        b, fb = c, fc
    return b


def digits(scene):
    """Digits to work with: rigid parts take more."""
    stiff = [scene["beam"]["EI"], *(s.get("EI", 1) for s in scene.get("sections", ()))]
    rigid = any(mp.isinf(v) for one in stiff if not isinstance(one, dict) for v in (one if isinstance(one, list) else [one]))
    return DIGITS * 2 if rigid else DIGITS


def buckling(beam, active=(), n=1):
    """The first n factors of all axial forces at which the beam with given supports buckles.

    Parameters
    ----------
    beam : dict
        A scene; it is stable without axial forces.
    active : sequence of int
        One-sided supports that act, by their place in the scene.
    n : int

    Returns
    -------
    list of mpf
        Fewer where there are no more. None above 0.996 times the factor at which some N reaches GA, whatever holds the beam.
    """
    with mp.workdps(digits(beam)):
        read = Beam(beam, 0)
        layers = [part[0].N for part in read.cells]
        parts = [(part[0], N, layer) for part, N, layer in zip(read.cells, read.axial, layers, strict=True) if N < 0]
        if not parts:
            return []
        bounds = [(cell.GA + layer) / -N for cell, N, layer in parts if mp.isfinite(cell.GA)]
        most = min(bounds, default=mp.inf)  # where shear itself buckles
        size = [cell.EI for cell, _, _ in parts if mp.isfinite(cell.EI)] or [abs(N) * read.length**2 for _, N, _ in parts]
        scale = min(size) / read.length**2 / max(-N for _, N, _ in parts)

        def factor(t):
            return most * t / (1 + t) if bounds else t

        scale, last = (scale / most, 256) if bounds else (scale, mp.inf)
        found = first_values(lambda t, like: Chain(beam, active, factor(t), 0, like), n, scale, last)
        return [factor(t) for t in found]


def frequencies(beam, active=(), n=1, N_factor=1):
    """The first n circular frequencies of the beam with given supports.

    Parameters
    ----------
    beam : dict
        With `mass` of the beam, and `masses`.
    active : sequence of int
    n : int
    N_factor : number

    Returns
    -------
    list of mpf
        Of motions that cost nothing: 0. What is unstable has none.
    """
    with mp.workdps(digits(beam)):
        read = Beam(beam, N_factor)
        mass = sum(m * part[0].h * len(part) for m, part in zip(read.mass, read.cells, strict=True))
        mass += sum(m for _, m in read.masses)
        if not mass:
            return []
        size = [part[0].EI for part in read.cells if mp.isfinite(part[0].EI)] or [mp.mpf(1)]
        scale = mp.sqrt(min(size) / (mass * read.length**3))
        return first_values(lambda t, like: Chain(beam, active, N_factor, t, like), n, scale)


def unstable(beam, active=(), N_factor=0):
    """Whether some motion of the beam with given supports has no resistance, or less than none; default: without axial forces."""
    with mp.workdps(digits(beam)):
        chain = Chain(beam, active, N_factor)
        return bool(chain.negative or chain.zero)
