"""The wording of refusals: places, values, and what was expected instead."""

from __future__ import annotations

import difflib
import json
import re
import sys
from collections.abc import Iterable, Mapping
from math import isinf
from typing import Any

import msgspec
from msgspec import inspect

from ..base.errors import SceneError
from ..base.hints import few
from .synonyms import meant_by_key, meant_by_value

UNFAVOURABLE = (
    "axles only where they are unfavourable are not available: where supports open, influence lines cannot be superposed, so such "
    "a choice misses what governs; give each choice as a train of its own"
)
NOT_BUILT = {
    "unfavourable": UNFAVOURABLE,
    "favourable": UNFAVOURABLE,
    "unfavourable_only": UNFAVOURABLE,
    "unfavourable_parts_only": UNFAVOURABLE,
}
"""Keys of a train that are refused by name."""
OF_ROTATIONS = ("counterclockwise", "clockwise", "sagging", "hogging")
"""Sides of supports that few have; those of other supports are told."""


def shown(value: Any) -> str:
    """Word a value the way a user wrote it, short enough for one line.

    Parameters
    ----------
    value : object
        Anything that may stand in a scene.

    Examples
    --------
    >>> shown("0,02"), shown(True), shown([1, 2.5]), shown({"x": 1}), shown(None)
    ('"0,02"', 'true', '[1, 2.5]', 'a table', 'null')
    """
    if isinstance(value, list | tuple):
        if any(isinstance(item, Mapping) for item in value):
            return "a list of tables"
        nested = any(isinstance(inner, list | tuple) for item in value if isinstance(item, list | tuple) for inner in item)
        text = "" if nested else "[" + ", ".join(shown(item) for item in value[:6]) + "]"
        return text if text and len(value) <= 6 and len(text) <= 60 else f"a list of {len(value)}"
    if isinstance(value, Mapping | msgspec.Struct):
        return "a table"
    if isinstance(value, str):
        return json.dumps(_short(value), ensure_ascii=False)
    if isinstance(value, float):
        return repr(float(value))
    if value is None or isinstance(value, bool):
        return json.dumps(value)
    return _short(as_text(value))


def as_text(value: Any) -> str:
    """Word any object by its own text.

    Parameters
    ----------
    value : object
        Anything.

    Returns
    -------
    str
        Of an integer that Python does not write out, how it is too long.

    Examples
    --------
    >>> as_text(10**5000)
    'an integer of more than 4300 digits'
    """
    try:
        return str(value)
    except ValueError:
        return f"an integer of more than {sys.get_int_max_str_digits()} digits"


def _short(text: str) -> str:
    return text if len(text) <= 60 else text[:57] + "..."


def number(value: float) -> str:
    """Word a number without the noise of its last bits.

    Parameters
    ----------
    value : float
        Any number.

    Examples
    --------
    >>> number(6.0), number(0.1 + 0.2), number(float("inf"))
    ('6', '0.3', 'inf')
    """
    return f"{value:.15g}"


def beyond(word: str) -> str:
    """Say of a number as it is written that no double is so large.

    Parameters
    ----------
    word : str
        The number.

    Examples
    --------
    >>> beyond("1e400")
    '1e400 is beyond the largest number of double precision, 1.8e308; take other units, or inf if that is meant'
    """
    return f"{_short(word)} is beyond the largest number of double precision, 1.8e308; take other units, or inf if that is meant"


def below(word: str) -> str:
    """Say of a number as it is written that it is not zero, but no double is so small.

    Parameters
    ----------
    word : str
        The number.

    Examples
    --------
    >>> below("1e-400")
    '1e-400 is nearer to zero than any number of double precision, 4.9e-324; take other units, or 0 if that is meant'
    """
    said = "is nearer to zero than any number of double precision, 4.9e-324; take other units, or 0 if that is meant"
    return f"{_short(word)} {said}"


def out_of_range(word: str, value: float) -> str | None:
    """Say of a number as it is written that it is beyond the range of doubles.

    Parameters
    ----------
    word : str
        The number.
    value : float
        What double precision makes of it.

    Returns
    -------
    str or None
        None where it is not.

    Examples
    --------
    >>> out_of_range("0.00e-400", 0.0), out_of_range("-inf", float("-inf")), out_of_range("1e-310", 1e-310)
    (None, None, None)
    """
    if isinf(value) and "inf" not in word.lower():
        return beyond(word)
    if value == 0.0 and re.search("[1-9]", re.split("[eE]", word)[0]):
        return below(word)
    return None


def choice(words: Iterable[str], last: str = "or") -> str:
    """Join words to a list in a sentence.

    Parameters
    ----------
    words : iterable of str
        The words; equal ones count once.
    last : str
        Conjunction before the last one.

    Examples
    --------
    >>> choice(["a", "b", "c"]), choice(["a", "b"], "and"), choice(["a"])
    ('a, b or c', 'a and b', 'a')
    """
    *head, tail = dict.fromkeys(words)
    return f"{', '.join(head)} {last} {tail}" if head else tail


