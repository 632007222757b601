"""The system of equations of a result: what it consisted of."""

from __future__ import annotations

import warnings
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ...engine.beam import METHODS
from ...engine.layout import RELATIVE, ROTATIONAL

if TYPE_CHECKING:
    from ..paths.compression import Compression
    from ..result import Result


@dataclass(frozen=True)
class System:
    """What the system of equations consisted of.

    Attributes
    ----------
    nodes : int
        Nodes: beam ends, supports, hinges; with foundations also the ends of the zones of contact in the last step.
    unknowns : int
        Unknowns of the bending system of the last step.
    half_bandwidth : int
        Its half bandwidth.
    method : str
        How it was solved in the last step.
    axial_unknowns : int
        Unknowns of the separate axial system.
    left_out : tuple of str
        What the scene did not need; and ``second order``, the effect of axial forces on bending, where something is compressed.
    compression : Compression or None
        How large that is: the largest compression beside the Euler load.
    """

    nodes: int
    unknowns: int
    half_bandwidth: int
    method: str
    axial_unknowns: int
    left_out: tuple[str, ...]
    compression: Compression | None = None

    def asdict(self) -> dict[str, Any]:
        """Give the same as `to_dict`, by the name that it had."""
        warnings.warn("asdict is called to_dict", DeprecationWarning, stacklevel=2)
        return self.to_dict()

    def to_dict(self) -> dict[str, Any]:
        """As plain data.

        Returns
        -------
        dict
            By the names of the attributes.
        """
        found = {} if self.compression is None else {"compression": self.compression.to_dict()}
        data = asdict(self) | {"left_out": list(self.left_out)}
        del data["compression"]
        return data | found


def system_of(result: Result) -> System:
    """Tell what the system of equations of a result consisted of.

    Parameters
    ----------
    result : Result
        Of one load.
    """
    beam, steps = result._beam, result.steps
    method = steps[-1].solution.method if steps else 0
    ground = steps[-1].solution.ground if steps else None
    nodes = 1 + (beam.links if ground is None else ground.stretches)
    three_moment = METHODS[method] == "three-moment"
    directions = beam.columns.support_codes[1, :-1]
    needed = {
        "axial": beam.bars >= 0,
        "shear": beam.has_shear,
        "foundation": beam.ground_layers > 0,
        "hinges": beam.has_hinges or (directions == RELATIVE).any(),
        "rotational restraints": beam.has_restraints or np.isin(directions, ROTATIONAL).any(),
        "iteration": beam.is_one_sided or beam.has_one_sided_ground,
        "deflections": not three_moment,
        "second order": result.compression is None,
    }
    return System(
        nodes=nodes,
        unknowns=nodes if three_moment else 2 * nodes,
        half_bandwidth=1 if three_moment else 3,
        method=METHODS[method],
        axial_unknowns=2 * beam.bars + 1 if beam.bars >= 0 else 0,
        left_out=tuple(name for name, used in needed.items() if not used),
        compression=result.compression,
    )
