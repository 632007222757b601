"""Scenes that nobody changes any more: what a result was solved for stays what it says."""

from __future__ import annotations

from inspect import get_annotations
from operator import attrgetter
from typing import Any, NoReturn

from msgspec import Struct, StructMeta, structs

from .table import Table, kind_of

PLAIN = {"float", "int", "str", "bool", "None", "Positive", "NotNegative", "Node", "Count", "Modes", "Side", "SupportSide"}
"""Types of keys that hold nothing else."""
NUMBERS = {float, int, str}
"""Types of numbers and words."""
INSTEAD = 'use gapbeam.replace(result.scene, "supports[1].gap", 0.5), and solve that'

_HELD: dict[type[Struct], type[Struct]] = {}
_INNER: dict[type[Struct], tuple[str, ...]] = {}


def _refuse_key(table: Struct, key: str, value: Any) -> NoReturn:
    """Refuse to be changed."""
    raise AttributeError(f"{type(table).__name__}.{key}: a result keeps its model; {INSTEAD}")


def _free(table: Struct) -> tuple:
    """Copy and pickle as one that can be changed."""
    return _made, (kind_of(table), structs.asdict(table))


def _made(kind: type[Struct], values: dict[str, Any]) -> Struct:
    return kind(**values)


def _copied(table: Struct) -> Struct:
    return kind_of(table)(**structs.asdict(table))


def _held_type(kind: type[Struct]) -> type[Struct]:
    """Give the type of tables that cannot be changed, with the same keys and values, equal to it."""
    if kind not in _HELD:
        space = {
            "__module__": kind.__module__, "__qualname__": kind.__qualname__, "__doc__": kind.__doc__, "changeable": kind,
            "__setattr__": _refuse_key, "__reduce__": _free, "__copy__": _copied,
        }  # fmt: skip
        config = kind.__struct_config__
        given = {"tag": config.tag, "tag_field": config.tag_field} if config.tag is not None else {}
        _HELD[kind] = StructMeta.__new__(type(kind), kind.__name__, (kind,), space, gc=config.gc, **given)
        names = {name: words for one in reversed(kind.__mro__[:-1]) for name, words in get_annotations(one).items()}
        _INNER[kind] = tuple(name for name in kind.__struct_fields__ if not _is_plain(names[name]))
    return _HELD[kind]


def _is_plain(words: str) -> bool:
    return words.startswith("Literal[") or set(words.split(" | ")) <= PLAIN


class HeldList(list):
    """A list that cannot be changed."""

    def _refuse(self, *_: Any, **__: Any) -> NoReturn:
        raise TypeError(f"a list: a result keeps its model; {INSTEAD}")

    append = extend = insert = pop = remove = clear = sort = reverse = _refuse
    __setitem__ = __delitem__ = __iadd__ = __imul__ = _refuse

    def __reduce_ex__(self, _: Any) -> tuple:
        """Copy and pickle as a list that can be changed."""
        return list, (list(self),)


EMPTY = HeldList()


class HeldDict(dict):
    """A dict that cannot be changed."""

    def _refuse(self, *_: Any, **__: Any) -> NoReturn:
        raise TypeError(f"a table of a result keeps its model; {INSTEAD}")

    __setitem__ = __delitem__ = __ior__ = update = pop = popitem = clear = setdefault = _refuse

    def __reduce_ex__(self, _: Any) -> tuple:
        """Copy and pickle as a dict that can be changed."""
        return dict, (dict(self),)


def hold(value: Any) -> Any:
    """Let a scene, or a part of it, be changed no more.

    Parameters
    ----------
    value : object
        A table, which is held itself; a list or a dict, of which one that is held is given; anything else.

    Returns
    -------
    object

    Examples
    --------
    >>> from gapbeam import Support
    >>> hold(Support(node=0)).gap = 0.5
    Traceback (most recent call last):
    ...
    AttributeError: Support.gap: a result keeps its model; use gapbeam.replace(result.scene, "supports[1].gap", 0.5), and solve that
    """
    kind = type(value)
    if kind is list:
        return _held_list(value)
    if kind is dict:
        return HeldDict({key: hold(one) for key, one in value.items()})
    held = _HELD.get(kind)
    if held is None:
        if not issubclass(kind, Table) or "changeable" in kind.__dict__:
            return value
        held = _held_type(kind)
    for name in _INNER[kind]:
        inner = getattr(value, name)
        if inner is not None and type(inner) is not float:
            setattr(value, name, hold(inner))
    value.__class__ = held
    return value


def _held_list(values: list[Any]) -> HeldList:
    """Hold a list and what stands in it; of many tables of one type all at once."""
    if not values:
        return EMPTY
    kinds = set(map(type, values))
    if kinds <= NUMBERS:
        return HeldList(values)
    kind = kinds.pop()
    if kinds or not issubclass(kind, Table) or "changeable" in kind.__dict__:
        return HeldList(map(hold, values))
    held = _held_type(kind)
    for name in _INNER[kind]:
        if any(inner is not None and type(inner) is not float for inner in map(attrgetter(name), values)):
            return HeldList(map(hold, values))
    for one in values:
        one.__class__ = held
    return HeldList(values)
