"""A chain of bars along the beam with links that act one way, yield or rub, in rational numbers.

Every link has the modes in which its rates may be: free, rigid, a spring, or sliding at a limit that is linear in time. All
combinations are tried, and the first one is taken whose rates do what the modes say: no pivoting, no search.
"""

from fractions import Fraction
from itertools import accumulate, pairwise, product

ZERO = Fraction(0)


class LooseError(Exception):
    """Nothing holds the chain, and nothing pushes it: where it is follows from nothing."""


class Link:
    """A link at a node.

    Parameters
    ----------
    node : int
        The node.
    kind : {"both", "side", "friction", "plastic"}
        What it is: a spring both ways, one that acts one way, friction, or a spring that yields either way.
    stiffness : Fraction or None
        None where it is rigid.
    side, contact : int, Fraction
        1 where it pushes to the left, -1 to the right, and where that begins.
    limit : Fraction
        Of what slides.
    """

    def __init__(self, node, kind, stiffness=None, side=0, contact=ZERO, limit=ZERO):
        self.node, self.kind, self.stiffness, self.side, self.contact, self.limit = node, kind, stiffness, side, contact, limit
        self.force = self.moved = ZERO
        self.acts = "rigid" if stiffness is None else "spring"

    def gap(self, u):
        """How far it is open."""
        return self.side * (self.contact + self.moved - u[self.node])

    def modes(self, u):
        """The modes in which its rates may be."""
        if self.kind == "both":
            return [self.acts]
        if self.kind == "side":
            if self.gap(u) > 0:
                return ["free"]
            return [self.acts] if self.side * self.force < 0 else ["free", self.acts]
        ways = [("to the left", self.limit), ("to the right", -self.limit)]
        return [self.acts, *(way for way, force in ways if self.force == force)]

    def fits(self, mode, u, velocity, rate, limit_rate):
        """Whether rates do what a mode says."""
        if self.kind == "side":
            if mode == "free":
                return self.gap(u) > 0 or self.side * velocity <= 0
            return self.force != 0 or self.side * rate <= 0
        if self.kind == "both":
            return True
        if mode == self.acts:
            return all(way * self.force != self.limit or way * rate <= limit_rate for way in (1, -1))
        return velocity <= 0 if mode == "to the left" else velocity >= 0

    def way(self, mode, u, velocity, rate, limit_rate):
        """How long the mode lasts; None: as long as nothing else happens."""
        if self.kind == "side" and mode == "free" and self.side * velocity > 0 and self.gap(u) > 0:
            return self.gap(u) / (self.side * velocity)
        if self.kind == "side" and mode != "free" and self.side * rate > 0 and self.force:
            return -self.force / rate
        if self.kind in ("friction", "plastic") and mode == self.acts:
            ways = [(self.limit - way * self.force, way * rate - limit_rate) for way in (1, -1)]
            return min((room / closing for room, closing in ways if closing > 0 and room > 0), default=None)
        return None


class Chain:
    """The chain; forces and displacements to the right, bars in tension.

    Parameters
    ----------
    stiffness : list of Fraction
        EA/L of the bars.
    links : list of Link
        The links.
    """

    def __init__(self, stiffness, links):
        self.stiffness, self.links = stiffness, links
        self.u, self.tension = [ZERO] * (len(stiffness) + 1), [ZERO] * len(stiffness)

    def go(self, load, longer, own, limit_rates, length):
        """Go on for a time with rates of loads, elongations, the links' own movements and limits.

        Returns
        -------
        list of Fraction
            Times of all kinks.
        bool
            Whether it comes to the end.
        """
        at, kinks = ZERO, []
        while True:
            found = self._rates(load, longer, own, limit_rates)
            if found is None:
                if not self._jump(load, limit_rates):
                    return kinks, False
                continue
            modes, rates, tensions, forces = found
            about = list(zip(self.links, modes, own, forces, limit_rates, strict=True))
            ways = [link.way(mode, self.u, rates[link.node] - v, rate, limit) for link, mode, v, rate, limit in about]
            step = min([length - at, *(way for way in ways if way is not None)])
            self.u = [u + step * rate for u, rate in zip(self.u, rates, strict=True)]
            self.tension = [n + step * rate for n, rate in zip(self.tension, tensions, strict=True)]
            for link, _, v, rate, limit in about:
                link.force += step * rate
                link.moved += step * v
                link.limit += step * limit
            at += step
            if at >= length:
                return kinks, True
            kinks.append(at)

    def _rates(self, load, longer, own, limit_rates):
        for modes in product(*(link.modes(self.u) for link in self.links)):
            found = self._rates_in(modes, load, longer, own, limit_rates)
            if found is None:
                continue
            rates, _, forces = found
            about = zip(self.links, modes, own, forces, limit_rates, strict=True)
            if all(link.fits(mode, self.u, rates[link.node] - v, rate, limit) for link, mode, v, rate, limit in about):
                return modes, *found
        return None

    def _rates_in(self, modes, load, longer, own, limit_rates):
        """Solve equilibrium of all nodes: N right of a node less N left of it, load and links add up to zero."""
        count = len(self.u)
        rows, right = [[ZERO] * count for _ in range(count)], [-ZERO - f for f in load]
        for i, (k, e) in enumerate(zip(self.stiffness, longer, strict=True)):
            for node, sign in ((i, 1), (i + 1, -1)):
                rows[node][i + 1] += sign * k
                rows[node][i] -= sign * k
                right[node] += sign * k * e
        held = {}
        for link, mode, v, limit in zip(self.links, modes, own, limit_rates, strict=True):
            if mode == "spring":
                rows[link.node][link.node] -= link.stiffness
                right[link.node] -= link.stiffness * v
            elif mode == "rigid":
                if link.node in held:
                    return None
                held[link.node] = v
            elif mode != "free":
                right[link.node] -= limit if mode == "to the left" else -limit
        for node, v in held.items():
            rows[node], right[node] = [Fraction(j == node) for j in range(count)], v
        rates = eliminate(rows, right)
        if rates is None:
            return None
        tensions = [k * (b - a - e) for k, a, b, e in zip(self.stiffness, rates[:-1], rates[1:], longer, strict=True)]
        forces = []
        for link, mode, v, limit in zip(self.links, modes, own, limit_rates, strict=True):
            forces.append({
                "free": ZERO, "rigid": None, "spring": -(link.stiffness or ZERO) * (rates[link.node] - v),
                "to the left": limit, "to the right": -limit,
            }[mode])  # fmt: skip
        out = [a - b for a, b in zip([ZERO, *tensions], [*tensions, ZERO], strict=True)]
        for k, link in enumerate(self.links):
            if forces[k] is None:
                others = (f for f, other in zip(forces, self.links, strict=True) if other.node == link.node and f is not None)
                forces[k] = out[link.node] - load[link.node] - sum(others, ZERO)
        return rates, tensions, forces

    def _jump(self, load, limit_rates):
        """Move all of it, where nothing holds it, until a link does; False where none comes."""
        if any(link.kind == "both" for link in self.links):
            return False
        for way in (1, -1):
            slides = [link for link in self.links if link.kind != "side"]
            one_way = [link for link in self.links if link.kind == "side"]
            if any(link.force != -way * link.limit for link in slides) or any(link.force for link in one_way):
                continue
            ahead = [link.gap(self.u) for link in one_way if link.side == way]
            if any(gap <= 0 for gap in ahead):
                continue
            rates = (rate for link, rate in zip(self.links, limit_rates, strict=True) if link.kind != "side")
            total = sum(load, ZERO) - way * sum(rates, ZERO)
            if not total:
                raise LooseError
            if way * total > 0:
                if not ahead:
                    return False
                self.u = [u + way * min(ahead) for u in self.u]
                return True
        return False


