"""Decides in ball arithmetic whether the state of a beam on supports that act one way is right; it shares nothing with gapbeam.

python proof_checker.py FILE (from `gapbeam prove`) ends with a line and exit status 0 proved, 1 refuted, 2 not decided.
Numbers of the scene are exactly the doubles that they are read as. What resists is a spring: deformation = rest + compliance*force,
its deformation a sum of displacements; a piece of beam is two: ends turn apart (L/EI), both turn from the chord (L/12EI + 1/GAL).
Rigid is compliance 0. Supports act as their states say. If no pivot is 0 these displacements are the only ones; if nothing open is
then penetrated, all that is closed pushes, and laws are on the pieces stated, it is an equilibrium, and where no law falls there is
no other. Signs: deflections, settlements, loads downward; reactions upward; rotations and couples clockwise."""
import json
import sys
from bisect import bisect_right
from collections import defaultdict
from itertools import accumulate

from flint import arb, ctx, fmpq  # pip install python-flint

W, LEFT, RIGHT, FORCE = range(4)  # unknowns (place, W): deflection; LEFT, RIGHT: rotation, a hinge has two; FORCE + n: of spring n
INF, ZERO, ONE = float("inf"), fmpq(0), fmpq(1)
KNOWN = {*"title units beam sections supports loads analysis spans EI GA EA hinges from to node x name side stiffness gap".split(),
         *"settlement rotation law unloading type case F M q kappa".split()}  # fmt: skip
class Answer(Exception): """1: refuted, 2: not decided, 3: more bits may decide; and words."""
def exact(value):  # the rational number that a double is; text is hexadecimal
    return fmpq(*(float.fromhex(value) if isinstance(value, str) else float(value)).as_integer_ratio())
