"""Scenes: what a user writes, from TOML, from JSON or in Python.

Units: any consistent set, for example kN and m throughout. The labels in `Units` go into the report and
change no number.

Signs: x runs to the right. Deflections, settlements, forces and distributed loads are positive downward,
reactions positive upward; bending moments are positive sagging; rotations and couples (moment loads) are
positive clockwise; axial forces on the beam and axial displacements are positive to the right.

Positions: an `x` is measured from the left end of the beam. Node 0 is the left end, node i the right end of
the i-th span. Positions that differ by rounding only (`POSITION_TOLERANCE`) count as one.

The docstrings of the classes are also the descriptions in the JSON Schema (`scene_schema`).

>>> from gapbeam import UniformLoad, read_scene
>>> scene = read_scene(Scene(
...     beam=Beam([6.0, 6.0], EI=1e4),
...     supports=[Support(node=0), Support(x=6.0, side="below", gap=0.01), Support(node=2)],
...     loads=[UniformLoad(q=5.0)],
... ))
>>> scene.span_ends()
array([ 0.,  6., 12.])
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterable
from typing import Any, Literal

import numpy as np
from msgspec import field

from ..base.files import write_files
from .analysis import Analysis
from .axial_ground import AxialGround
from .edited import to_data, to_toml
from .ground_laws import GroundLaw
from .ground_tables import Along
from .joints import Hinge, Rotation
from .laws import Law
from .limits import Limits
from .loads import AxialLoad, ForceLoad, Load, MomentLoad
from .masses import Mass
from .table import NotNegative, Point, Positive, Side, Spans, Stretch, SupportSide, Table
from .tapers import Section

inf = math.inf


class Units(Table, forbid_unknown_fields=True):
    """Labels of the units; they go into the report and change no number.

    Parameters
    ----------
    force : str
        Unit of force, for example kN.
    length : str
        Unit of length, for example m.
    """

    force: str = ""
    length: str = ""


class Beam(Table, forbid_unknown_fields=True):
    """The beam: its spans and stiffnesses.

    Parameters
    ----------
    spans : list of float
        Lengths of the spans (length) from left to right; their ends are nodes 0, 1, 2, ...
    EI : float or list of float
        Bending stiffness (force*length^2), one number or one per span; inf = rigid.
    GA : float or list of float
        Shear stiffness kappa*G*A (force), one number or one per span; default inf (Euler-Bernoulli).
    EA : float or list of float
        Axial stiffness (force), one number or one per span; default inf. Needed only with axial loads.
    N : float or list of float
        Axial force (force) that bending feels (second order), tension positive, one number or one per span; default 0.
    mass : float or list of float
        Mass per length (force*time^2/length^2), one number or one per span, for `analysis.frequencies`; default 0.
    hinges : list of float
        Places of moment hinges inside the beam (length, from the left end).
    width : float, optional
        Width on the ground (length), by which pressures are set beside `limits.pressure`; it changes no result.
    direction : {"right", "down"}
        Where x goes in pictures: right (default), or down for what stands upright, such as a pile; it changes no result.
        Downward in a lying beam is to the right then.
    alpha : float or list of float, optional
        Thermal expansion per degree (no unit), one number or one per span; needed with loads of type temperature only.
    depth : float or list of float, optional
        Depth of the beam (length), one number or one per span; needed where such a load has a gradient.
    """

    spans: Spans
    EI: Positive | list[Positive]
    GA: Positive | list[Positive] = inf
    EA: Positive | list[Positive] = inf
    N: float | list[float] = 0.0
    mass: NotNegative | list[NotNegative] = 0.0
    hinges: list[float] = []
    width: Positive | None = None
    direction: Literal["right", "down"] = "right"
    alpha: float | list[float] | None = None
    depth: Positive | list[Positive] | None = None


class Support(Point, kw_only=True, gc=False):
    """A support, at a node or anywhere along the beam.

    It acts where the deflection of the beam is settlement + gap (side below) or settlement - gap (above). For
    clearance on both sides put one below and one above at the same place.

    Parameters
    ----------
    side : {"both", "below", "above", "left", "right", "counterclockwise", "clockwise", "sagging", "hogging"}
        Both (default) holds the beam, below pushes it up only (bearing), above pushes it down only (hold-down). Of an axial
        support left pushes it to the left only, right to the right only; of a rotational one which way it turns the beam, of a
        hinge which moments it takes.
    stiffness : float
        Stiffness (force/length), default inf (rigid). A one-sided support with 0 never carries: it is open, and its
        opening negative where the beam has gone past it.
    gap : float
        Distance to be closed before it acts (length); negative = set too high; one-sided supports only.
    settlement : float
        Movement of the support itself (length), positive downward; for an axial support to the right.
    rotation : {"free", "fixed"}, float or table
        Whether the beam can rotate: free (default), fixed, or a rotational stiffness (force*length/rad). It stays active
        when the support has lifted off, as in a guide. Or a table with slack, side or law (`Rotation`).
    at_hinge : {"left", "right"}, optional
        Of a rotation that is held exactly at a hinge: of which part of the beam, that left of the hinge or that right of it. Then
        it is a support of its own in results, and so is such a hinge with a stiffness.
    direction : {"normal", "axial", "rotational", "hinge"}
        Normal (default) is across the beam; axial holds it horizontally, only with axial loads. Rotational holds its rotation, and
        hinge the parts on its two sides against each other: what rotation and hinges with a slack, a side or a law become.
        Lengths are angles (rad) then, and forces couples, counterclockwise, or sagging moments.
    friction : float
        Coefficient (no unit) of a support across the beam: it holds the beam along its axis with a force up to that times its
        reaction, then slips. Default 0.
    law : list of (float, float) or table, optional
        Instead of stiffness: points of a curve, displacement past the gap and force (length, force), from (0, 0) on, which is
        left out. Equal displacements are a vertical piece: rigid up to a force, or brittle. The last slope continues. With side
        both the curve is mirrored, and may have a gap. Or a table with a type, the name of a curve.
    unloading : {"elastic", "plastic", "broken"}
        Of a support with a curve: elastic (default) goes back along it. Plastic goes back parallel to its first segment and
        leaves a displacement; with side both it yields either way, by springs with sliders side by side. Broken stays
        down once its force has dropped, down a vertical piece; until then it goes back along its curve.
    """

    side: SupportSide = "both"
    stiffness: NotNegative = inf
    gap: float = 0.0
    settlement: float = 0.0
    rotation: Literal["free", "fixed"] | NotNegative | Rotation = "free"
    at_hinge: Literal["left", "right"] | None = None
    direction: Literal["normal", "axial", "rotational", "hinge"] = "normal"
    friction: NotNegative = 0.0
    law: Law | None = None
    unloading: Literal["elastic", "plastic", "broken"] = "elastic"


class Foundation(Stretch, kw_only=True, gc=False):
    """Elastic ground under a stretch of the beam; default: under the whole beam. It acts wherever the beam touches it.

    Parameters
    ----------
    k : float, (float, float) or list of (float, float), optional
        Modulus: force per length of beam and deflection (force/length^2); or (at from, at to), linear in between; or points
        (x, k) as of profile, where two at a place are a step; or inf: rigid, one way. Give either k or law.
    side : {"both", "below", "above"}
        Both (default) holds the beam, below pushes it up only, above pushes it down only.
    gap : float or (float, float)
        Distance to be closed before it acts (length); or (at from, at to), linear in between; negative = set too high.
        With side both it is there on both sides.
    profile : list of (float, float), optional
        Instead of gap: points (length, length), x from the left end of the beam in ascending order, and gap; straight in
        between, beyond its ends the last value. Points beside the foundation only shape it. In Python also an array with two
        columns.
    law : list of (float, float) or table, optional
        Instead of k: points of a curve, displacement past the gap and force per length (length, force/length), from (0, 0) on,
        which is left out. The force may fall, but not below 0, nor at last; no displacement stands there twice. The last slope
        continues. With side both
        the curve is mirrored. Or tables with x and points, as many at every position, linear in between. Or a table with a type,
        the name of a curve, whose parameters are numbers per length, (at from, at to), or points (x, value), linear in
        between: curves are solved to all digits.
    shear : float
        Second parameter (force) of ground that holds both ways: what it resists differences of its deflection with, shear times
        slope (Pasternak, Vlasov; rotational springs along a pile). Default 0.
    name : str, optional
        Its name, unique among foundations; shown instead of its number.
    """

    k: Along | None = None
    side: Side = "both"
    gap: float | tuple[float, float] = 0.0
    profile: list[tuple[float, float]] | None = None
    law: GroundLaw | None = None
    shear: NotNegative = 0.0
    name: str | None = None


class Train(Table, forbid_unknown_fields=True, kw_only=True):
    """Loads that move together over the beam. Its position is that of its first axle; an axle on the beam, ends included, acts.

    Parameters
    ----------
    name : str
        By which results have it; default train 1, train 2, ...
    axles : list of (float, float)
        Distance behind the first axle, and force, positive downward (length, force). The train goes to the right.
    together : list of (str, float)
        Instead of axles: trains that go together with this one's position, each by its name with the distance (length) of its
        first axle behind that position. They bring their axles, factor and q, and alone they act as well.
    from_ : float, optional
        First position (length, from the left end of the beam); default: where the first load enters the beam.
        In Python the name is ``from_``.
    to : float, optional
        Last position (length); default: where the last load leaves the beam.
    case : str
        Name of the case that it belongs to; default live.
    factor : float
        Factor (no unit) of its axles and of q, before solving: impact, lane; default 1.
    both_directions : bool
        Also the mirrored train, which goes to the left; default false.
    inside : bool
        Only positions where the whole train is on the beam; default false.
    q : float or list of (float, float, float)
        Uniform load over the length of the train (force/length), positive downward; or uniform loads, each from one distance
        behind the first axle to another, negative ahead of it (length, length, force/length).
    """

    name: str = ""
    axles: list[tuple[float, float]] = []
    together: list[tuple[str, float]] = []
    from_: float | None = field(default=None, name="from")
    to: float | None = None
    case: str = "live"
    factor: float = 1.0
    both_directions: bool = False
    inside: bool = False
    q: float | list[tuple[float, float, float]] = 0.0


class Combination(Table, forbid_unknown_fields=True, kw_only=True):
    """Load cases that act together, each with a factor; solved in a contact state of its own.

    Parameters
    ----------
    name : str
        Its name, unique among combinations.
    factors : dict of float
        Factor (no unit) of every case that acts; a case that is not listed does not act.
    settlements : dict of float
        Further movement of supports (length) by name or number, positive downward, of an axial one to the right. Like
        settlement it is there in full from the start.
    scheme_of : str, optional
        Name of another combination: this one is solved with the supports that act there. Those that are open there stay open,
        those that are closed hold both ways.
    expand : dict of {"parts", "signs", "spans"}
        Cases that stand for several combinations. signs: with its factor and with that factor negative; spans: its distributed
        loads on every choice of the spans that they reach, none included; parts: its uniform loads on those parts of spans where
        the influence lines of reactions, and of moment, shear and deflection at ends and tenths of spans, have one sign. Several
        cases with signs or spans: every pattern of each with every pattern of the others.
    limit_state : str
        Name of the limit state that it belongs to, such as ULS; default none. Every limit state has an envelope of its own.
    """

    name: str
    factors: dict[str, float]
    settlements: dict[int | str, float] = {}
    scheme_of: str | None = None
    expand: dict[str, Literal["parts", "signs", "spans"]] = {}
    limit_state: str = ""


class Scene(Table, forbid_unknown_fields=True, kw_only=True):
    """A beam with its supports and loads.

    Parameters
    ----------
    title : str
        Heading of the report.
    units : Units
        Labels of the units; they change no number.
    beam : Beam
        Spans and stiffnesses.
    sections : list of Section
        Stretches of other stiffness; later ones win.
    hinges : list of Hinge
        Hinges with a stiffness.
    supports : list of Support
        Supports; results list them in the same order.
    foundation : list of Foundation
        Elastic ground under stretches of the beam.
    axial_ground : list of AxialGround
        Ground that holds the beam along its axis.
    masses : list of Mass
        Masses at places, for frequencies.
    loads : list of Load
        Loads, each of a load case.
    trains : list of Train
        Loads that move.
    combinations : list of Combination
        Combinations of load cases; without any there is one, all cases with factor 1.
    analysis : Analysis
        Load steps and rule.
    limits : Limits, optional
        What the design allows; report and JSON say how far it is used.
    """

    title: str = ""
    units: Units = field(default_factory=Units)
    beam: Beam
    sections: list[Section] = []
    hinges: list[Hinge] = []
    supports: list[Support] = []
    foundation: list[Foundation] = []
    axial_ground: list[AxialGround] = []
    masses: list[Mass] = []
    loads: list[Load] = []
    trains: list[Train] = []
    combinations: list[Combination] = []
    analysis: Analysis = field(default_factory=Analysis)
    limits: Limits | None = None

    def to_dict(self) -> dict[str, Any]:
        """As plain data, by the keys of a file, what is as by default left out.

        Returns
        -------
        dict
            `read_scene` takes it.
        """
        return to_data(self)

    def to_toml(self, path: str | os.PathLike | None = None) -> str:
        """Write the scene as TOML.

        Parameters
        ----------
        path : str or os.PathLike, optional
            File to write as well.

        Returns
        -------
        str
            `read_scene` takes such a file.
        """
        text = to_toml(to_data(self))
        if path is not None:
            write_files({path: [text]})
        return text

    def span_ends(self) -> np.ndarray:
        """Place of every node, exact to the last digit.

        Returns
        -------
        numpy.ndarray
            x of nodes 0, 1, ..., n (length from the left end), where n is the number of spans.

        Examples
        --------
        >>> Scene(beam=Beam([0.1] * 10, EI=1.0)).span_ends()[[3, 10]]
        array([0.3, 1. ])
        """
        spans = np.asarray(self.beam.spans, dtype=float)
        with np.errstate(over="ignore", invalid="ignore"):  # of a scene that is refused
            ends = np.concatenate(([0.0], np.cumsum(spans)))
            # What each addition of the running sum lost, exactly; summed up it corrects every end.
            before, after = ends[:-1], ends[1:]
            added = after - before
            ends[1:] += np.cumsum((before - (after - added)) + (spans - added))
        return ends

    def positions(self, items: Iterable[Support | ForceLoad | MomentLoad | AxialLoad]) -> np.ndarray:
        """Place of supports or point loads, whether given by node or by x.

        Parameters
        ----------
        items : iterable
            Supports or point loads of this scene, after `read_scene`.

        Returns
        -------
        numpy.ndarray
            x of each (length from the left end), never outside the beam.
        """
        ends = self.span_ends()
        at_nodes = ends.tolist()
        places = [at_nodes[item.node] if item.x is None else item.x for item in items]
        return np.clip(np.array(places, dtype=float), 0.0, ends[-1])
