"""Decides in ball arithmetic whether the zones in which a beam lies on the ground are right; it shares nothing with gapbeam.

python proof_checker_ground.py FILE (from `gapbeam prove`) ends with a line and exit status 0 proved, 1 refuted, 2 undecided.
Beam, loads and supports are read by proof_checker.py, which lies beside it. Ground: layers that push with k (w - c) where w is
beyond their surface c, and nowhere else; k is constant in a layer, c linear between points. With the zones given all is linear:

    w' = psi + V/GA,  psi' = kappa - M/EI,  M' = V,  V' = -q + sum of k (w - c) over the layers that act there,

so z = (w, psi, M, V, 1, x) has z' = A z, A constant on a piece, and z(x) = exp(A x) z(0), in balls. What is proved:
1. The ends of zones. A free end e (none of the layer's own) has to have f = w - c = 0 there. The file's ends are improved by
   Newton's method; then a small box around them holds exactly one zero of all f (Krawczyk): the derivative of f at e by this end
   is f', and by any end p (this one also) k f(p) times the deflection that a unit force at p gives, all in balls for all ends in
   the box, up to a sign. The file's ends are compared with the box.
2. All that follows is in balls for all ends in the box: no pivot is 0; acting layers are pressed, others are not reached; next to a
   free end, or a rigid support as high as the ground, where f = 0 holds exactly, by the sign of f', else by that of f; supports act
   as stated. So it is an equilibrium; as no law falls (or proof_checker.py says so) there is no other. Values are compared.
A state is refuted where the beam on exactly these zones leaves the ground elsewhere than at their ends, or a sign is wrong."""

import sys
from bisect import bisect_right
from collections import defaultdict

from flint import arb, arb_mat, ctx, fmpq  # pip install python-flint
from proof_checker import FORCE, LEFT, RIGHT, ZERO, Answer, Beam, W, decide, eliminate, exact, inverse, main

M, V, TERMS = FORCE, FORCE + 1, 10  # unknowns at the left end of a piece, forces of supports come after; terms of Taylor's series
KNOWN, NEAR = {"from", "to", "k", "side", "gap", "profile", "law", "name"}, exact(1e-9)  # NEAR: errors allowed, as shares
class Layer:
    """One layer of the ground: where it is, its surface, and the pieces on which it acts."""
    def __init__(self, number, table, beam, zones):
        if odd := set(table) - KNOWN | set("k" * ("[[" in str(table.get("k")))): raise Answer(2, f"{sorted(odd)} is not known here")
        law, k, both = table.get("law"), table.get("k"), table.get("side", "both") == "both"
        if law is not None and ("{" in str(law) or len(law) != 1): raise Answer(2, "laws of ground that are no straight line")
        k = [exact(law[0][1]) / exact(law[0][0])] if law else [*map(exact, k if isinstance(k, list) else [k])]
        if len(set(k)) > 1 or k[0] <= 0: raise Answer(2, "a modulus that varies or is 0")
        self.k, self.name, self.pieces = k[0], f"foundation {number}", beam.stretch(table)
        self.side = {"below": 1, "above": -1, "both": 0}[table.get("side", "both")]
        ends, gap = (beam.x[self.pieces.start], beam.x[self.pieces.stop]), table.get("gap", 0.0)
        points = [(beam.where(x), exact(g)) for x, g in table.get("profile") or ()]
        points = points or [*zip(ends, map(exact, gap if isinstance(gap, list) else (gap, gap)), strict=True)]
        if both and any(g for _, g in points): raise Answer(2, "ground on both sides with a gap")
        self.surface = [self.side * between(points, x) for x in beam.x]
        parts = [range(*(beam.number[beam.where(float.fromhex(x))] for x in zone[1:])) for zone in zones if zone[0] == number]
        acting = [i for part in parts for i in part]
        if not all(parts): raise Answer(2, f"{self.name} is only touched")
        self.acting = set(acting)
        if len(self.acting) < len(acting) or self.acting - set(self.pieces): raise Answer(1, f"zones of {self.name} overlap")
        if both and self.acting != set(self.pieces): raise Answer(1, f"{self.name} holds both ways and acts everywhere")
        self.ends = [i for i in self.pieces[1:] if (i in self.acting) != (i - 1 in self.acting)]  # free ones
    def slope(self, beam, i): return (self.surface[i + 1] - self.surface[i]) / (beam.x[i + 1] - beam.x[i])
