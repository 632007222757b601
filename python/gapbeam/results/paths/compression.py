"""Axial compression beside the Euler load: bending is solved without the effect of axial forces, and that has to be small."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...base.errors import SceneError

WARNED, REFUSED = 0.1, 1.0
"""Shares of the Euler load from which the effect of axial forces is warned of, and from which a scene is refused."""
KEY = "analysis.first_order"


@dataclass(frozen=True, slots=True)
class Compression:
    """The largest compression beside the Euler load.

    Attributes
    ----------
    ratio : float
        P L^2/(pi^2 EI), on ground P/(2 sqrt(k EI)).
    force : float
        The largest compression P of the stretch.
    from_, to : float
        The stretch, between supports that act, ends of the beam, hinges, and ends of zones of contact.
    length : float or None
        L: that of the stretch, or twice that; None where it is the ground that keeps the beam from buckling.
    """

    ratio: float
    force: float
    from_: float
    to: float
    length: float | None

    def to_dict(self) -> dict[str, float | None]:
        """As plain data."""
        ratio = self.ratio if np.isfinite(self.ratio) else None  # JSON has no infinity
        return {"ratio": ratio, "force": self.force, "from": self.from_, "to": self.to, "length": self.length}

    @property
    def is_warned(self) -> bool:
        """Whether its effect on bending is no longer small."""
        return self.ratio >= WARNED

    @property
    def is_refused(self) -> bool:
        """Whether the beam would buckle."""
        return self.ratio >= REFUSED

    def in_words(self) -> str:
        """Say how large it is."""
        what = "P/(2 sqrt(k EI))" if self.length is None else "P L²/(π² EI)"
        length = "" if self.length is None else f", L = {self.length:.6g}"
        return f"{what} = {self.ratio:.4g} from x = {self.from_:.6g} to {self.to:.6g} (P = {self.force:.6g}{length})"

    def remark(self) -> str:
        """Warn of it."""
        return (
            f"the effect of axial forces on bending is left out, and compression comes near the Euler load: {self.in_words()}; "
            f"moments and deflections may be larger by about {self.ratio / (1.0 - self.ratio):.0%}"
        )

    def refusal(self, where: str = "") -> SceneError:
        """Make the error that refuses a scene with it.

        Parameters
        ----------
        where : str
            Said before it: at which load factor, or with which train.
        """
        return SceneError(
            KEY,
            f"{where}the beam would buckle, and the effect of axial forces on bending is left out: {self.in_words()}; take less "
            f"compression, a stiffer beam or more supports, or give {KEY} = true if axial forces are meant to have no effect",
        )


def larger(a: Compression | None, b: Compression | None) -> Compression | None:
    """Choose the larger of two, either of which may be missing."""
    return b if a is None or (b is not None and b.ratio > a.ratio) else a