def inverse(stiffness): return ZERO if stiffness in (INF, "fixed") else 1 / exact(stiffness)
class Beam:  # springs (place, form, rest, compliance) and loads; a form has the factors of displacements in a deformation
    def __init__(self, scene):
        beam, sections, loads, self.supports, joints = (scene.get(key, []) for key in "beam sections loads supports hinges".split())
        tables = [{"elastic hinges": joints}, *sections, *loads, *self.supports, *({"x": x} for x in beam.get("hinges", []))]
        unknown = {k for t in (scene, beam, *tables) for k in t if t[k] not in (None, [], "normal")} - KNOWN
        if unknown: raise Answer(2, f"this checker does not know {', '.join(sorted(unknown))}")
        self.ends = list(accumulate(map(exact, beam["spans"]), initial=ZERO))
        self.rounded = [int(x.p) / int(x.q) for x in self.ends]
        self.x = sorted({*self.ends, *(self.where(t[k]) for t in tables for k in ("x", "from", "to") if t.get(k) is not None)})
        self.number, span = {x: i for i, x in enumerate(self.x)}, [bisect_right(self.ends, x) - 1 for x in self.x[:-1]]
        self.hinges, self.springs, self.load = {self.place({"x": x}) for x in beam.get("hinges", [])}, [], defaultdict(fmpq)
        self.stiff = stiff = {key: [v[k] if isinstance(v := beam.get(key, INF), list) else v for k in span] for key in ("EI", "GA")}
        for section, key in ((s, key) for s in sections for key in stiff if s.get(key) is not None):
            for i in self.stretch(section): stiff[key][i] = section[key]
        self.spread = spread = {key: [[ZERO, ZERO] for _ in span] for key in ("q", "kappa")}
        for load in loads:
            if load["type"] == "force": self.load[self.place(load), W] += exact(load["F"])
            elif load["type"] == "moment": self.load[self.place(load), LEFT] += exact(load["M"])
            else:
                key, pieces = "kappa" if load["type"] == "curvature" else "q", self.stretch(load)
                first, last = map(exact, load[key] if isinstance(load[key], list) else [load[key]] * 2)
                begin, rise = self.x[pieces.start], (last - first) / (self.x[pieces.stop] - self.x[pieces.start])
                for i in pieces: spread[key][i] = [spread[key][i][k] + first + rise * (self.x[i + k] - begin) for k in (0, 1)]
        for i, (EI, GA, q, k) in enumerate(zip(*(map(inverse, v) for v in stiff.values()), *spread.values(), strict=True)):
            L, (qa, qb), (ka, kb), t, s = self.x[i + 1] - self.x[i], q, k, (i, RIGHT if i in self.hinges else LEFT), (i + 1, LEFT)
            chord = {s: ONE / 2, t: ONE / 2, (i, W): 1 / L, (i + 1, W): -1 / L}
            self.springs.append((i, {s: ONE, t: -ONE}, (ka + kb) / 2 * L - (qa + qb) * L**3 / 24 * EI, L * EI))
            self.springs.append((i, chord, (kb - ka) / 12 * L + (qa - qb) * L**3 / 720 * EI, L / 12 * EI + GA / L))
            self.load[i, W] += (2 * qa + qb) * L / 6
            self.load[i + 1, W] += (qa + 2 * qb) * L / 6
    def where(self, x):  # an x counts from the span end left of it, as a double
        return self.ends[k := bisect_right(self.rounded, x) - 1] + exact(x) - exact(self.rounded[k])
    def place(self, item): return self.number[self.ends[item["node"]] if item.get("x") is None else self.where(item["x"])]
    def stretch(self, t): return range(*(self.number[self.where(x)] for x in (t.get("from") or 0, t.get("to") or self.rounded[-1])))
    def act(self, support, state, claimed):
        """Give place, number of the spring or else force, side, beginning of contact, and margins of how far it is pressed (d) and
        the force then (r), 0 or more where the state is right."""
        both, law, turning = support.get("side", "both") == "both", support.get("law"), support.get("rotation", "free")
        stiffness, at, gap = support.get("stiffness", INF), self.place(support), exact(support.get("gap", 0.0))
        if isinstance(law, dict) or support.get("unloading", "elastic") != "elastic": raise Answer(2, "laws that curve or remember")
        points = [[ZERO, ZERO], *([*map(exact, p)] for p in law or [(0, 1) if stiffness == INF else (1, stiffness)])]
        words = [f"branch {k}" for k in range(1, len(points))] if law else ["bilateral" if both else "closed"]
        if state not in ["open"] * (not both or gap > 0) + words: raise Answer(1, f"{state} is no state of {support}")
        if turning not in ("free", 0): self.springs.append((at, {(at, LEFT): ONE}, ZERO, inverse(turning)))
        k, level, n = ["open", *words].index(state), exact(support.get("settlement", 0.0)), len(self.springs)
        side = {"below": 1, "above": -1, "both": 1 if exact(claimed) >= level else -1}[support.get("side", "both")]
        contact = level + side * gap
        if not k: return at, None, 0, side, contact, lambda d, r: [-d, d + 2 * gap][: (stiffness != 0) + both]
        (d0, r0), (d1, r1) = points[k - 1 : k + 1]
        dd, dr, mirrored = d1 - d0, r1 - r0, both and k == 1 and not gap
        lower, count = (-d1, -r1) if mirrored else (d0, r0), 2 if k < len(points) - 1 else 1 - mirrored
        if dr: self.springs.append((at, {(at, W): ONE}, contact + side * (d0 - r0 * dd / dr), dd / dr))
        else: self.load[at, W] -= side * r0
        return at, n if dr else None, side * r0, side, contact, lambda d, r: [
            (d - lower[0]) * dd + (r - lower[1]) * dr, (d1 - d) * dd + (r1 - r) * dr][:count]  # fmt: skip
def eliminate(equations, number, guess=None):
    """Solve equations (form, right side) in balls or rationals; what they leave open is taken from the guess."""
    begin, found, steps = defaultdict(list), {}, []
    for form, right in equations: begin[min(form)].append(({d: number(c) for d, c in form.items()}, number(right)))
    for d in sorted({d for form, _ in equations for d in form}):
        row, right = max(rows := begin.pop(d, []), key=lambda r: r[0][d].abs_lower() if number is arb else 1, default=({}, 0))
        if number is arb and not (row and abs(row[d]) > 0): raise Answer(3, "whether it stands")
        if not row and guess is None: raise Answer(2, "the beam moves freely then, or rigid supports share reactions")
        steps.append((d, row, right))
        for other, value in (r for r in rows if r[0] is not row):
            c = other[d] / row[d]
            rest = other | {e: other.get(e, 0) - c * v for e, v in row.items()}
            rest, value = {e: v for e, v in rest.items() if e != d and not v == 0}, value - c * right
            if rest: begin[min(rest)].append((rest, value))
            elif value != 0: raise Answer(1, "nothing holds the beam then, or rigid supports exclude each other")
    for d, row, right in reversed(steps):
        found[d] = (right - sum(v * found[e] for e, v in row.items() if e != d)) / row[d] if row else guess[d]
    return found