def enumerated(words: Iterable[str], most: int = 12) -> str:
    """Join words to a list in a sentence, of many only the first.

    Parameters
    ----------
    words : iterable of str
        The words; equal ones count once.
    most : int
        How many are told.

    Examples
    --------
    >>> enumerated(["a", "b", "c"]), enumerated(["a", "b", "c"], 2)
    ('a, b and c', 'a, b and 1 more')
    """
    words = list(dict.fromkeys(words))
    return few(words, most) if len(words) > most else choice(words, "and")


def unequal_to_spans(key: str, count: int, spans: int) -> SceneError:
    """Make the error of a key of the beam that has another number of values than there are spans."""
    return SceneError(f"beam.{key}", f"has {count} value{'s' * (count != 1)} for {spans} spans; give one number, or one per span")


def explain(error: msgspec.ValidationError, source: Any, struct: type) -> SceneError:
    """Reword what msgspec says about a wrong key or type.

    Only the place is taken from msgspec's message. What was expected follows from the struct, what was found
    from the data.

    Parameters
    ----------
    error : msgspec.ValidationError
        Raised on converting `source`.
    source : object
        The data as dicts and lists.
    struct : type
        The msgspec struct that `source` was to become.
    """
    text, _, path = str(error).partition(" - at ")
    kind, value, place = inspect.type_info(struct), source, ""
    if path.startswith("`key`") or (text == "Expected `str`" and "key" in path):
        return SceneError(_place(path), "keys are texts, one key here is not")
    for name, index in re.findall(r"\.(\w+)|\[(\d+)\]", path):
        if name == "type" and isinstance(kind := _core(kind), inspect.UnionType):
            return SceneError(f"{place}.type", f"expected {_tags(kind)}, got {shown(value['type'])}"
                              + meant_by_value(f"{place}.type", value["type"], ""))  # fmt: skip
        kind = _inside(kind, value, name, int(index or 0))
        value = value[name] if name else value[int(index)]
        place += (f".{name}" if place else name) if name else f"[{index}]"
    if isinstance(table := _core(kind), inspect.DictType) and isinstance(value, Mapping):
        wrong = next((key for key, entry in value.items() if not _fits(table.value_type, entry)), None)
        if wrong is not None:
            kind, place, value = table.value_type, f"{place}.{key_of(wrong)}", value[wrong]
    if text.startswith("Object missing"):
        return _missing(kind, value, place)
    if text.startswith("Object contains unknown"):
        return _unknown(kind, value, place)
    if re.fullmatch(r"trains\[\d+\]\.together\[\d+\]\[1\]", place) and isinstance(value, list):
        problem = f"expected one distance, got {shown(value)}: where it may vary, give a train with together for every distance"
        return SceneError(place, problem)
    expected = _described(kind)
    if bound := re.search("([<>])= (-?[0-9]+)", text):
        expected += f" of at {'most' if bound[1] == '<' else 'least'} {int(bound[2]):,}"
    if isinstance(value, int) and abs(value) > sys.float_info.max and "number" in expected and "whole" not in expected:
        return SceneError(place, beyond(as_text(value)))
    return SceneError(place or "the scene", f"expected {expected}, got {shown(value)}{meant_by_value(place, value, expected)}")


def _place(path: str) -> str:
    """Give the path of msgspec in the words of the user."""
    return path.rpartition("$")[2].strip("`.") or "the scene"


def _fits(kind: inspect.Type, value: Any) -> bool:
    """Whether a value of a table of numbers or words is one."""
    if isinstance(kind, inspect.LiteralType):
        return isinstance(value, str) and value in kind.values
    return isinstance(value, int | float) and not isinstance(value, bool)


def key_of(name: str) -> str:
    """Write a key as TOML does: in quotes where it is empty or holds more than letters, digits, _ and -.

    Parameters
    ----------
    name : str
        The key.

    Examples
    --------
    >>> key_of("R-104"), key_of("wind left")
    ('R-104', '"wind left"')
    """
    name = str(name)
    return name if re.fullmatch(r"[A-Za-z0-9_-]{1,60}", name) else shown(name)


def _core(kind: inspect.Type) -> inspect.Type:
    """Strip a type: without descriptions and without the alternative null."""
    while isinstance(kind, inspect.Metadata):
        kind = kind.type
    if isinstance(kind, inspect.UnionType):
        members = [member for member in kind.types if not isinstance(member, inspect.NoneType)]
        return _core(members[0]) if len(members) == 1 else inspect.UnionType(tuple(members))
    return kind


