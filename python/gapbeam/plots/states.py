"""Contact states of supports as symbols: by colour and by shape, so that they are told apart in grey as well."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.path import Path

from ..results.event_words import STATES
from ..results.state.breakpoints import Piece, piece_of, what_happens
from ..scene.laws import law_points
from ..scene.rotations import turns

if TYPE_CHECKING:
    from ..engine.beam import Beam
    from ..results.state.step import Step
    from ..scene.laws import Law
    from ..scene.structs import Scene

#: State -> fill of its symbol; in this order in the legend
FACES = {"closed": "black", "open": "white", "bilateral": "0.7", "one-sided": "0.88"}
#: The same for the branches of a law of the ground, from dark to light; from the last on all are alike
BRANCHES = ("black", "#5B2A86", "#B0306A", "#E8622C", "#F5A623", "#F7DC6F")
#: Of what has no contact
VERMILION = "#B84A00"

TRIANGLE = Path([(0, 0), (-0.6, -1), (0.6, -1), (0, 0)], [1, 2, 2, 79])
HEAD = Path([(0, 0), (-0.45, -1), (0.45, -1), (0, 0)], [1, 2, 2, 79])
_SQUARE = Path([(-0.5, 0), (0.5, 0), (0.5, -1), (-0.5, -1), (-0.5, 0)], [1, 2, 2, 2, 79])
_DIAMOND = Path([(0, 0), (0.6, -0.5), (0, -1), (-0.6, -0.5), (0, 0)], [1, 2, 2, 2, 79])
_PENTAGON = Path([(0, 0), (0.6, -0.45), (0.4, -1), (-0.4, -1), (-0.6, -0.45), (0, 0)], [1, 2, 2, 2, 2, 79])
_CROSS = Path([(-0.5, 0), (0.5, -1), (-0.5, -1), (0.5, 0)], [1, 2, 1, 2])


class Symbol(NamedTuple):
    """How a support is drawn.

    Attributes
    ----------
    words : str
        In the legend.
    path : matplotlib.path.Path
        With its upper edge in the origin; one unit high.
    face, edge : str
        Colours.
    width : float
        Of its lines (points).
    """

    words: str
    path: Path
    face: str
    edge: str = "black"
    width: float = 0.8


#: In the order of the legend; colours of Okabe and Ito, whose greys differ too
SYMBOLS = {
    "closed": Symbol(STATES["closed"], TRIANGLE, FACES["closed"]),
    "open": Symbol(STATES["open"], TRIANGLE, FACES["open"], VERMILION, 1.1),
    "bilateral": Symbol(STATES["bilateral"], TRIANGLE, FACES["bilateral"]),
    "one-sided": Symbol("one-sided", TRIANGLE, FACES["one-sided"]),
    "yields": Symbol("yields", _SQUARE, "#E69F00"),
    "hardens": Symbol("hardens", _PENTAGON, "#56B4E9"),
    "softens": Symbol("softens", _DIAMOND, "#CC79A7"),
    "broken": Symbol("broken", _CROSS, "none", "#A3001E", 1.6),
}


def kinds_of(scene: Scene, beam: Beam, step: Step) -> tuple[str, ...]:
    """Tell what every support does.

    Parameters
    ----------
    scene : Scene
        The scene.
    beam : Beam
    step : Step
        The state.

    Returns
    -------
    tuple of str
        Keys of `SYMBOLS`: states, and of a law beyond its first branch what has happened.
    """
    kinds = list(step.state)
    for k in beam.laws if beam.has_laws else ():
        piece = piece_of(beam, k, step.closed, step.breakpoints)
        if piece.number:
            broken = piece.number > 1 and piece.slope == 0.0 == step.reaction[k]
            kinds[k] = "broken" if broken else "closed" if piece.number == 1 else _beyond(beam, k, step, piece)
    for k, support in enumerate(scene.supports):
        if support.direction == "axial" and support.law is not None and kinds[k] not in SYMBOLS:
            kinds[k] = _beyond_along(support.law, int(kinds[k].rpartition(" ")[2]))
    return tuple(kinds)


def plain_kinds(states: tuple[str, ...]) -> tuple[str, ...]:
    """Take states for kinds where nothing is known of laws: every branch acts."""
    return tuple(state if state in SYMBOLS else "closed" for state in states)


def plain_states(scene: Scene) -> tuple[str, ...]:
    """Take for states what supports are, where nothing is known of what they do."""
    return tuple("bilateral" if support.side == "both" else "one-sided" for support in scene.supports)


def symbols_of(scene: Scene, kinds: tuple[str, ...]) -> tuple[str, ...]:
    """Take what those supports do that are drawn by symbols of their kind: clamps, and what holds a rotation, are not.

    Parameters
    ----------
    scene : Scene
    kinds : tuple of str
        Of all supports.
    """
    drawn = (not turns(one) and not (one.rotation == "fixed" and one.side == "both" and one.direction == "normal")
             for one in scene.supports)  # fmt: skip
    return tuple(kind for kind, is_drawn in zip(kinds, drawn, strict=True) if is_drawn)


def legend_handles(kinds: tuple[str, ...]) -> list[Line2D]:
    """Make the entries of the legend for what occurs."""
    found = set(kinds)
    return [
        Line2D([], [], linestyle="none", marker=_centred(symbol.path), markersize=7.0, markerfacecolor=symbol.face,
               markeredgecolor=symbol.edge, markeredgewidth=symbol.width, label=symbol.words)
        for kind, symbol in SYMBOLS.items() if kind in found
    ]  # fmt: skip


def face(state: str) -> str:
    """Give the fill of a state of the ground.

    Parameters
    ----------
    state : str
        Of a zone.

    Returns
    -------
    str
        Colour.
    """
    if state in FACES:
        return FACES[state]
    return BRANCHES[min(int(state.rpartition(" ")[2]), len(BRANCHES)) - 1]


def _centred(path: Path) -> Path:
    """Move a symbol so that its middle is the origin."""
    return Path(np.add(path.vertices, (0.0, 0.5)), path.codes)


def area(height: float) -> float:
    """Give the size matplotlib wants for a symbol whose largest coordinate of 1 is to be `height` points."""
    return (2.0 * height) ** 2


def mirrored(path: Path, sign: float) -> Path:
    """Mirror a symbol upward where `sign` is negative."""
    return Path(path.vertices * (1.0, sign), path.codes)


def _beyond(beam: Beam, support: int, step: Step, piece: Piece) -> str:
    """Name what has happened to a support that is beyond the first branch of its law."""
    where, *_ = beam.laws[support]
    count = int(step.closed[where].sum()) - piece.way
    slope = step.breakpoints[2, where.start + count - 1] if count else step.breakpoints[3, where.start]
    if slope == -np.inf:
        return "broken"
    happened = what_happens(Piece(piece.number - 1, float(slope), piece.way), piece)
    return {"": "closed", "breaks": "broken"}.get(happened, happened)


def _beyond_along(law: Law, branch: int) -> str:
    """Name what has happened to a support along the beam that is on a branch of its law."""
    if branch < 2:
        return "closed"
    points = np.array([(0.0, 0.0), *law_points(law)])
    with np.errstate(divide="ignore"):
        slopes = np.divide(*np.diff(points, axis=0).T[::-1])
    before, after = slopes[min(branch, len(slopes)) - 2], slopes[min(branch, len(slopes)) - 1]
    return what_happens(Piece(branch - 1, float(before), 1), Piece(branch, float(after), 1)) or "closed"
