"""Many cases of one beam in JAX: the loop of one case in `jax.numpy`, mapped over all cases and compiled.

The same elimination as in `batch_programs`, unrefined; a case that is settled waits for those that are not.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import cache

import numpy as np

from .active_set import NoScheme
from .batch_cases import SPAN, STIFFNESS, Batch, Found, links


def by_jax(batch: Batch, rounds: int, together: int) -> Callable[[], Found]:
    """Make ready; the first run compiles.

    Parameters
    ----------
    batch : Batch
        The cases.
    rounds, together : int
        Rounds before it is given up, and those in which all wrong supports of a case are switched.

    Returns
    -------
    callable
        Solves them.
    """
    solve = _compiled(rounds, together)
    import jax

    def run() -> Found:
        with jax.enable_x64(True):
            *found, settled = map(np.asarray, solve(batch.q, batch.gap + batch.settlement))
        if not settled.all():
            raise NoScheme(f"{np.count_nonzero(~settled)} cases are not settled in {rounds} rounds")
        return Found(*found)

    return run


@cache
def _compiled(rounds: int, together: int) -> Callable:
    # On one core, as all others; heeded where nothing has been computed with JAX before
    os.environ["XLA_FLAGS"] = f"{os.environ.get('XLA_FLAGS', '')} --xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"
    import jax
    import jax.numpy as jnp
    from jax import lax

    k12, k6, k4, k2 = links()

    def displaced(q: jax.Array, level: jax.Array, closed: jax.Array) -> tuple[jax.Array, jax.Array]:
        force, couple = (q[1:] + q[:-1]) * SPAN / 2.0, (q[1:] - q[:-1]) * SPAN * SPAN / 12.0
        spring = STIFFNESS * closed
        first = (q[0] * SPAN * SPAN / 12.0 - k6 * level[0]) / k4
        here = jnp.full((), 1.0) * level[0]

        def forward(passed: tuple, node: tuple) -> tuple[tuple, tuple]:
            (a, b, c, f, g), (force, couple, spring, level) = passed, node
            a, b, c = a + k12 + spring, b + k6, c + k4
            f, g = f + force + spring * level, g + couple
            over = 1.0 / (a * c - b * b)
            p, s, t = c * over, -b * over, a * over
            u, v = p * f + s * g, s * f + t * g
            pw, pr, qw, qr = -p * k12 - s * k6, -s * k12 - t * k6, p * k6 + s * k2, s * k6 + t * k2
            a, b, c = k12 + k12 * pw + k6 * pr, -k6 + k12 * qw + k6 * qr, k4 - k6 * qw - k2 * qr
            return (a, b, c, k12 * u + k6 * v, -k6 * u - k2 * v), (pw, pr, qw, qr, u, v)

        def back(after: tuple, kept: tuple) -> tuple[tuple, tuple]:
            (w, turn), (pw, pr, qw, qr, u, v) = after, kept
            at = u - pw * w - qw * turn, v - pr * w - qr * turn
            return at, at

        begin = [one + 0.0 * here for one in (k12 - k6 * k6 / k4, -k6 + k6 * k2 / k4, k4 - k2 * k2 / k4)]
        begin += [k12 * here + k6 * first, -k6 * here - k2 * first]
        (_, b, c, _, g), kept = lax.scan(forward, tuple(begin), (force, couple, spring, level[1:-1]))
        last = level[-1], (g - q[-1] * SPAN * SPAN / 12.0 - b * level[-1]) / c
        _, (w, turn) = lax.scan(back, last, kept, reverse=True)
        w = jnp.concatenate([level[:1], w, level[-1:]])
        return w, jnp.concatenate([first[None] + ((k6 * w[1] - k2 * turn[0]) / k4)[None], turn, last[1][None]])

    def one_case(q: jax.Array, level: jax.Array) -> tuple[jax.Array, ...]:
        def unsettled(state: tuple) -> jax.Array:
            return ~state[1] & (state[2] < rounds)

        def switch(state: tuple) -> tuple:
            closed, _, turns, *_ = state
            w, turn = displaced(q, level, closed)
            wrong = (w[1:-1] > level[1:-1]) != closed
            settled = ~wrong.any()
            wrong &= (turns < together) | (jnp.cumsum(wrong) == 1)
            return closed ^ wrong, settled, turns + 1, w, turn

        closed = jnp.ones(len(q) - 1, dtype=bool)
        closed, settled, _, w, turn = lax.while_loop(unsettled, switch, (closed, False, 0, level, level))
        chord = jnp.diff(w) / SPAN
        near, far = turn[:-1] - chord, turn[1:] - chord
        inner = (k2 * (2.0 * near + far) - q * SPAN * SPAN / 12.0)[1:]
        shear = 3.0 * k2 * (near + far) / SPAN
        ends = (q[:1] * SPAN / 2.0 - shear[:1], q[-1:] * SPAN / 2.0 + shear[-1:])
        reaction = jnp.concatenate([ends[0], STIFFNESS * closed * (w - level)[1:-1], ends[1]])
        held = jnp.ones(1, dtype=bool)
        return w, jnp.pad(inner, 1), reaction, jnp.concatenate([held, closed, held]), settled

    return jax.jit(jax.vmap(one_case))
