"""A result for programs: JSON and CSV."""

import csv
import io
import json
from collections.abc import Iterable, Iterator, Sequence
from types import GeneratorType
from typing import TYPE_CHECKING, Any

import numpy as np

from ..base.characters import cell
from ..base.memory import refuse_beyond
from ..engine.calls import parts
from ..results import formatting as fmt
from ..results.data import step_data
from ..results.state.fields import Fields

if TYPE_CHECKING:
    from ..results.result import Result


def to_json(result: "Result", points: int = 20) -> str:
    """Write the result as JSON; reading it back gives the very same floats.

    Parameters
    ----------
    result : Result
        What `gapbeam.solve` returned.
    points : int
        Divisions of each span in the table of fields.

    Returns
    -------
    str
        One line for each support, certificate and column of numbers: it can be read and compared by eye.

    Raises
    ------
    ValueError
        `points` is no whole number, or too large.
    SceneError
        There is not the memory for the text of so many steps.
    """
    if result.steps:
        text = "".join(_layout(next(step_data(result)), "  "))
        count = len(result.steps)
        refuse_beyond("analysis.steps", f"{count:,} steps as JSON", 2.0 * count * len(text), "take fewer")
    return "".join(json_parts(result, points))


def data_as_json(data: Any) -> str:
    """Write plain data as JSON in the same layout.

    Parameters
    ----------
    data : object
        Only numbers, strings, lists and dicts.
    """
    return "".join(_layout(data, "")) + "\n"


def json_parts(result: "Result", points: int = 20) -> Iterator[str]:
    """Write what `to_json` writes, part by part, each step when its turn comes.

    Parameters
    ----------
    result, points
        As for `to_json`.
    """
    yield from _layout(result.to_data(points, steps=iter, fields=Fields.columns), "")
    yield "\n"


def _layout(value: Any, indent: str) -> Iterator[str]:
    """Write JSON with every list of numbers, and every object without lists in it, on one line; generators as lists."""
    if isinstance(value, np.ndarray):
        for part in parts(len(value)):
            yield "[" if part.start == 0 else ", "
            yield json.dumps(value[part].tolist(), allow_nan=False)[1:-1]
        yield "]"
        return
    inner = value.values() if isinstance(value, dict) else value if isinstance(value, list | tuple) else ()
    lists = (dict, list, tuple, np.ndarray, GeneratorType)
    if type(value) is not GeneratorType and not any(isinstance(item, lists) for item in inner):
        yield json.dumps(value, allow_nan=False)
        return
    named = isinstance(value, dict)
    begin, end = "{}" if named else "[]"
    for key, item in value.items() if named else enumerate(value):
        yield f"{begin}\n{indent} " + (f"{json.dumps(key)}: " if named else "")
        yield from _layout(item, indent + " ")
        begin = ","
    yield f"\n{indent}{end}" if begin == "," else begin + end


def to_csv(result: "Result", points: int = 20) -> str:
    """Write the fields along the beam at the last step as comma-separated values, units in the header.

    Parameters
    ----------
    result : Result
        What `gapbeam.solve` returned.
    points : int
        Divisions of each span; load points, supports and jumps are added.

    Returns
    -------
    str
        Where moment, shear or axial force jump, x appears twice: the left value, then the right one. With combinations or trains
        the envelope: largest and smallest value of every field.
    """
    return "".join(csv_parts(result, points))


def csv_parts(result: "Result", points: int = 20) -> Iterator[str]:
    """Write what `to_csv` writes, part by part.

    Parameters
    ----------
    result, points
        As for `to_csv`.
    """
    governs = result.combinations or result.scene.trains
    columns = (result.envelope(points) if governs else result.fields(points=points)).columns()
    yield _csv([[cell(_heading(result, name)) for name in columns]])
    for part in parts(len(columns["x"])):
        texts = (
            some.tolist() if isinstance(some, np.ndarray) and some.dtype.kind in "fiu" else map(cell, some)
            for some in (column[part] for column in columns.values())
        )
        yield _csv(zip(*texts, strict=True))


def _heading(result: "Result", name: str) -> str:
    """Put the unit behind the name of a column; names of combinations and trains have none."""
    if name.endswith(("_combination", "_train", "_direction")):
        return name
    return fmt.with_unit(result.scene, "x" if name.endswith("_position") else name.removesuffix("_max").removesuffix("_min"), name)


def _csv(rows: Iterable[Sequence]) -> str:
    stream = io.StringIO()
    csv.writer(stream, lineterminator="\n").writerows(rows)
    return stream.getvalue()
