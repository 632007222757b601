"""Envelopes of combinations and trains as pictures: largest and smallest values along the beam, reactions, and what governs."""

from __future__ import annotations

import textwrap
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.transforms import blended_transform_factory
from msgspec.structs import replace

from ..base.characters import visible, with_minus_signs
from ..results import formatting as fmt
from ..results.answer import holds_values
from ..results.cases.limit_states import names_in_pictures
from ..results.formatting import stretch
from ..results.trains.envelope import places_along
from ..scene.loads import ForceLoad
from .beam import SupportLanes, draw_beam
from .bezier import path_of, smooth
from .curves import add_path, limit_values
from .ground import GroundLanes, draw_ground, points_a_span
from .key import CHARACTERS, Key, foot_height, source_name, write_foot
from .labels import text_width
from .load_symbols import draw_loads
from .loads import LoadLanes
from .marks import Marks
from .panels import MOST_CHARACTERS, MOST_POINTS, PANELS, axial_force_told, counts, cut_text, outcome
from .save import literal
from .sheet import Sheet, along, heading_height
from .states import legend_handles, plain_states, symbols_of
from .support_values import EnvelopeValues
from .thin import outline
from .turned import Turned, is_turned, raw

if TYPE_CHECKING:
    from ..results.envelopes.envelope import Curves, Envelope
    from ..results.result import Result
    from ..results.trains.envelope import TrainEnvelope
    from ..scene.structs import Scene

STRIP = 0.08
"""Height of the strip that tells what governs, as a share of the panel."""
MOST_POINTS_FILLED = 20_000
"""Points of a curve up to which the range is filled."""
MOST_CURVED = 1_000
"""Points of a curve up to which it is rounded between them."""
MOST_STRIPS = 500
"""Changes of what governs that are drawn along a beam."""
POINTS, POINTS_ALL, MOST_ON_GROUND = 40, 80, 70
"""Divisions of a span, and of a beam, at least."""
BESIDE = 1e-9
"""How far beside a place a curve is looked at where it may jump, as a share of the beam."""
ABOUT = ("moment", "shear", "deflection")
"""Quantity whose largest value decides where trains are drawn: the first that is there."""


def envelope_figure(result: Result) -> Figure:
    """Draw the envelope of combinations, of trains, or of both as a matplotlib figure.

    Parameters
    ----------
    result : Result
        With combinations or trains.

    Returns
    -------
    matplotlib.figure.Figure
        Beside the supports stand their largest and smallest reactions; trains stand where the largest moment comes from. Under the
        beam is a panel for every field: the range between its smallest and its largest values. The strips at the edges tell what
        governs, by letters that the key below explains; extremes have place and source beside them.
    """
    scene = result.scene
    envelope = _envelope(result)
    sources = [] if envelope is None else getattr(envelope, "_members", None) or envelope.sources
    names = [source_name(one) for one in sources]
    known = names_in_pictures(result) if result.combinations else {}
    told = {name: _told(name, one, known) for name, one in zip(names, sources, strict=True)}
    names = [told[name][0] for name in names]
    key = Key(scene, len(set(names)), told)
    panels = [panel for panel in PANELS if envelope is not None and panel[0] in envelope.extremes]
    drawn = {panel[0]: _governing(envelope.fields, panel[0], names, key) for panel in panels}
    strips = len({name for of in drawn.values() for stretches in of for *_, name in stretches}) > 1  # one alone needs none
    length, states = along(scene), plain_states(scene)
    ground = GroundLanes(scene, length)
    values = None if envelope is None else EnvelopeValues(scene, envelope, key)
    supports = SupportLanes(scene, states, length, (ground.below, ground.above), values)
    extremes = {panel[0]: _marks(envelope.extremes[panel[0]], key) for panel in panels}
    loaded, note = _loaded(envelope, result) if scene.trains and envelope is not None else (None, "")
    loads = None if loaded is None else LoadLanes(loaded, supports.top, length)
    if values is not None and len(values.up):
        positions = ", with the position of the train" * bool(scene.trains)
        note += f" Beside supports: the largest and the smallest reaction{positions}."
    top = supports.top + 4.0 if loads is None else loads.top
    lines = supports.texts.foot + textwrap.wrap(note.strip(), CHARACTERS) + key.lines()
    text = _headline(result, sources, strips)
    handles = legend_handles(symbols_of(scene, states)) * (not supports.rows)
    sheet = Sheet(scene, heading_height(scene, text, handles), supports.bottom, top, len(panels), foot_height(lines))
    draw_ground(sheet.sketch, ground, ())
    draw_beam(sheet.sketch, scene, states, supports)
    if loads is not None:
        draw_loads(sheet.sketch, loads)
    sheet.write_heading(text, handles)
    for quantity, words, downward in panels:
        panel = sheet.panel(quantity, words, downward)
        _range(panel, scene, envelope.fields, quantity, extremes[quantity], strips and bool(drawn[quantity]))
        for edge, stretches in enumerate(drawn[quantity] if strips else ()):
            _strip(panel, stretches, key, edge, length)
    sheet.finish()
    write_foot(sheet.picture, lines)
    return literal(sheet.picture)


