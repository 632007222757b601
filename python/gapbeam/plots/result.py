"""A result as one picture: the beam with its supports and loads, deflection, moment and shear under one another.

Deflection is drawn downward and the moment on the tension side (sagging downward), as engineers do. matplotlib
is used through its objects, without pyplot and its state, so that pictures can be made in any thread.
"""

import os
import textwrap
from collections import Counter
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..base.characters import with_minus_signs
from ..results import formatting as fmt
from ..results.state.ground import joined, noun_of
from ..scene.rotations import turns
from .beam import SupportLanes, draw_beam, draw_contacts
from .bezier import cells_of
from .curves import draw_field
from .envelope import envelope_figure
from .ground import GroundLanes, cells_a_span, draw_ground, near_surface, zone_handles
from .key import foot_height, write_foot
from .load_symbols import draw_loads
from .loads import LoadLanes
from .marks import MOST_MARKS, find_peaks
from .movements import Movements, draw_movements
from .panels import MOST_CHARACTERS, PANELS, axial_force_told, outcome
from .save import literal, save
from .sheet import Sheet, along, heading_height
from .states import SYMBOLS, kinds_of, legend_handles, plain_kinds, plain_states, symbols_of
from .support_values import StateValues
from .turned import Turned, is_turned

if TYPE_CHECKING:
    from ..results.result import Result
    from ..results.state.ground import Contact

def plot(result: "Result", path: str | os.PathLike, step: int = -1) -> None:
    """Draw a result into a file.

    Parameters
    ----------
    result : Result
        What `gapbeam.solve` returned.
    path : str or os.PathLike
        The suffix decides on the format: .png, .pdf or .svg.
    step : int
        Load step; default the last.
    """
    save(figure(result, step), path)


def figure(result: "Result", step: int = -1) -> Figure:
    """Draw a result as a matplotlib figure.

    Parameters
    ----------
    result : Result
        What `gapbeam.solve` returned.
    step : int
        Load step; default the last.

    Returns
    -------
    matplotlib.figure.Figure
        The first panel holds the beam; the symbols of all supports in the same state and on the same side are one
        collection there, labelled for example ``open below``. Without equilibrium the second panel shows the free motion, of a
        beam that buckles its mode, else the panels are those of the fields. Of combinations and trains their envelope.
    """
    if result.scene.trains or result.combinations:
        return envelope_figure(result)
    scene = result.scene
    stands = result.status not in fmt.MOTIONS and len(result.steps) > 0
    panels = [("motion", fmt.MOTIONS.get(result.status, ""), True)]
    contact: tuple[Contact, ...] = ()
    states = plain_states(scene)
    kinds, values, state = plain_kinds(states), None, None
    if stands:
        state = result.steps[step]
        contact, states, kinds, values = state.contact, state.state, kinds_of(scene, result._beam, state), StateValues(scene, state)
        cells = cells_of(result, step, cells_a_span(scene, result._beam))
        panels = [panel for panel in PANELS if panel[0] in cells.values]
    elif not result.motion:
        panels = []

    length = along(scene)
    factor = state.factor if stands else 1.0
    movements = Movements(scene, factor)
    ground = GroundLanes(scene, length, movements)
    supports = SupportLanes(scene, states, length, (ground.below, ground.above), values, kinds, movements)
    loads = LoadLanes(scene, supports.top, length, factor)
    text = _headline(result, step, kinds, contact) if stands else outcome(result)
    handles = legend_handles(symbols_of(scene, kinds)) * (not supports.rows) + zone_handles(contact, result.scene)
    foot = supports.texts.foot
    sheet = Sheet(scene, heading_height(scene, text, handles), supports.bottom, loads.top, len(panels), foot_height(foot))
    draw_ground(sheet.sketch, ground, contact)
    draw_beam(sheet.sketch, scene, states, supports)
    draw_loads(sheet.sketch, loads)
    if not supports.rows:
        draw_movements(sheet.sketch, movements, supports.x, sheet.end, supports.size)
    sheet.write_heading(text, handles)
    for quantity, words, downward in panels:
        panel = sheet.panel(quantity, words, downward)
        if not stands:
            _motion(panel, result)
            continue
        contacts = seats = ()
        if quantity == "deflection":
            seats = draw_contacts(panel, scene, supports, state, float(np.abs(cells.values["deflection"]).max()))
            contacts = seats + near_surface(scene, cells, length, state.factor)
        marks = draw_field(panel, scene, cells, quantity, result._pairs_of_extremes(step)[quantity], contacts, state.factor, seats)
        if quantity == "moment":
            peaks = find_peaks(*cells.along("moment"), scene.span_ends(), lambda x: result.at(x, step))
            for value, x in peaks[:MOST_MARKS]:
                marks.peak(value, x)
    sheet.finish()
    write_foot(sheet.picture, foot)
    return literal(sheet.picture)


def _headline(result: "Result", step: int, kinds: tuple[str, ...], contact: "tuple[Contact, ...]") -> str:
    """Say how many supports do what."""
    scene, factor = result.scene, result.steps[step].factor
    counted = Counter(kind for kind, one in zip(kinds, scene.supports, strict=True) if not turns(one))
    text = with_minus_signs(f"load factor {fmt.number(factor)}")
    if result.status == "limit-load" and result.steps[step] is result.steps[-1]:
        text += " (limit load)"
    said = {kind: symbol.words for kind, symbol in SYMBOLS.items()}
    doing = {kind: f"{kind[:-1]}ing" if words == kind and words.endswith("s") else words for kind, words in said.items()}
    text += "".join(f", {counted[kind]:,} {words}" for kind, words in doing.items() if kind in counted)
    joints = [kind for kind, one in zip(kinds, scene.supports, strict=True) if turns(one)]
    if joints:
        verb = "hold" if len(joints) > 1 else "holds"
        text += f", {len(joints) - joints.count('open'):,} of {fmt.count(len(joints), 'joint')} {verb}"
    text += axial_force_told(result, result.steps[step])
    zones = joined(contact)
    text += f", contact in {fmt.count(len(zones), noun_of(zones))}" if contact else ""
    return "\n".join(textwrap.wrap(text, MOST_CHARACTERS))


def _motion(axes: Axes | Turned, result: "Result") -> None:
    x, displacement = np.transpose(result.motion)
    largest = np.abs(displacement).max() or 1.0
    axes.plot(x, displacement / largest, "--", color="black", linewidth=1.2, label="curve")
    axes.set_ylim(1.25, -1.25)
    (axes.axes.set_xticks if is_turned(axes) else axes.set_yticks)([])