def between(points, x):
    """Straight between points, constant beyond them."""
    k = bisect_right([p for p, _ in points], x)
    if k in (0, len(points)): return points[k - (k > 0)][1]
    (a, u), (b, v) = points[k - 1 : k + 1]
    return u + (v - u) * (x - a) / (b - a)
class Ground:
    """A beam on layers, with the zones of the file; shifts are balls by which free ends stand off the file's."""
    def __init__(self, file):
        scene, zones, values, length = dict(file["scene"]), file["zones"], file["values"], sum(file["scene"]["beam"]["spans"])
        tables = scene.pop("foundation")
        if {zone[0] for zone in zones} - set(range(len(tables))): raise Answer(1, "zones of no foundation")
        given = [{key: t.get(key) for key in ("from", "to")} for t in tables]
        given += [{"x": x} for t in tables for x, _ in t.get("profile") or () if 0 < x < length]
        ends = [{"x": float.fromhex(x)} for zone in zones for x in zone[1:]]
        fixed, self.beam = (Beam(scene | {"sections": [*scene.get("sections", []), *marks]}) for marks in (given, given + ends))
        beam, self.free = self.beam, {}  # of place: layer
        self.layers = [Layer(n, table, beam, zones) for n, table in enumerate(tables)]
        beam.springs, beam.load = [None, None], defaultdict(fmpq)  # M, V; loads at places, others are in A
        for load in scene.get("loads", []):
            if load["type"] == "force": beam.load[beam.place(load), W] += exact(load["F"])
            elif load["type"] == "moment": beam.load[beam.place(load), LEFT] += exact(load["M"])
        self.acting = [beam.act(*one) for one in zip(beam.supports, file["states"], values["deflection"], strict=True)]
        rigid = {(at, rest) for at, form, rest, compliance in beam.springs[2:] if compliance == 0 and (at, W) in form}
        self.zeros = {(at, n) for n, layer in enumerate(self.layers) for at, rest in rigid if rest == layer.surface[at]}
        for i, n in ((i, n) for n, layer in enumerate(self.layers) for i in layer.ends if (i, n) not in self.zeros):
            if beam.x[i] in fixed.x or i in self.free: raise Answer(2, "a zone ends where something else does")
            self.free[i] = n
        self.zeros |= set(self.free.items())
    def rates(self, i, shifts):
        """A on piece i, x from its left end, and its length."""
        beam, shift, L0 = self.beam, shifts.get(i, arb(0)), self.beam.x[i + 1] - self.beam.x[i]
        (EI, GA), ((qa, qb), (ka, kb)), A = *([of[i] for of in d.values()] for d in (beam.stiff, beam.spread)), arb_mat(6, 6)
        level, rise = qa + (qb - qa) / L0 * shift, (qb - qa) / L0
        for layer in (layer for layer in self.layers if i in layer.acting):
            A[3, 0], slope = A[3, 0] + layer.k, layer.slope(beam, i)
            level, rise = level + layer.k * (layer.surface[i] + slope * shift), rise + layer.k * slope
        A[0, 1], A[0, 3], A[1, 2], A[1, 4], A[1, 5] = 1, inverse(GA), -inverse(EI), ka + (kb - ka) / L0 * shift, (kb - ka) / L0
        A[2, 3], A[3, 4], A[3, 5], A[5, 4] = 1, -level, -rise, 1
        return A, L0 + shifts.get(i + 1, 0) - shift
    def scales(self, A, L):
        """Units of z in which A is about as small as can be, powers of 2: balls grow less. They prove nothing."""
        size, k, soft = float(L.mid()), float(A[3, 0].mid()), -float(A[1, 2].mid())
        size = min(size, (k * soft) ** -0.25) if k * soft else size
        force = 1 / soft if soft else k * size**4 or 1.0
        units = [1.0, 1 / size, force / size**2, force / size**3]
        one = 1 / max([abs(float(A[r, c].mid())) * size ** (c - 3) / units[r] for r in range(4) for c in (4, 5)] + [1e-300])
        return [arb(2) ** round(float(arb(u).log() / arb(2).log())) for u in (*units, one, one * size)]
    def solve(self, shifts, push=None):
        """Deflections, rotations and forces, of all loads or of a unit force at a place alone; pieces as (A, units, L, z)."""
        beam, rows, balance, load = self.beam, [], defaultdict(lambda: defaultdict(arb)), defaultdict(arb)
        pieces, given = [], int(push is None)
        for d, F in (beam.load if push is None else {(push, W): 1}).items(): load[d] += F
        for i in range(len(beam.x) - 1):
            A, L = self.rates(i, shifts)
            d, turned = self.scales(A, L), (i, RIGHT if i in beam.hinges else LEFT)
            A = arb_mat(6, 6, [A[r, c] * d[c] / d[r] for r in range(6) for c in range(6)])
            T, start = (A * L).exp(), ((i, W), turned, (i, M), (i, V))
            T = [[*(T[r, c] * d[r] / d[c] for c in range(4)), T[r, 4] * d[r] / d[4] * given] for r in range(4)]
            rows += [({**dict(zip(start, T[r][:4], strict=True)), (i + 1, u): -1}, -T[r][4]) for r, u in ((0, W), (1, LEFT))]
            balance[i, W][i, V] -= 1
            balance[turned][i, M] += 1
            for r, u, sign in (3, (i + 1, W), 1), (2, (i + 1, LEFT), -1):
                for c, unknown in enumerate(start): balance[u][unknown] += sign * T[r][c]
                load[u] -= sign * T[r][4]
            pieces.append((A, d, L, start))
        for n, (at, form, rest, compliance) in enumerate(beam.springs[2:], 2):
            rows.append(({**form, (at, FORCE + n): -compliance}, rest * given))
            for d, c in form.items(): balance[d][at, FORCE + n] += c
        rows += [(form, load[d]) for d, form in balance.items()]
        u = eliminate([({d: c for d, c in form.items() if not c == 0}, right) for form, right in rows], arb)
        return u, [(A, d, L, arb_mat(6, 1, [*(u[start[k]] / d[k] for k in range(4)), 1 / d[4], 0])) for A, d, L, start in pieces]
    def ends(self, u, shifts):
        """f and f' at the free ends."""
        slope, soft = {i: self.layers[n].slope(self.beam, i) for i, n in self.free.items()}, self.beam.stiff["GA"]
        surface = {i: self.layers[n].surface[i] + slope[i] * shifts[i] for i, n in self.free.items()}
        return {i: (u[i, W] - surface[i], u[i, LEFT] + u[i, V] * inverse(soft[i]) - slope[i]) for i in self.free}
    def settle(self):
        """Shifts as balls that hold the true ends, and the largest of them as a share of the length."""
        beam, shifts = self.beam, {i: arb(0) for i in self.free}
        length, delta = beam.x[-1], arb(beam.x[-1]) * arb(2) ** (-ctx.prec // 2)
        for turn in range(ctx.prec.bit_length()):
            for i, (f, slope) in self.ends(self.solve(shifts)[0], shifts).items():
                if not turn and abs(f) > 2 * NEAR * length * abs(slope):
                    raise Answer(1, f"a zone does not end at {float(arb(beam.x[i]).mid())!r} then")
                if not abs(slope) > 0: raise Answer(3, "whether the beam leaves the ground at an end or touches it")
                shifts[i] = (shifts[i] - f / slope).mid()
            if any(abs(shift) > 4 * NEAR * length for shift in shifts.values()): raise Answer(3, "where zones end")
        if any(beam.x[i + 1] - beam.x[i] < 16 * NEAR * length for p in self.free for i in (p - 1, p)): raise Answer(2, "ends meet")
        centre = self.ends(self.solve(shifts)[0], shifts)
        boxes = {i: shift + arb(0, delta) for i, shift in shifts.items()}
        inside = self.ends(self.solve(boxes)[0], boxes)
        pushed = {i: self.solve(boxes, i)[0] for i in self.free}
        for i, (f, slope) in centre.items():
            off = abs(1 - (Y := 1 / slope.mid()) * inside[i][1])
            for p, n in self.free.items(): off += abs(Y * self.layers[n].k * inside[p][0] * pushed[p][i, W])
            if not abs(Y * f) + off * delta < delta: raise Answer(3, "where zones end")
        return boxes, max((float(abs(box / length).upper()) for box in boxes.values()), default=0.0)
    def signs(self, i, piece):
        """Layers act on a piece where they are pressed, and nowhere else."""
        (A, d, L, z), x = piece, self.beam.x[i]
        layers, absolute = [n for n, y in enumerate(self.layers) if y.side and i in y.pieces], [*map(abs, A.entries())]
        parts, absolute = [(ZERO, fmpq(1))] * bool(layers), arb_mat(6, 6, absolute)
        while parts:
            a, b = parts.pop()
            middle, half, split = L * (a + b) / 2, (L * (b - a) / 2).upper(), False
            now, both, t = (A * middle).exp() * z, [], arb(0, half)
            grown = (absolute * half) ** TERMS * (absolute * half).exp()
            for order in (0, 1):  # w and w' on the part, by Taylor's series; |exp(At) - TERMS of it| <= |At|^TERMS exp |At|/TERMS!
                y, value, factor = A**order * now, arb(0), arb(1)
                rest = (grown * arb_mat(6, 1, [*map(abs, y.entries())]))[0, 0] / arb(TERMS).gamma() / TERMS
                for k in range(TERMS): value, factor, y = value + y[0, 0] * factor, factor * t / (k + 1), A * y
                both.append(value * d[0] + arb(0, (rest * d[0]).upper()))
            for n in layers:
                acts, slope, layer = i in self.layers[n].acting, self.layers[n].slope(self.beam, i), self.layers[n]
                sign, left = layer.side if acts else -layer.side, layer.surface[i] + slope * self.boxes.get(i, 0)
                f, rise = sign * (both[0] - left - slope * (middle + t)), sign * (both[1] - slope)
                if f < 0: raise Answer(1, f"{layer.name} {'pulls' if acts else 'resists'} near {float((x + middle).mid())!r}")
                from_left, from_right = a == 0 and (i, n) in self.zeros, b == 1 and (i + 1, n) in self.zeros
                split |= not (f > 0 or (from_left and rise > 0) or (from_right and rise < 0))
            if split and b - a < fmpq(1, 2**24): raise Answer(3, "whether the beam touches the ground")
            if split: parts += [(a, (a + b) / 2), ((a + b) / 2, b)]
def verify(file):
    """The largest error where zones and states are right, as a share of the largest value of its kind."""
    ground = Ground(file)
    ground.boxes, error = ground.settle()
    u, pieces = ground.solve(ground.boxes)
    for i, piece in enumerate(pieces): ground.signs(i, piece)
    found = [(u[at, W], arb(force) if n is None else u[at, FORCE + n]) for at, n, force, *_ in ground.acting]
    for i, ((w, R), (*_, side, contact, margins)) in enumerate(zip(found, ground.acting, strict=True)):
        for margin in margins(side * (w - contact), side * R):
            if not margin >= 0: raise Answer(1 if margin < 0 else 3, f"support {i} is not {file['states'][i]}")
    off, everywhere = [error], [v for d, v in u.items() if d[1] == W]
    for k, (kind, beside) in enumerate((("deflection", everywhere), ("reaction", [arb(0)]))):
        scale = max(abs(float(v.mid())) for v in (*beside, *(pair[k] for pair in found))) or 1.0
        differences = [abs(pair[k] - exact(claim)) / scale for pair, claim in zip(found, file["values"][kind], strict=True)]
        if any(v.rad() > 2.0**-64 for v in differences): raise Answer(3, "the values")
        off += [float(v.upper()) for v in differences]
    if max(off) > 1e-9: raise Answer(1, f"the zones are right, but ends or values are off by {max(off):.1e} of the largest")
    return max(off)
def decide_on_ground(file, bits=64):
    """What the file proves, in words."""
    if not file["scene"].get("foundation"): return decide(file)
    if file["format"] != "gapbeam-proof 1" or file["status"] != "solved": raise Answer(2, "another format, or no state")
    while True:
        ctx.prec = bits = 2 * bits
        try: return f"{bits} bits, largest error {verify(file):.1e}"
        except Answer as answer:
            if answer.args[0] < 3 or bits >= 2**11: raise
if __name__ == "__main__": sys.exit(main(sys.argv[1], decide_on_ground))