class LoadedChain:
    """The chain of a scene, with its loads.

    Parameters
    ----------
    beam : dict
        With spans, EA and alpha.
    supports, loads : list of dict
        Those across the beam first; loads along the beam stand at places `x`.
    """

    def __init__(self, beam, supports, loads):
        self.beam, self.supports, self.loads = beam, supports, loads
        ends = [Fraction(0), *accumulate(map(Fraction, beam["spans"]))]
        self.points = sorted({*ends, *(Fraction(load["x"]) for load in loads if load["type"] == "axial")})
        node = {x: i for i, x in enumerate(self.points)}
        self.across = [one for one in supports if one.get("direction") != "axial"]
        grown = {load["support"]: Fraction(load["value"]) for load in loads if load["type"] == "movement"}
        self.links, self.which, self.first, self.growth = [], [], [], []
        for k, one in enumerate(supports):
            place, stiffness = node[ends[one["node"]]], Fraction(one["stiffness"]) if "stiffness" in one else None
            gap, moved = Fraction(one.get("gap", 0)), Fraction(one.get("settlement", 0))
            if k < len(self.across):
                if not one.get("friction"):
                    continue
                link, moved = Link(place, "friction"), Fraction(0)
            elif one.get("side", "both") != "both":
                side = 1 if one["side"] == "left" else -1
                link, moved = Link(place, "side", stiffness, side, side * max(gap, Fraction(0))), side * min(gap, Fraction(0))
            elif "law" in one:
                (d, limit), _ = one["law"]
                link = Link(place, "plastic", Fraction(limit) / Fraction(d), limit=Fraction(limit))
            else:
                link = Link(place, "both", stiffness)
            self.links.append(link)
            self.which.append(k)
            self.first.append(moved)
            self.growth.append(grown.get(k, Fraction(0)))
        bars = [Fraction(beam["EA"]) / (b - a) for a, b in pairwise(self.points)]
        self.chain = Chain(bars, self.links)

    def rates(self, case):
        """Forces at the points, and elongations of the bars."""
        pushes, longer = [Fraction(0)] * len(self.points), [Fraction(0)] * (len(self.points) - 1)
        for load in self.loads:
            if load.get("case", "live") != case:
                continue
            if load["type"] == "axial":
                pushes[self.points.index(Fraction(load["x"]))] += Fraction(load["F"])
            elif load["type"] == "temperature":
                first, last = Fraction(load.get("from", 0)), Fraction(load.get("to", float(self.points[-1])))
                for i, (a, b) in enumerate(pairwise(self.points)):
                    if first <= a and b <= last:
                        longer[i] += Fraction(self.beam["alpha"]) * Fraction(load["dT"]) * (b - a)
        return pushes, longer


def eliminate(rows, right):
    """Solve a linear system; None where it has no unique solution."""
    system = [[*row, last] for row, last in zip(rows, right, strict=True)]
    for i in range(len(system)):
        pivot = next((j for j in range(i, len(system)) if system[j][i]), None)
        if pivot is None:
            return None
        system[i], system[pivot] = system[pivot], system[i]
        system[i] = [value / system[i][i] for value in system[i]]
        for j, row in enumerate(system):
            if j != i and row[i]:
                system[j] = [a - row[i] * b for a, b in zip(row, system[i], strict=True)]
    return [row[-1] for row in system]