def _envelope(result: Result) -> Envelope | TrainEnvelope | None:
    """Make the envelope at so many places that its curves look smooth; where something jumps, on both sides."""
    scene = result.scene
    if scene.trains and not result.has_envelope:
        return None
    points = max(POINTS, POINTS_ALL // len(scene.beam.spans), min(points_a_span(scene, result._beam), MOST_ON_GROUND))
    points = int(max(2, min(points, MOST_POINTS // len(scene.beam.spans))))
    if not scene.trains:
        return result.envelope(points) if "solved" in result.statuses else None
    places, end = places_along(result._beam, points), float(scene.span_ends()[-1])
    jumps = [scene.positions(scene.supports), *_ends_of_ways(result), *([stretch(scene, item)] for item in scene.foundation)]
    jumps = np.unique(np.concatenate([np.ravel(one) for one in jumps]))
    jumps = jumps[(jumps > 0.0) & (jumps < end)]
    beside = np.concatenate((np.setdiff1d(places, jumps), jumps - BESIDE * end, jumps + BESIDE * end))
    envelope = result.envelope(x=np.unique(beside))
    return envelope if holds_values(envelope) else None


def _ends_of_ways(result: Result) -> list[np.ndarray]:
    """Give the places of axles where trains begin and end their way, if that is on the beam: there shears jump."""
    found = []
    for train in result.scene.trains:
        ends = [place for place in (train.from_, train.to) if place is not None]
        offsets = np.array([distance for distance, _ in train.axles], dtype=float)
        found += [place - offsets for place in ends]
        found += [place + offsets for place in ends] if train.both_directions else []
    return found


def _told(name: str, source: Any, known: dict[str, tuple[str, str]]) -> tuple[str, str]:
    """Give the name that the key tells of a source, and its limit state."""
    if source.combination not in known:
        return name, ""
    shown, limit_state = known[source.combination]
    return visible(shown) + name.removeprefix(visible(source.combination)), limit_state


def _headline(result: Result, sources: list[Any], several: bool) -> str:
    """Say what the picture is of."""
    text = "Largest and smallest values" if sources else outcome(result)
    if result.combinations:
        total, solved = len(result.names), result.statuses.count("solved")
        text = f"Envelope of {fmt.count(total, 'combination')}"
        if solved < total and not (result.scene.trains and sources):
            text = f"Envelope of {solved:,} of {fmt.count(total, 'combination')}, the others are not solved"
    if result.scene.trains and sources:
        names = ", ".join(dict.fromkeys(visible(one.train) for one in sources if one.train))
        text += cut_text(f" while trains pass: {names}", 85)
        if not result.combinations and result.steps:
            text += axial_force_told(result, result.steps[-1])
    return "\n".join(textwrap.wrap(text + "; the strips tell which one governs" * several, MOST_CHARACTERS))


def _loaded(envelope: TrainEnvelope, result: Result) -> tuple[Scene | None, str]:
    """Give the scene with the axles where the largest value comes from, and say so."""
    scene = result.scene
    for name in ABOUT:
        found = [one for one in envelope.extremes.get(name, {}).values() if one is not None and one.position is not None]
        if found:
            most = max(found, key=lambda one: abs(one.value))
            state = getattr(most.state, "result", None)
            value = with_minus_signs(fmt.value(scene, name, most.value, 4))
            place = with_minus_signs(fmt.value(scene, "x", most.position, 4))
            words = f"Drawn: {source_name(most)} at position {place}, from which the largest {name} comes: {value}."
            if state is None:
                return None, ""
            # What acts in a combination comes before the axles
            first = len((scene if most.combination is None else result.combinations[most.combination].scene).loads)
            loads = [*state.scene.loads[:first], *(replace(load, name="axle") if isinstance(load, ForceLoad) else load
                                                   for load in state.scene.loads[first:])]  # fmt: skip
            return replace(state.scene, loads=loads), words
    return None, ""


def _marks(extremes: dict[str, Any], key: Key) -> list[tuple[float, float, str]]:
    """Choose the extremes that are written: values, places, sources."""
    there = {kind: one for kind, one in extremes.items() if one is not None}
    pairs = {kind: (one.value, one.x) for kind, one in there.items()}
    found = []
    for kind, one in there.items():
        if counts(one.value, pairs):
            source = key.source(one)
            if not key.needed and getattr(one, "position", None) is not None:
                source = f"{visible(one.train)} {source}"
            found.append((*pairs[kind], f", {source}" if source else ""))
    return found


def _range(
    axes: Axes | Turned, scene: Scene, curves: Curves, quantity: str, extremes: list[tuple[float, float, str]], strips: bool
) -> None:
    """Draw the range of one field, and its extremes."""
    for values in (curves.largest[quantity], curves.smallest[quantity]):
        if len(curves.x) <= MOST_CURVED:
            add_path(axes, *path_of(smooth(curves.x, values), np.ptp(values) / 2e3), 1.1)
        else:
            x, y = outline(curves.x, values, along(scene))
            axes.plot(x, y, color="black", linewidth=0.6, solid_joinstyle="round", zorder=3, label="curve")
    if len(curves.x) <= MOST_POINTS_FILLED:
        axes.fill_between(curves.x, curves.smallest[quantity], curves.largest[quantity], color="0.9", linewidth=0, zorder=1)
    limit_values(axes, [value for value, *_ in extremes], 0.24 + 0.12 * strips)
    finite = np.isfinite(curves.largest[quantity])
    drawn = [(curves.x[finite], values[quantity][finite]) for values in (curves.largest, curves.smallest)]
    marks = Marks(axes, fmt.shown_unit(scene, quantity)[1], (), drawn)
    for value, x, more in extremes:
        marks.extreme(value, x, more)


def _governing(curves: Curves, quantity: str, names: list[str], key: Key) -> list[list[tuple[float, float, str]]]:
    """Cut the beam where what governs changes: stretches with its name, for the largest and for the smallest values."""
    if not key.needed:
        return []
    numbers = {name: k for k, name in enumerate(dict.fromkeys(names))}
    same = np.array([numbers[name] for name in names])
    order = list(numbers)
    found = []
    for of in (curves.largest_of[quantity], curves.smallest_of[quantity]):
        of = same[of]
        changes = np.concatenate(([0], np.flatnonzero(np.diff(of)) + 1, [len(of)]))
        if len(changes) > MOST_STRIPS:
            return []  # no eye could part them
        ends = np.append(curves.x[changes[:-1]], curves.x[-1]).tolist()
        stretches = [(a, b, order[of[first]]) for first, (a, b) in zip(changes.tolist(), pairwise(ends), strict=False) if b > a]
        for *_, name in stretches:
            key.letter(name)
        found.append(stretches)
    return found


def _strip(axes: Axes | Turned, stretches: list[tuple[float, float, str]], key: Key, edge: int, length: float) -> None:
    """Draw what governs along the beam, with its letter where there is room."""
    inner, turned = raw(axes), is_turned(axes)
    upper = (edge == 0) != axes.yaxis_inverted()
    bottom = 1.0 - STRIP if upper else 0.0
    place = blended_transform_factory(*((inner.transAxes, inner.transData) if turned else (inner.transData, inner.transAxes)))
    scale = length / max(end for _, end, _ in stretches)
    for name in dict.fromkeys(name for *_, name in stretches):
        corners = []
        for a, b in [(a, b) for a, b, other in stretches if other == name]:
            box = [(a, bottom), (b, bottom), (b, bottom + STRIP), (a, bottom + STRIP)]
            corners.append([point[::-1] for point in box] if turned else box)
            if (6.0 if turned else text_width(key.letter(name))) < (b - a) * scale:
                middle = ((a + b) / 2, bottom + STRIP / 2)
                inner.text(*(middle[::-1] if turned else middle), key.letter(name), fontsize=6.0, ha="center", va="center",
                           transform=place, zorder=6)  # fmt: skip
        areas = PolyCollection(corners, facecolors=key.colour(name), edgecolors="white", linewidths=0.3, transform=place, zorder=2,
                               label="governs")  # fmt: skip
        inner.add_collection(areas, autolim=False)