def verify(file, number):
    """Largest errors of deflections and reactions, as shares of the largest of them, where the states are right."""
    beam, equations, balance, off = Beam(file["scene"]), [], defaultdict(dict), []
    acting = [beam.act(*one) for one in zip(beam.supports, file["states"], file["values"]["deflection"], strict=True)]
    for n, (at, form, rest, compliance) in enumerate(beam.springs):
        equations.append(({**form, (at, FORCE + n): -compliance}, rest))
        for d, c in form.items(): balance[d][at, FORCE + n] = c
    u = eliminate(equations + [(forces, beam.load[d]) for d, forces in balance.items()], number)
    found = [(u[at, W], force if n is None else u[at, FORCE + n]) for at, n, force, *_ in acting]
    for i, ((w, R), (*_, side, contact, margins)) in enumerate(zip(found, acting, strict=True)):
        for margin in margins(side * (w - contact), side * R):
            if not margin >= 0: raise Answer(1 if margin < 0 else 3, f"support {i} is not {file['states'][i]}")
    for kind, values in zip(("deflection", "reaction"), zip(*found, strict=True), strict=True):
        beside = (v for d, v in u.items() if d[1] == W and kind == "deflection")  # of all places
        scale = max(abs(float(arb(v).mid())) for v in (*values, *beside)) or 1.0
        differences = [abs(arb(v) - exact(claim)) / scale for v, claim in zip(values, file["values"][kind], strict=True)]
        if any(v.rad() > 2.0**-64 for v in differences): raise Answer(3, "the values")
        off.append(max(float(v.upper()) for v in differences))
    if max(off) > 1e-9: raise Answer(1, f"the states are right, but values are off by {max(off):.1e} of the largest")
    return off
def move(file):
    """Prove by a motion, rigid between hinges, that nothing holds the beam: supports do not hinder it, and the loads do work."""
    beam, guess, given = Beam(file["scene"]), {(0, LEFT): ZERO}, list(map(exact, file["motion"]))
    knots = sorted({*beam.ends, *(beam.x[i] for i in beam.hinges)})
    for i, x in enumerate(beam.x):
        k = min(bisect_right(knots, x), len(knots) - 1) - 1
        slope = (given[k + 1] - given[k]) / (knots[k + 1] - knots[k])
        guess |= {(i, W): given[k] + slope * (x - knots[k]), (i, RIGHT): slope, (i + 1, LEFT): slope}
    ways = [(beam.place(s), {"below": 1, "above": -1}.get(s.get("side"), 0)) for s in beam.supports if s.get("stiffness") != 0]
    held = [{(beam.place(s), LEFT): ONE} for s in beam.supports if s.get("rotation", "free") not in ("free", 0)]
    held += [{(at, W): ONE} for at, _ in ways if abs(guess[at, W]) <= max(map(abs, given)) / 10**9]  # what hardly moves rests
    u = eliminate([(form, ZERO) for form in (*held, *(spring[1] for spring in beam.springs))], fmpq, guess)
    if any((side * u[at, W] if side else abs(u[at, W])) > 0 for at, side in ways): raise Answer(1, "supports hinder the motion")
    if sum(F * u[d] for d, F in beam.load.items()) <= 0: raise Answer(1, "the loads do no work along the motion")
def decide(file, bits=64, number=arb):
    """What the file proves, in words."""
    if file["format"] != "gapbeam-proof 1": raise Answer(2, "another format")
    if file["status"] == "no-equilibrium": return move(file) or f"{bits} bits and rationals, largest error 0; nothing holds it"
    while True:
        ctx.prec = bits = 2 * bits
        try: off = verify(file, number)
        except Answer as answer:
            if answer.args[0] < 3 or bits > 2**16: raise
            number = fmpq if bits >= 1024 and len(file["states"]) <= 300 else arb  # a tie, perhaps
        else: return f"{bits} bits{' and rationals' * (number is fmpq)}, largest error {max(off):.1e}"
def main(name, decide=decide):
    try:
        with open(name, encoding="utf-8") as stream: status, words = 0, decide(json.load(stream))
    except Answer as answer: status, words = min(answer.args[0], 2), answer.args[1]
    except (OSError, LookupError, ArithmeticError, ValueError, TypeError, AttributeError) as error: status, words = 2, repr(error)
    print(f"{('proved with', 'refuted:', 'not decided:')[status]} {words}")
    return status
if __name__ == "__main__": sys.exit(main(sys.argv[1]))
