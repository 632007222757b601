"""Hints at the name that was meant, where one is asked for that is not there."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any


def nearest(name: str, known: Iterable[str], cutoff: float = 0.6) -> str | None:
    """Find the name that is most like another.

    Parameters
    ----------
    name : str
        What was written.
    known : iterable of str
        What there is.
    cutoff : float
        How like it must be, from 0 to 1.

    Examples
    --------
    >>> nearest("reaction", ["reactions", "openings"]), nearest("Moment", ["moment"]), nearest("x", ["shear"])
    ('reactions', 'moment', None)
    """
    import difflib  # only here: who makes no mistake does not wait for it

    folded = {one.casefold(): one for one in known}
    found = difflib.get_close_matches(name.casefold(), folded, n=1, cutoff=cutoff)
    return folded[found[0]] if found else None


def missing(owner: str, name: str, known: Iterable[str], meant: Mapping[str, str], before: str = "") -> str:
    """Word that there is no such attribute, and what was probably meant.

    Parameters
    ----------
    owner : str
        Whose it would be.
    name : str
        What was asked for.
    known : iterable of str
        The names that there are.
    meant : mapping of str to str
        What to write instead, by words of others in lower case without underscores.
    before : str
        What stands before the names when they are written.

    Examples
    --------
    >>> missing("Result", "reaction", ["reactions"], {}), missing("gapbeam", "Model", [], {"model": "gapbeam.Scene"})
    ("Result has no 'reaction'; did you mean reactions?", "gapbeam has no 'Model'; use gapbeam.Scene")
    """
    words = f"{owner} has no {name!r}"
    if (other := meant.get(name.lower().replace("_", ""))) is not None:
        return f"{words}; use {other}"
    near = nearest(name, known)
    return words if near is None else f"{words}; did you mean {before}{near}?"


def few(words: Iterable[str], most: int = 12) -> str:
    """Join words, of many only the first.

    Parameters
    ----------
    words : iterable of str
        The words.
    most : int
        How many are told.

    Examples
    --------
    >>> few(["a", "b", "c"]), few(["a", "b", "c", "d"], 2)
    ('a, b, c', 'a, b and 2 more')
    """
    words = list(words)
    return ", ".join(words[:most]) + (f" and {len(words) - most} more" if len(words) > most else "")


class Named(dict):
    """A dict that says what it has, when it is asked for something else.

    Parameters
    ----------
    noun : str
        What its entries are, in the singular.
    entries : mapping
        By name.
    meant : mapping of str to str
        The name to give instead, by words of others in lower case.
    without : str
        What is said where it is empty.

    Examples
    --------
    >>> Named("field", {"moment": 1.0, "shear": 2.0}, {"m": "moment"})["M"]
    Traceback (most recent call last):
    ...
    KeyError: "there is no field 'M'; did you mean 'moment'?"
    """

    def __init__(self, noun: str, entries: Mapping[str, Any] = {}, meant: Mapping[str, str] = {}, without: str = "") -> None:
        super().__init__(entries)
        self._words = noun, meant, without

    def __missing__(self, key: Any) -> Any:
        """Say what there is."""
        noun, meant, without = self._words
        raise KeyError(no_such(noun, key, self, meant) if self else f"there is no {noun} {key!r}: {without}")

    def __reduce__(self) -> tuple:
        """Pickle as made."""
        noun, meant, without = self._words
        return type(self), (noun, dict(self), meant, without)


def no_such(noun: str, key: Any, known: Iterable[str], meant: Mapping[str, str] = {}) -> str:
    """Word that there is no such entry, which one was probably meant, else which there are.

    Parameters
    ----------
    noun : str
        What the entries are, in the singular.
    key : object
        What was asked for.
    known : iterable of str
        The names that there are.
    meant : mapping of str to str
        The name to give instead, by words of others in lower case.
    """
    known = list(known)
    words = f"there is no {noun} {key!r}"
    near = meant.get(str(key).lower()) or nearest(str(key), [one for one in known if isinstance(one, str)])
    if near in known:
        return f"{words}; did you mean {near!r}?"
    return f"{words}; there are {few(map(repr, known))}"
