"""Residuals of many solved cases, and bounds of their errors."""

from __future__ import annotations

import numpy as np

from ..base.errors import check_ended
from . import calls as _engine
from . import quantities
from .beam import RULES, Beam
from .combinations import Varied

BOUNDED = (*quantities.BOUNDED, "reaction")
"""What has error bounds."""
RESIDUALS = ("compatibility", "equilibrium", "complementarity")
"""Relative residuals."""
NUMBERS = (*RESIDUALS, "nodes", "reaction", *BOUNDED[:-1])
"""What a certificate has, in the order of GBCCRT: relative residuals, then bounds."""


def case_certificates(
    beam: Beam, rule: str, factors: np.ndarray, closed: np.ndarray, status: np.ndarray, varied: Varied,
    solutions: tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray] | None,
) -> dict[str, np.ndarray]:  # fmt: skip
    """Certify cases.

    Parameters
    ----------
    beam, rule, factors, closed, status, varied
        As for `case_extremes`, moduli as well.
    solutions : tuple of numpy.ndarray or None
        Deflection, moments left and right of the nodes, reactions, as `solve_cases` gives them; None where each case has to be
        solved once more.

    Returns
    -------
    dict of numpy.ndarray
        `NUMBERS` with an entry for every case, bounds in the scene's units; not-a-number where a case is not solved, and bounds of
        deflections and rotations where the beam is free to move.

    Raises
    ------
    MemoryError
        The system gives no more memory.
    """
    cases = len(factors)
    numbers = np.full((cases, len(NUMBERS)), np.nan)
    known, state = np.zeros(cases, np.int32), status.astype(np.int32)
    shares = np.column_stack((factors, np.zeros(cases)))
    schemes = np.column_stack((closed, np.zeros(cases))).astype(np.int32)
    given = int(solutions is not None)
    w, left, right, reaction = solutions or (np.zeros((cases, 1)),) * 3 + (np.zeros((cases, beam.supports)),)
    nodes = [np.ascontiguousarray(one) for one in (w, left, right)]
    forces = np.column_stack((reaction, np.zeros(cases)))
    for part in _engine.short_parts(cases, beam.links + 1):
        _engine.gbccrt(
            beam.handle, shares[part].T, *varied.part(part), RULES[rule], given, schemes[part].T, *(one[part].T for one in nodes),
            forces[part].T, numbers[part].T, known[part], state[part],
        )  # fmt: skip
    check_ended(state)
    found = dict(zip(NUMBERS, numbers.T, strict=True))
    for name in ("nodes", "deflection", "rotation"):
        found[name][known == 0] = np.nan
    return found


def relative_certificate(found: dict[str, np.ndarray], largest: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Relate bounds to the largest values of their kinds.

    Parameters
    ----------
    found : dict of numpy.ndarray
        By `case_certificates`.
    largest : dict of numpy.ndarray
        The largest absolute value of each of `BOUNDED`, an entry for every case.

    Returns
    -------
    dict of numpy.ndarray
        As `Step.certificate` of each case; not-a-number for what there is not.
    """
    relative = {}
    for kind in BOUNDED:
        bound = np.where(np.isfinite(found[kind]), found[kind], np.nan)
        with np.errstate(over="ignore"):
            share = np.divide(bound, largest[kind], out=0.0 * bound, where=largest[kind] > 0.0)
        relative[kind] = np.where(np.isfinite(share), share, np.nan)
    return {
        **{name: found[name] + 0.0 for name in ("equilibrium", "compatibility", "complementarity")},
        "error_bound": np.max(list(relative.values()), axis=0),
        **{f"error_bound_{kind}": bound for kind, bound in relative.items()},
    }
