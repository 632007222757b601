"""Checks of the keys and types of a scene: a `SceneError` names place, value and what was expected."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from numbers import Real
from typing import Any, TypeVar

import msgspec
import numpy as np

from ..base.characters import visible
from ..base.errors import SceneError
from .wording import as_text, explain

S = TypeVar("S", bound=msgspec.Struct)

WHOLE = ("node", "steps")
"""Keys of integers."""
TOO_DEEP = "tables or lists are nested too deeply"


def typed(source: S | Mapping[str, Any], struct: type[S]) -> S:
    """Turn data into a struct whose keys and types are right, all through.

    Parameters
    ----------
    source : struct or mapping
        Structs built in Python hold whatever they were given, so they are checked like any other data. Numpy
        numbers and arrays may stand for numbers and lists.
    struct : type
        The struct to make.

    Returns
    -------
    struct
        Independent of `source`.
    """
    try:
        if isinstance(source, struct):
            return msgspec.msgpack.decode(_packed(source), type=struct)
        if not _has_structs(source):
            return msgspec.convert(_with_lists(source), struct)
    except Exception:  # msgspec 0.23 asks a numpy number or row for keys, and lets out whatever it answers
        pass  # once more, slowly: to word the message, or to take numpy numbers and what UTF-8 does not know
    try:
        data = _with_whole(msgspec.to_builtins(source, enc_hook=_simple, str_keys=False))
        try:
            return msgspec.convert(data, struct)
        except UnicodeEncodeError:  # titles and labels may hold halves of characters; this is a key or a choice
            data = _written_out(data)
            return msgspec.convert(data, struct)
    except msgspec.ValidationError as error:
        raise explain(error, data, struct) from None
    except RecursionError:
        raise SceneError("the scene", TOO_DEEP) from None


def plain(struct: msgspec.Struct) -> dict[str, Any]:
    """Give a struct, whatever it holds, as dicts, lists and numbers.

    Parameters
    ----------
    struct : Struct
        As built in Python.

    Returns
    -------
    dict
        By its keys; halves of characters, which files cannot hold, are written out.
    """
    try:
        return msgspec.msgpack.decode(_packed(struct), strict=False)
    except UnicodeEncodeError:
        return _written_out(msgspec.to_builtins(struct, enc_hook=_simple, str_keys=False))


def _packed(struct: msgspec.Struct) -> bytearray:
    """MessagePack of a struct; `encode` would end the process where there is no memory for it (msgspec 0.22)."""
    packed = bytearray()
    msgspec.msgpack.Encoder(enc_hook=_simple).encode_into(struct, packed)
    return packed


def _simple(value: Any) -> Any:
    """Numbers and lists for what stands for them; anything else as its text, to be refused as such."""
    if isinstance(value, np.ma.MaskedArray):
        value = value.astype(object).filled("masked")  # numpy's null would mean that the key is left out
    if hasattr(value, "tolist"):
        listed = value.tolist()
        if type(listed) is not type(value):
            return listed
        return f"{value} ({type(value).__name__}; take float() of it)"  # more digits than a double holds
    if isinstance(value, Mapping):
        return dict(value)
    if isinstance(value, range):
        return list(value)
    if type(value).__name__ == "NAType":  # of pandas, which need not be there
        return "missing, pandas.NA"
    with suppress(OverflowError):
        if isinstance(value, Real):
            return float(value)
    return as_text(value)


def _written_out(data: Any) -> Any:
    """All texts of plain data without halves of characters."""
    if isinstance(data, dict):
        return {_written_out(key): _written_out(value) for key, value in data.items()}
    if isinstance(data, list | tuple):
        return [_written_out(item) for item in data]
    return visible(data) if isinstance(data, str) else data


def _with_lists(source: Mapping[str, Any]) -> Mapping[str, Any]:
    """The same data with lists for arrays of numbers in its tables: quicker than to look at all of it."""
    arrays = {
        key: {name: one.tolist() if type(one) is np.ndarray else one for name, one in value.items()}
        for key, value in source.items()
        if isinstance(value, dict) and any(type(one) is np.ndarray for one in value.values())
    }
    return {**source, **arrays} if arrays else source


def _with_whole(data: Any) -> Any:
    """Plain data with integers for floats that are whole, where integers are meant."""
    if isinstance(data, dict):
        return {
            key: int(one) if key in WHOLE and isinstance(one, float) and one.is_integer() else _with_whole(one)
            for key, one in data.items()
        }
    return list(map(_with_whole, data)) if isinstance(data, list) and not isinstance(next(iter(data), None), float) else data


def _has_structs(data: Mapping[str, Any]) -> bool:
    """Whether structs stand among the data; msgspec would take them unchecked."""
    kinds = set(map(type, data.values()))
    for value in data.values():
        if isinstance(value, list | tuple):
            kinds.update(map(type, value))
    return any(issubclass(kind, msgspec.Struct) for kind in kinds)
