"""Utilisations: the largest values beside the limits of the scene."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from ..scene.rotations import which_turn
from .views.extreme import KINDS

if TYPE_CHECKING:
    from .envelopes.envelope import Envelope
    from .result import Result
    from .trains.envelope import TrainEnvelope


class Utilisation(NamedTuple):
    """How far a limit is used, at most.

    Attributes
    ----------
    quantity : str
        Of the limit.
    value : float
        The value whose absolute value is largest; a pressure per area.
    limit : float
        What is allowed.
    x : float
        Where it is.
    support : int or None
        Number of the support it belongs to.
    source : dict
        Combination, train and position, load factor it comes from, those there are.
    """

    quantity: str
    value: float
    limit: float
    x: float
    support: int | None
    source: dict[str, Any]

    @property
    def ratio(self) -> float:
        """The value in parts of the limit."""
        return abs(self.value) / self.limit

    def to_dict(self) -> dict[str, Any]:
        """As plain data."""
        support = {} if self.support is None else {"support": self.support}
        return {"value": self.value, "limit": self.limit, "ratio": self.ratio, "x": self.x, **support, **self.source}


def find_utilisations(result: Result, envelope: Envelope | TrainEnvelope) -> dict[str, Utilisation]:
    """Set the largest values beside the limits of the scene.

    Parameters
    ----------
    result : Result
        Of one load or of combinations.
    envelope : Envelope or TrainEnvelope
        Its `Result.envelope`.

    Returns
    -------
    dict of Utilisation
        By quantity; empty where the scene has no limits.
    """
    scene = result.scene
    if scene.limits is None:
        return {}
    x, found = scene.positions(scene.supports), {}
    for name, limit in scene.limits.given().items():
        if name in ("reaction", "opening"):
            turning = which_turn(scene.supports)  # couples and angles
            ones = [row[name][kind] for k, row in enumerate(envelope.supports) if not turning[k] for kind in KINDS]
        else:
            ones = list(envelope.extremes.get(name, {}).values())
        ones = [one for one in ones if one is not None]
        if not ones:
            continue
        most = max(ones, key=lambda one: abs(one.value))
        value = most.value / scene.beam.width if name == "pressure" else most.value
        source = most.source._replace(side=None).to_dict()
        place = most.x if most.support is None else float(x[most.support])
        found[name] = Utilisation(name, value, limit, place, most.support, source)
    return found
