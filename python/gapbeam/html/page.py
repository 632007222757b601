"""The page of a result: data, tables, words and checks put into the template."""

from __future__ import annotations

import hashlib
import json
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import jinja2
import numpy as np

from ..base.characters import visible
from ..base.errors import GapbeamError
from ..engine.quantities import QUANTITIES
from ..results import formatting as fmt
from ..results.answer import answer, has_cheap_envelope, holds_values
from ..results.envelopes.over_path import PathEnvelope
from ..results.event_words import state_in_words
from ..scene.axial_ground import places_of_marks
from ..scene.names import label
from .hand_check import sums_data
from .states import SIDES, is_at_places, packed, stands
from .tables import tables_of
from .three_moments import three_moments_data
from .ways import Of, collect_ways
from .words import bounds_in_words, exactness, left_out

if TYPE_CHECKING:
    from ..results.envelopes.envelope import Envelope
    from ..results.result import Result
    from ..results.state.step import Step
    from ..results.trains.envelope import TrainEnvelope
    from ..scene.structs import Scene

TEMPLATES = Path(__file__).parent / "templates"
MOST_POINTS, FEWER_POINTS, FEWEST_POINTS = 400, 160, 60
"""Places along the beam at which an envelope is drawn, about; fewer while trains pass, fewest while they do so on the ground."""
LEFT_OUT = ("seconds", "supports", "contact", "free_spans", "certificate")
"""Keys of states that are left out of the result: run times differ from run to run, all others stand elsewhere on the page."""


class Source(NamedTuple):
    """Where a scene came from.

    Attributes
    ----------
    name : str
        Of the file; empty for a scene made in Python.
    data : bytes
        What stands there.
    """

    name: str
    data: bytes

    @classmethod
    def of_file(cls, path: str) -> Source:
        """Read a file.

        Parameters
        ----------
        path : str
            Its name.
        """
        return cls(Path(path).name, Path(path).read_bytes())


def html_page(result: Result, source: Source | None = None) -> str:
    """Write the page.

    Parameters
    ----------
    result : Result
        Of one load or of combinations.
    source : Source, optional
        The file of the scene; without it the scene is written as TOML.

    Returns
    -------
    str
        One file of HTML, the same whenever it is made of the same scene.
    """
    scene = result.scene
    source = source or Source("", scene.to_toml().encode())
    envelope = result.envelope() if result.has_envelope and has_cheap_envelope(result) else None
    envelope = envelope if holds_values(envelope) else None
    state = _state_to_check(result, envelope)
    first = None if state is None else ((state.combination, state.train, state.direction), state.position)
    collected = collect_ways(result, envelope, first)
    sampled = scene.trains and not result._beam.is_linear_between_events
    points = max(2, (FEWEST_POINTS if sampled else FEWER_POINTS if scene.trains else MOST_POINTS) // len(scene.beam.spans))
    whole = _result_data(result, points)
    data = {
        "first": _first(collected.ways, first),
        "version": version("gapbeam"),
        "sha256": hashlib.sha256(source.data).hexdigest(),
        "result": whole,
        "panels": _panels_data(result._beam.fields),
        "units": _units_data(scene), "upright": scene.beam.direction == "down",
        "beams": collected.beams, "supports": collected.supports, "loads": collected.loads, "words": collected.words,
        "said": list(map(state_in_words, collected.words)),
        "foundations": _foundations_data(scene), "along": places_of_marks(scene),
        "envelope": _curves(result, whole, envelope, points),
        "ways": collected.ways,
    }  # fmt: skip
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(TEMPLATES), autoescape=True, trim_blocks=True, lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
    )  # fmt: skip
    return environment.get_template("page.html").render(
        title=fmt.title(scene), lines=answer(result), data=_json(data), version=data["version"], sha256=data["sha256"],
        source=source.name, text=source.data.decode("utf-8", "replace").lstrip("\ufeff"),
        tables=tables_of(result, envelope, collected.ways), ways=collected.ways, remarks=result.remarks,
        exactness=exactness(collected, is_at_places(result)),
        footer=_css(f"{fmt.title(scene)[:60]} \u00b7 gapbeam {data['version']} \u00b7 input {data['sha256'][:12]}"),
        units=scene.units, upright=data["upright"],
        ground=bool(scene.foundation), status=result.status, checked=None if state is None else _checked(state),
        style="".join((TEMPLATES / name).read_text() for name in ("screen.css", "print.css")),
        script="".join(_without_comments((TEMPLATES / name).read_text()) for name in ("evaluate.js", "draw.js", "page.js")),
    )  # fmt: skip


def _result_data(result: Result, points: int) -> dict[str, Any]:
    """As the JSON output, without the seconds and without what is given state by state."""
    data = result.to_data(points, steps=_short_steps)
    data.pop("fields", None)
    for train in data.get("trains", []):
        del train["events"]  # the ways have them
    if "envelope" in data:
        data["envelope"] = {key: _without_ties(value) for key, value in data["envelope"].items()}
    return data


def _without_ties(value: Any) -> Any:
    """Leave out of an envelope what stands beside its values: there may be very many ties."""
    if isinstance(value, dict):
        return {key: _without_ties(one) for key, one in value.items() if key not in ("ties", "concurrent")}
    return [_without_ties(one) for one in value] if isinstance(value, list) else value


