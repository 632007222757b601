"""Programs that solve many cases of one beam on supports that open: gapbeam's, and those that a user would write instead.

A beam of equal spans and one EI, held both ways at its ends, on springs between that only push. The others use the displacement
method (deflection and rotation of every node), switch all wrong supports of a case at once, and refine nothing.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from time import perf_counter

import numpy as np

from .active_set import NoScheme
from .batch_cases import EI, SPAN, STIFFNESS, Batch, Found, complete, links, make, matrix_of, nodal
from .batch_jax import by_jax
from .programs import has

MOST_ROUNDS, TOGETHER = 200, 20
"""Rounds before a program gives up, and those in which all wrong supports of a case are switched; later the first alone is."""
BLOCK = 2000
"""Cases that numpy has in hand at a time, so that they stay in the cache."""
MOST_SCHEMES = 4096
"""Contact states of which matrices are kept."""
LOOP_MOST = 2000
"""Most cases that the loop in scipy is given."""


def _by_gapbeam(batch: Batch) -> Callable[[], Found]:
    """Prepare the scene, and solve its cases in one call."""
    from gapbeam.results.cases.cases import prepare

    prepared = prepare(batch.scene())
    factors = batch.q if batch.factors else np.ones(batch.q.shape[1])
    varied = {} if batch.factors else {"gap": batch.gap, "settlement": batch.settlement}

    def run() -> Found:
        found = prepared.solve(factors, **varied)
        return Found(found.deflection, found.moment_left, found.reaction, found.closed == 1)

    return run


def _search(level: np.ndarray, displaced: Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]]) -> tuple:
    """Switch what is wrong in all cases at once until every case is settled.

    `displaced` gives deflections and rotations of cases whose numbers and contact states it is told, nodes by cases.
    """
    closed = np.ones(level.shape, dtype=bool)
    w, turn = np.empty_like(level), np.empty_like(level)
    left = np.arange(level.shape[1])
    for turns in range(MOST_ROUNDS):
        here = closed[:, left]
        w_here, turn_here = displaced(left, here)
        wrong = (w_here[1:-1] > level[1:-1, left]) != here[1:-1]
        unsettled = wrong.any(axis=0)
        done = left[~unsettled]
        w[:, done], turn[:, done] = w_here[:, ~unsettled], turn_here[:, ~unsettled]
        left, wrong = left[unsettled], wrong[:, unsettled]
        if not left.size:
            return w, turn, closed
        if turns >= TOGETHER:
            wrong &= np.cumsum(wrong, axis=0) == 1
        closed[1:-1, left] ^= wrong
    raise NoScheme(f"{len(left)} cases are not settled in {MOST_ROUNDS} rounds")


def _by_numpy(batch: Batch) -> Callable[[], Found]:
    """Eliminate node by node, many cases at once; those that are not settled again, with others."""

    def run() -> Found:
        force, couple, level = nodal(batch)

        def displaced(cases: np.ndarray, closed: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            w, turn = np.empty((2, *closed.shape))
            for begin in range(0, len(cases), BLOCK):
                part = slice(begin, begin + BLOCK)
                here = cases[part]
                _eliminate(force[:, here], couple[:, here], level[:, here], closed[:, part], w[:, part], turn[:, part])
            return w, turn

        return complete(batch, force, level, *_search(level, displaced))

    return run


def _eliminate(
    force: np.ndarray, couple: np.ndarray, level: np.ndarray, closed: np.ndarray, w: np.ndarray, turn: np.ndarray
) -> None:
    """Find deflections and rotations of cases, each in its scheme; all nodes by cases."""
    k12, k6, k4, k2 = links()
    n = len(level) - 1
    w[0], w[n] = level[0], level[n]
    # What the spans on the left pass on to the node: stiffnesses a, b, c of (w, rotation), loads f, g
    a, b, c = k12 - k6 * k6 / k4, -k6 + k6 * k2 / k4, k4 - k2 * k2 / k4
    first = (couple[0] - k6 * w[0]) / k4
    f, g = k12 * w[0] + k6 * first, -k6 * w[0] - k2 * first
    kept = []
    for i in range(1, n):
        spring = STIFFNESS * closed[i]
        a, b, c = a + (k12 + spring), b + k6, c + k4
        f, g = f + force[i] + spring * level[i], g + couple[i]
        over = 1.0 / (a * c - b * b)
        p, s, t = c * over, -b * over, a * over
        u, v = p * f + s * g, s * f + t * g
        pw, pr, qw, qr = -p * k12 - s * k6, -s * k12 - t * k6, p * k6 + s * k2, s * k6 + t * k2
        kept.append((pw, pr, qw, qr, u, v))
        a, b, c = k12 + k12 * pw + k6 * pr, -k6 + k12 * qw + k6 * qr, k4 - k6 * qw - k2 * qr
        f, g = k12 * u + k6 * v, -k6 * u - k2 * v
    turn[n] = (g + couple[n] - b * w[n]) / c
    for i in range(n - 1, 0, -1):
        pw, pr, qw, qr, u, v = kept[i - 1]
        w[i] = u - pw * w[i + 1] - qw * turn[i + 1]
        turn[i] = v - pr * w[i + 1] - qr * turn[i + 1]
    turn[0] = first + (k6 * w[1] - k2 * turn[1]) / k4


def _by_matrices(batch: Batch) -> Callable[[], Found]:
    """Sort the cases by contact state; one matrix for each scheme takes loads and levels to all results.

    Refused with `NoScheme` where there are too many schemes to keep.
    """
    spans = batch.q.shape[1]
    nodes, weights, kept = spans + 1, 2 ** np.arange(spans - 1), {}
    if 2 ** (spans - 1) > MOST_SCHEMES:
        raise NoScheme("too many contact states")
    unit = np.eye(spans + nodes)
    units = Batch(unit[:, :spans], unit[:, spans:], np.zeros((spans + nodes, nodes)), False)

    def taken(code: int) -> np.ndarray:
        if code not in kept:
            force, couple, level = nodal(units)
            springs = np.zeros((nodes, 1))
            springs[1:-1, 0] = STIFFNESS * (code & weights > 0)
            matrix, right = matrix_of(nodes), np.stack([force + springs * level, couple], axis=1).reshape(2 * nodes, -1)
            matrix[::2, ::2] += np.diag(springs[:, 0])
            matrix[[0, -2]], right[[0, -2]] = np.eye(2 * nodes)[[0, -2]], level[[0, -1]]
            u = np.linalg.solve(matrix, right)
            found = complete(units, force, level, u[::2], u[1::2], np.broadcast_to(springs > 0.0, level.shape))
            kept[code] = np.hstack([found.deflection, found.moment, found.reaction])
        return kept[code]

    def run() -> Found:
        levels = batch.gap + batch.settlement
        given = np.hstack([batch.q, levels])
        codes, found = np.full(len(given), weights.sum()), np.empty((len(given), 3 * nodes))
        left = np.arange(len(given))
        for turns in range(MOST_ROUNDS):
            left = left[np.argsort(codes[left], kind="stable")]
            for same in np.split(left, np.flatnonzero(np.diff(codes[left])) + 1):
                found[same] = given[same] @ taken(int(codes[same[0]]))
            wrong = (found[left, 1:spans] > levels[left, 1:-1]) != (codes[left, None] & weights > 0)
            unsettled = wrong.any(axis=1)
            left, wrong = left[unsettled], wrong[unsettled]
            if not left.size:
                closed = np.ones(levels.shape, dtype=bool)
                closed[:, 1:-1] = codes[:, None] & weights > 0
                return Found(*np.split(found, 3, axis=1), closed)
            if turns >= TOGETHER:
                wrong &= np.cumsum(wrong, axis=1) == 1
            codes[left] ^= wrong @ weights
        raise NoScheme(f"{len(left)} cases are not settled in {MOST_ROUNDS} rounds")

    return run


def _by_scipy(batch: Batch) -> Callable[[], Found]:
    """Solve one case after the other by a banded Cholesky factorisation of every contact state."""
    from scipy.linalg import solveh_banded

    def run() -> Found:
        force, couple, level = nodal(batch)
        nodes, cases = level.shape
        base = matrix_of(nodes)
        held = [0, 2 * nodes - 2]
        at_ends = base[:, held].copy()
        base[held], base[:, held] = 0.0, 0.0
        base[held, held] = 1.0
        band = np.zeros((4, 2 * nodes))
        for d in range(4):
            band[d, : 2 * nodes - d] = np.diagonal(base, -d)
        load = np.stack([force, couple], axis=1).reshape(2 * nodes, cases) - at_ends @ level[[0, -1]]
        load[held] = level[[0, -1]]
        w, turn, acts = np.empty_like(level), np.empty_like(level), np.empty(level.shape, dtype=bool)
        for case in range(cases):
            closed, x = np.ones(nodes, dtype=bool), level[:, case]
            for turns in range(MOST_ROUNDS):
                matrix, right = band.copy(), load[:, case].copy()
                matrix[0, 2:-2:2] += STIFFNESS * closed[1:-1]
                right[2:-2:2] += STIFFNESS * closed[1:-1] * x[1:-1]
                u = solveh_banded(matrix, right, overwrite_ab=True, overwrite_b=True, lower=True, check_finite=False)
                wrong = np.flatnonzero((u[2:-2:2] > x[1:-1]) != closed[1:-1])
                if not wrong.size:
                    break
                closed[1 + (wrong if turns < TOGETHER else wrong[:1])] ^= True
            else:
                raise NoScheme(f"case {case} is not settled in {MOST_ROUNDS} rounds")
            w[:, case], turn[:, case], acts[:, case] = u[::2], u[1::2], closed
        return complete(batch, force, level, w, turn, acts)

    return run


def loop(
    q: np.ndarray, levels: np.ndarray, numbers: tuple,
    w: np.ndarray, moment: np.ndarray, reaction: np.ndarray, acts: np.ndarray,
) -> int:  # fmt: skip
    """Solve one case after the other in scalars, for numba to compile; also runs as it is.

    Parameters
    ----------
    q, levels : numpy.ndarray
        Loads and levels of the supports, cases first.
    numbers : tuple of float
        Length and EI of the spans, stiffness of the supports; rounds, and those in which all wrong supports are switched.
    w, moment, reaction, acts : numpy.ndarray
        Get what is found, cases by supports.

    Returns
    -------
    int
        Cases that are not settled.
    """
    h, bending, stiffness, rounds, together = numbers
    cases, n = q.shape
    k12, k6, k4, k2 = 12.0 * bending / h**3, 6.0 * bending / h**2, 4.0 * bending / h, 2.0 * bending / h
    kept, turn, open_, lost = np.empty((n, 6)), np.empty(n + 1), np.empty(n + 1), 0
    for case in range(cases):
        open_[:] = 0.0
        settled = False
        for turns in range(rounds):
            x = levels[case, 0]
            first = (q[case, 0] * h * h / 12.0 - k6 * x) / k4
            a, b, c = k12 - k6 * k6 / k4, -k6 + k6 * k2 / k4, k4 - k2 * k2 / k4
            f, g = k12 * x + k6 * first, -k6 * x - k2 * first
            for i in range(1, n):
                spring = stiffness * (1.0 - open_[i])
                a, b, c = a + k12 + spring, b + k6, c + k4
                f += (q[case, i - 1] + q[case, i]) * h / 2.0 + spring * levels[case, i]
                g += (q[case, i] - q[case, i - 1]) * h * h / 12.0
                over = 1.0 / (a * c - b * b)
                p, s, t = c * over, -b * over, a * over
                u, v = p * f + s * g, s * f + t * g
                pw, pr, qw, qr = -p * k12 - s * k6, -s * k12 - t * k6, p * k6 + s * k2, s * k6 + t * k2
                kept[i, 0], kept[i, 1], kept[i, 2], kept[i, 3], kept[i, 4], kept[i, 5] = pw, pr, qw, qr, u, v
                a, b, c = k12 + k12 * pw + k6 * pr, -k6 + k12 * qw + k6 * qr, k4 - k6 * qw - k2 * qr
                f, g = k12 * u + k6 * v, -k6 * u - k2 * v
            w[case, 0], w[case, n] = x, levels[case, n]
            turn[n] = (g - q[case, n - 1] * h * h / 12.0 - b * w[case, n]) / c
            settled = True
            for i in range(n - 1, 0, -1):
                w[case, i] = kept[i, 4] - kept[i, 0] * w[case, i + 1] - kept[i, 2] * turn[i + 1]
                turn[i] = kept[i, 5] - kept[i, 1] * w[case, i + 1] - kept[i, 3] * turn[i + 1]
                right = 0.0 if w[case, i] > levels[case, i] else 1.0
                if right != open_[i] and (settled or turns < together):
                    open_[i] = right
                    settled = False
            turn[0] = first + (k6 * w[case, 1] - k2 * turn[1]) / k4
            if settled:
                break
        lost += not settled
        for i in range(n):
            chord = (w[case, i + 1] - w[case, i]) / h
            near, far = turn[i] - chord, turn[i + 1] - chord
            moment[case, i] = k2 * (2.0 * near + far) - q[case, i] * h * h / 12.0
            shear = 3.0 * k2 * (near + far) / h
            reaction[case, i] = stiffness * (1.0 - open_[i]) * (w[case, i] - levels[case, i])
            if i == 0:
                reaction[case, 0] = q[case, 0] * h / 2.0 - shear
            acts[case, i] = open_[i] == 0.0
        reaction[case, n] = q[case, n - 1] * h / 2.0 + shear
        moment[case, 0], moment[case, n], acts[case, n] = 0.0, 0.0, True
    return lost


def _by_numba(batch: Batch) -> Callable[[], Found]:
    """Let numba compile `loop`; the first run compiles."""
    compiled = _compiled()

    def run() -> Found:
        shape = batch.gap.shape
        found = Found(np.empty(shape), np.empty(shape), np.empty(shape), np.empty(shape, dtype=bool))
        numbers = SPAN, EI, STIFFNESS, MOST_ROUNDS, TOGETHER
        lost = compiled(batch.q, batch.gap + batch.settlement, numbers, *vars(found).values())
        if lost:
            raise NoScheme(f"{lost} cases are not settled in {MOST_ROUNDS} rounds")
        return found

    return run


def _by_jax(batch: Batch) -> Callable[[], Found]:
    """Let JAX compile the loop of one case, mapped over all cases."""
    return by_jax(batch, MOST_ROUNDS, TOGETHER)


@cache
def _compiled() -> Callable:
    from numba import njit

    return njit(loop, error_model="numpy")


OWN = "gapbeam"
"""The program that is measured."""
PROGRAMS = {
    OWN: _by_gapbeam,
    "numpy, all cases": _by_numpy,
    "numpy, matrices": _by_matrices,
    "scipy, loop": _by_scipy,
    "numba, loop": _by_numba,
    "jax, all cases": _by_jax,
}
"""What makes each ready to run."""


def installed(name: str) -> bool:
    """Whether a program can be had.

    Parameters
    ----------
    name : str
        From `PROGRAMS`.
    """
    return has(name.partition(",")[0])


def given(cases: Batch, name: str) -> Batch:
    """Take the cases that a program is given: fewer for a loop.

    Parameters
    ----------
    cases : Batch
        All.
    name : str
        The program.
    """
    return cases.first(LOOP_MOST) if name.startswith("scipy") else cases


def first_call(problem: str, name: str, largest: int) -> float:
    """Time the first call of a program in this process, with all that it imports, prepares and compiles.

    Parameters
    ----------
    problem, name : str
        The problem and the program.
    largest : int
        Most cases.

    Returns
    -------
    float
        Seconds.
    """
    cases = given(make(problem, largest), name)
    begin = perf_counter()
    PROGRAMS[name](cases)()
    return perf_counter() - begin
