"""The page of a result: data, tables, words and checks put into the template."""

from __future__ import annotations

import hashlib
import json
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import jinja2
import numpy as np

from ..base.errors import GapbeamError
from ..results import formatting as fmt
from ..results.answer import answer, has_cheap_envelope
from .geometry import foundations_data, panels_data, units_data
from .hand_check import sums_data, three_moments_data
from .states import packed, stands
from .tables import tables_of
from .ways import collect_ways
from .words import bounds_in_words, exactness, left_out

if TYPE_CHECKING:
    from ..results.envelopes.envelope import Envelope
    from ..results.result import Result
    from ..results.state.step import Step
    from ..results.trains.envelope import TrainEnvelope

TEMPLATES = Path(__file__).parent / "templates"
MOST_POINTS = 400
"""Places along the beam at which an envelope is drawn, about."""
SECONDS = "seconds"
"""What differs from run to run, and is left out."""


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

        Returns
        -------
        Source
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
    if envelope is not None and not envelope.extremes:
        envelope = None
    collected = collect_ways(result, envelope)
    points = max(2, min(20, MOST_POINTS // len(scene.beam.spans)))
    data = {
        "version": version("gapbeam"),
        "sha256": hashlib.sha256(source.data).hexdigest(),
        "result": _result_data(result, points),
        "panels": panels_data(result._beam.fields),
        "units": units_data(scene),
        "beams": collected.beams, "supports": collected.supports, "loads": collected.loads, "words": collected.words,
        "foundations": foundations_data(scene),
        "envelope": _curves(result, envelope, points),
        "ways": collected.ways,
    }  # fmt: skip
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(TEMPLATES), autoescape=True, trim_blocks=True, lstrip_blocks=True, undefined=jinja2.StrictUndefined
    )
    checked = _checked(result, envelope)
    return environment.get_template("page.html").render(
        title=fmt.title(scene), lines=answer(result), data=_json(data), version=data["version"], sha256=data["sha256"],
        source=source.name, text=source.data.decode("utf-8", "replace").lstrip("\ufeff"), tables=tables_of(result, envelope, collected.ways),
        ways=collected.ways, exactness=exactness(collected, bool(scene.foundation)), remarks=result.remarks,
        units=scene.units, ground=bool(scene.foundation), status=result.status, checked=checked,
        style="".join((TEMPLATES / name).read_text() for name in ("screen.css", "print.css")),
        script="".join((TEMPLATES / name).read_text() for name in ("evaluate.js", "draw.js", "page.js")),
    )  # fmt: skip


def _result_data(result: Result, points: int) -> dict[str, Any]:
    """As the JSON output, without the seconds and without what is given state by state."""
    data = result.to_data(points, steps=_short_steps)
    data.pop("fields", None)
    data.get("envelope", {}).pop("fields", None)
    return data


def _short_steps(steps: Any) -> list[dict[str, Any]]:
    """Steps or combinations without their supports, which the ways have, and without run times."""
    found = []
    for step in steps:
        one = {key: value for key, value in step.items() if key not in (SECONDS, "supports", "contact", "free_spans")}
        if "steps" in one:
            one["steps"] = _short_steps(one["steps"])
        found.append(one)
    return found


def _curves(result: Result, envelope: Envelope | TrainEnvelope | None, points: int) -> dict[str, Any] | None:
    """Largest and smallest values along the beam, where there are several states."""
    if envelope is None or not (result.combinations or result.scene.trains or hasattr(envelope, "over")):
        return None
    curves = result.envelope(points).fields
    names = [one["name"] for one in panels_data(result._beam.fields) if one["name"] in curves.largest]
    found = {name: [packed(curves.largest[name]), packed(curves.smallest[name])] for name in names}
    return {"x": packed(curves.x), "fields": found} if np.isfinite(curves.x).all() else None


def _json(data: Any) -> str:
    """Write JSON that may stand in a page: no text in it ends the script."""
    text = json.dumps(data, allow_nan=False, separators=(",", ":"), default=float)
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def _checked(result: Result, envelope: Envelope | TrainEnvelope | None) -> dict[str, Any] | None:
    """Check one state by hand: that at the end of the load, else that with the largest moment."""
    found = _state_to_check(result, envelope)
    if found is None:
        return None
    words, one, step = found
    if not stands(step):
        return None
    return {"words": words, "sums": sums_data(one, step), "three": three_moments_data(one, step), "bounds": bounds_in_words(one, step),
            "left_out": left_out(one)}  # fmt: skip


def _state_to_check(result: Result, envelope: Envelope | TrainEnvelope | None) -> tuple[str, Result, Step] | None:
    if len(result.steps) and not result.scene.trains:
        step = result.steps[-1]
        return f"at load factor {fmt.number(step.factor)}", result, step
    if envelope is None:
        return None
    extremes = [one for one in envelope.extremes["moment"].values() if one is not None]
    largest = max(extremes, key=lambda one: abs(one.value))
    name, train = largest.combination, getattr(largest, "train", None)
    one = result if name is None else result.combinations[name]
    words = f"with the largest moment: {name}" if name is not None else "with the largest moment"
    if train is not None:
        try:
            state = one.trains[train].state(largest.position, largest.direction)
        except (GapbeamError, ValueError):  # at the very position at which it can no longer stand
            return None
        return f"{words}, {train} at {fmt.number(largest.position)}", state.result, state
    if getattr(largest, "factor", None) is not None and name is not None:
        words += " at the end of its load"
    return (f"{words}, load factor {fmt.number(one.steps[-1].factor)}", one, one.steps[-1]) if len(one.steps) else None