def _short_steps(steps: Any) -> list[dict[str, Any]]:
    """Steps or combinations without what is left out."""
    found = []
    for step in steps:
        one = {key: value for key, value in step.items() if key not in LEFT_OUT}
        if "steps" in one:
            one["steps"] = _short_steps(one["steps"])
        found.append(one)
    return found


def _curves(
    result: Result, whole: dict[str, Any], envelope: Envelope | TrainEnvelope | None, points: int
) -> dict[str, Any] | None:  # fmt: skip
    """Largest and smallest values along the beam, where there are several states; taken out of the envelope of the result."""
    names = [one["name"] for one in _panels_data(result._beam.fields)]
    if "envelope" in whole:
        columns = whole["envelope"].pop("fields")
        pairs = {name: (columns[name]["max"], columns[name]["min"]) for name in names if name in columns}
        x = columns["x"]
    elif envelope is not None and isinstance(envelope, PathEnvelope):
        curves = result.envelope(points).fields
        pairs, x = {name: (curves.largest[name], curves.smallest[name]) for name in names if name in curves.largest}, curves.x
    else:
        return None
    found = {name: [packed(np.array(values, dtype=float)) for values in pair] for name, pair in pairs.items()}
    return {"x": packed(np.array(x)), "fields": found}


def _json(data: Any) -> str:
    """Write JSON that may stand in a page: no text in it ends the script."""
    text = json.dumps(data, allow_nan=False, separators=(",", ":"), default=float)
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def _without_comments(script: str) -> str:
    """Leave out the lines that are comments, which no reader of the page needs."""
    return "".join(line for line in script.splitlines(keepends=True) if not line.lstrip().startswith("/*"))


def _css(text: str) -> str:
    """Write a text of a style sheet between quotation marks."""
    return "".join(one if one.isalnum() or one in " .,:-+()\u00b7" else f"\\{ord(one):x} " for one in text)


class Chosen(NamedTuple):
    """The state that is shown first and checked by hand, and where it is from."""

    words: str
    result: Result
    step: Step
    combination: str | None = None
    train: str | None = None
    position: float | None = None
    direction: str | None = None


def _state_to_check(result: Result, envelope: Envelope | TrainEnvelope | None) -> Chosen | None:
    """Choose the state at the end of the load; with combinations or trains that with the largest moment."""
    if len(result.steps) and not result.scene.trains:
        step = result.steps[-1]
        last = "" if result.stands else ", the last state that stands"
        return Chosen(f"at load factor {fmt.number(step.factor)}{last}", result, step)
    if envelope is None:
        return None
    extremes = [one for one in envelope.extremes["moment"].values() if one is not None]
    largest = max(extremes, key=lambda one: abs(one.value))
    name, train = largest.combination, getattr(largest, "train", None)
    one = result if name is None else result.combinations[name]
    words = "with the largest moment" if name is None else f"with the largest moment: {visible(name)}"
    if train is not None:
        try:
            state = one.trains[train].state(largest.position, largest.direction)
        except (GapbeamError, ValueError):  # at the very position at which it can no longer stand
            return None
        words += f"{':' if name is None else ','} {visible(train)} at {fmt.number(largest.position)}"
        return Chosen(words, state.result, state, name, train, largest.position, largest.direction)
    return Chosen(f"{words}, load factor {fmt.number(one.steps[-1].factor)}", one, one.steps[-1], name) if len(one.steps) else None


def _first(ways: list[dict[str, Any]], first: tuple[Of, float | None] | None) -> dict[str, Any]:
    """Number of the way that is shown first, and of a train its position."""
    if first is None or ways[0].get("motion"):
        return {"way": 0, "at": None}
    return next(({"way": k, "at": first[1]} for k, way in enumerate(ways) if way["of"] == list(first[0])), {"way": 0, "at": None})


def _checked(state: Chosen) -> dict[str, Any] | None:
    """Check a state by hand."""
    if not stands(state.step):
        return None
    of = state.result, state.step
    return {"words": state.words, "sums": sums_data(*of), "three": three_moments_data(*of), "bounds": bounds_in_words(*of),
            "left_out": left_out(state.result)}  # fmt: skip


def _foundations_data(scene: Scene) -> list[dict[str, Any]]:
    """Give the foundations as they are drawn."""
    found = []
    for k, one in enumerate(scene.foundation):
        from_, to = fmt.stretch(scene, one)
        found.append({"name": label(scene.foundation, k), "from": from_, "to": to, "side": SIDES[one.side]})
    return found


def _units_data(scene: Scene) -> dict[str, list[Any]]:
    """Give the unit that is shown of every quantity, and how many of it are one of the scene."""
    names = [one.name for one in QUANTITIES] + ["x", "opening", "reaction", "couple", "set", "friction", "slip"]
    names += ["uniform", "sag", "resultant"]
    return {name: list(fmt.shown_unit(scene, name)) for name in names}


def _panels_data(fields: dict[str, int]) -> list[dict[str, Any]]:
    """Give the fields that are drawn, each in a panel of its own: name, words, and whether positive values are drawn downward."""
    return [{"name": one.name, "words": one.panel, "down": one.downward} for one in QUANTITIES if one.name in fields and one.panel]