def _struct(kind: inspect.Type, value: Mapping) -> inspect.StructType | None:
    """Find the struct that a table is to become; None where there are several, for a load without (valid) type."""
    kind = _core(kind)
    if isinstance(kind, inspect.UnionType):
        tables = [member for member in kind.types if isinstance(member, inspect.StructType)]
        if len(tables) == 1:
            return tables[0]
        return next((member for member in tables if member.tag == value.get("type")), None)
    return kind


def _inside(kind: inspect.Type, value: Any, name: str, index: int) -> inspect.Type:
    """Find the type of one member of a table (by name) or of a list (by index)."""
    if name:
        return next(field.type for field in _struct(kind, value).fields if field.encode_name == name)
    kind = _core(kind)
    members = kind.types if isinstance(kind, inspect.UnionType) else (kind,)
    for member in members:
        if isinstance(member, inspect.TupleType):
            return member.item_types[index]
        if isinstance(member, inspect.ListType):
            return member.item_type
    return kind


def _described(kind: inspect.Type, plural: bool = False) -> str:
    """Word what a user may write where `kind` is expected."""
    match _core(kind):
        case inspect.FloatType():
            return "numbers" if plural else "a number"
        case inspect.IntType():
            return "a whole number"
        case inspect.StrType():
            return "a text in quotes"
        case inspect.LiteralType(values=values):
            rare = OF_ROTATIONS if {"below", *OF_ROTATIONS} <= {*values} else ()
            return choice(shown(value) for value in values if value not in rare)
        case inspect.TupleType(item_types=items) if not all(isinstance(_core(item), inspect.FloatType) for item in items):
            return f"{'pairs' if plural else 'a pair'} of {choice(map(_described, items), 'and')}"
        case inspect.TupleType(item_types=items):
            if len(items) == 3:
                return f"{'lists' if plural else 'a list'} of three numbers"
            return f"{'pairs' if plural else 'a pair'} of numbers"
        case inspect.ListType(item_type=item):
            return f"a list of {_described(item, plural=True)}"
        case inspect.StructType():
            return "tables" if plural else "a table"
        case inspect.DictType(value_type=value):
            return f"a table of {_described(value, plural=True) if isinstance(value, inspect.FloatType) else 'words'}"
        case inspect.UnionType(types=types) if not plural:
            values = [shown(value) for member in types for value in getattr(member, "values", ())]
            members = [one for member in types if not hasattr(member, "values") for one in _alternatives(member)]
            return choice([*values, *dict.fromkeys(members)])
        case inspect.UnionType(types=types):
            others = [_described(member, plural=True) for member in types if not isinstance(member, inspect.StructType)]
            return choice([*others, "tables"])
    return "something else"


def _alternatives(kind: inspect.Type) -> list[str]:
    """Word what a user may write, where a list of numbers or pairs is one pair or several."""
    kind = _core(kind)
    if isinstance(kind, inspect.ListType) and isinstance(items := _core(kind.item_type), inspect.UnionType):
        pair = next((item for item in items.types if isinstance(item, inspect.TupleType)), None)
        if pair is not None and any(isinstance(_core(item), inspect.FloatType) for item in items.types):
            return [_described(pair), f"a list of {_described(pair, plural=True)}"]
    return [_described(kind)]


def _tags(kind: inspect.UnionType) -> str:
    """Choice of the types of tables."""
    return choice(shown(member.tag) for member in kind.types if isinstance(member, inspect.StructType))


def _missing(kind: inspect.Type, value: Mapping, place: str) -> SceneError:
    struct = _struct(kind, value)
    if struct is None:
        return SceneError(f"{place}.type", f"this key is missing; give {_tags(_core(kind))}")
    field = next(field for field in struct.fields if field.required and field.encode_name not in value)
    where = f"{place}.{field.encode_name}" if place else field.encode_name
    return SceneError(where, f"this key is missing; give {_described(field.type)}")


def _unknown(kind: inspect.Type, value: Mapping, place: str) -> SceneError:
    struct = _struct(kind, value)
    known = [field.encode_name for field in struct.fields]
    if struct.tag_field:
        known.insert(0, struct.tag_field)
    key = next(key for key in value if key not in known)
    where = f"{place}.{key_of(key)}" if place else key_of(key)
    if re.fullmatch(r"trains\[\d+\]", place) and key in NOT_BUILT:
        return SceneError(where, NOT_BUILT[key])
    meant = meant_by_key(key, known, place)
    if meant is not None and key.casefold() not in map(str.casefold, known):
        return SceneError(where, f"unknown key; {meant}")
    folded = {name.casefold(): name for name in known}
    near = difflib.get_close_matches(key.casefold().strip("_ "), folded, n=1, cutoff=0.55)
    if near:
        return SceneError(where, f'unknown key; did you mean "{folded[near[0]]}"?')
    what = "law" if place.endswith(".law") else "load"
    owner = f" of a {what} of type {shown(struct.tag)}" if struct.tag else ""
    return SceneError(where, f"unknown key; the keys{owner} are {choice(known, 'and')}")
