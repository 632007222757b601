"""The verbs by which every result is shown: outcome, table, picture, report, JSON; and hints at the right name."""

from __future__ import annotations

import os
import warnings
from collections.abc import Mapping
from importlib import import_module
from typing import TYPE_CHECKING, Any, ClassVar, Protocol

from ...base.errors import UnsolvedError
from ...base.hints import missing

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from .columns import Columns
    from .labelled import Labelled

MEANT = {
    "reactionforces": "reactions", "forces": "reactions", "supportreactions": "reactions", "gaps": "openings", "uplift": "lifted",
    "moment": "at(x).moment, or extremes", "moments": "at(x).moment, or extremes", "m": "at(x).moment, or extremes",
    "shear": "at(x).shear, or extremes", "v": "at(x).shear, or extremes", "deflection": "at(x).deflection, or extremes",
    "displacement": "at(x).deflection", "displacements": "at(x).deflection", "rotation": "at(x).rotation",
    "todataframe": 'table("supports").to_pandas()', "topandas": 'table("supports").to_pandas()',
    "dataframe": 'table("supports").to_pandas()', "columns": 'table("fields")', "todf": 'table("supports").to_pandas()',
    "tocsv": 'table("fields").to_pandas().to_csv(path)', "show": "plot()", "draw": "plot()", "figure": "plot()",
    "savefig": 'plot("name.svg")', "summary": "report()", "print": "report()", "text": "report()", "success": "ok",
    "converged": "ok", "solved": "ok", "message": "reason", "error": "reason", "maxmoment": 'extremes["moment"]["max"]',
    "max": 'extremes["moment"]["max"]', "min": 'extremes["moment"]["min"]', "asdict": "to_dict()", "json": "to_json()",
    "topdf": 'plot("name.pdf"), or to_html("name.html") to print',
    "toxlsx": "to_excel(path)", "excel": "to_excel(path)", "save": "to_json(path) or to_excel(path)",
}  # fmt: skip
"""What to write for words of other programs, in lower case without underscores."""


class Display(Protocol):
    """Shows results: `gapbeam.show.display`, which stands above them."""

    def plot(
        self, result: Any, kind: str | None, path: str | os.PathLike | None, ax: Axes | None, support: int | str | None
    ) -> Figure:
        """Draw."""

    def report(self, result: Any) -> str:
        """Write a report."""

    def to_json(self, result: Any, path: str | os.PathLike | None, points: int) -> str:
        """Write JSON."""

    def to_excel(self, result: Any, path: str | os.PathLike) -> None:
        """Write tables for Excel."""

    def answer(self, result: Any) -> list[str]:
        """Say the answer."""

    def to_html(self, result: Any, path: str | os.PathLike | None) -> str:
        """Write a page of HTML."""

    def notebook(self, result: Any) -> str:
        """Write what a notebook shows."""


class Shown:
    """Base of results: they have ``status``, ``reason`` and `table`.

    Attributes
    ----------
    display : Display
        Given by the interface of the package: pictures and reports stand above results.
    """

    __slots__ = ()
    display: ClassVar[Display | None] = None
    renamed: ClassVar[Mapping[str, str]] = {}  # attributes by the names that they had
    meant: ClassVar[Mapping[str, str]] = {}  # as MEANT, of this kind alone
    _kinds: ClassVar[tuple[str, ...]] = ()  # of tables
    _drawn: ClassVar[tuple[str, ...]] = ()  # names with a dot of what can be drawn

    @property
    def ok(self) -> bool:
        """Whether it is solved."""
        return self.status == "solved"

    def raise_for_status(self) -> Any:
        """Raise an error unless it is solved.

        Returns
        -------
        object
            The result itself, so that this can stand behind `gapbeam.solve`.

        Raises
        ------
        UnsolvedError
            With ``status`` and ``reason``.

        Examples
        --------
        >>> import gapbeam
        >>> beam = gapbeam.Beam(spans=[4.0], EI=1.0)
        >>> gapbeam.solve(gapbeam.Scene(beam=beam, loads=[gapbeam.UniformLoad(q=1.0)])).raise_for_status()
        Traceback (most recent call last):
        ...
        gapbeam.base.errors.UnsolvedError: no equilibrium at load factor 1: the beam moves down as a whole; \
the loads push it that way and no support resists
        """
        if not self.ok:
            raise UnsolvedError(self.status, self.reason)
        return self

    @property
    def reactions(self) -> Labelled:
        """Reactions, positive upward, by number and name of the support; with combinations by combination, then by support.

        Of a result those at the end of the load; of an envelope, and while trains pass, each ``{"max": Extreme, "min": Extreme}``;
        of many cases arrays with an entry for every case; of a summary distributions.
        """
        return self._by_support("reaction")

    @property
    def openings(self) -> Labelled:
        """Distance still to go until a support acts, the gap included, as `reactions`."""
        return self._by_support("opening")

    def _by_support(self, quantity: str) -> Labelled:
        """Give a quantity by number and name of the support."""
        raise NotImplementedError

    def table(self, kind: str = "supports") -> Columns:
        """Give a table.

        Parameters
        ----------
        kind : str
            Which.

        Returns
        -------
        Columns
            Columns by name; ``to_pandas()`` makes a DataFrame of them.
        """
        raise NotImplementedError

    def plot(
        self, kind: str | os.PathLike | None = None, ax: Axes | None = None, *, path: str | os.PathLike | None = None,
        support: int | str | None = None,
    ) -> Figure:  # fmt: skip
        """Draw a picture.

        Parameters
        ----------
        kind : str, optional
            None: the whole picture, with the beam and all diagrams. ``path``: reactions and openings over the load factor.
            ``hysteresis``: the reaction of one support over its deflection, with the energy of every cycle. The name of a
            field, for example ``moment``: its diagram alone. A name with a suffix is taken for `path`.
        ax : matplotlib.axes.Axes, optional
            Where to draw the diagram of one field.
        path : str or os.PathLike, optional
            File to write as well; the suffix decides on the format: .png, .pdf or .svg.
        support : int or str, optional
            Number or name of the support whose hysteresis is drawn; default the one that takes up most energy.

        Returns
        -------
        matplotlib.figure.Figure
        """
        is_file = isinstance(kind, os.PathLike) or (isinstance(kind, str) and os.path.splitext(kind)[1] and kind not in self._drawn)
        if path is None and is_file:
            kind, path = None, kind
        return self._by.plot(self, kind, path, ax, support)

    def report(self) -> str:
        """Write the report for people, the answer first.

        Returns
        -------
        str
        """
        return self._by.report(self)

    def to_json(self, path: str | os.PathLike | None = None, points: int = 20) -> str:
        """Write everything as JSON.

        Parameters
        ----------
        path : str or os.PathLike, optional
            File to write as well.
        points : int
            Divisions of each span in the table of fields.

        Returns
        -------
        str
        """
        return self._by.to_json(self, path, points)

    def to_html(self, path: str | os.PathLike | None = None) -> str:
        """Write a page of HTML that one moves, prints and signs.

        It is one file that needs nothing else: a slider over the load, the trains or the combinations, tables, and for print the
        input, signs, checks by hand and error bounds.

        Parameters
        ----------
        path : str or os.PathLike, optional
            File to write as well.

        Returns
        -------
        str

        Examples
        --------
        >>> import gapbeam
        >>> scene = gapbeam.Scene(beam=gapbeam.Beam([4.0], EI=1e4), supports=[gapbeam.Support(node=0), gapbeam.Support(node=1)])
        >>> scene.loads = [gapbeam.UniformLoad(q=6.0)]
        >>> gapbeam.solve(scene).to_html()[:15]
        '<!DOCTYPE html>'
        """
        return self._by.to_html(self, path)

    def to_excel(self, path: str | os.PathLike) -> None:
        """Write the answer and all tables as sheets of an Excel file; xlsxwriter has to be installed.

        Parameters
        ----------
        path : str or os.PathLike
            File to write, for example ``beam.xlsx``.
        """
        self._by.to_excel(self, path)

    def __repr__(self) -> str:
        """Show the answer in some lines."""
        return "\n".join(self._by.answer(self))

    def _repr_html_(self) -> str:
        """Show the answer, a table and a picture in a notebook."""
        return self._by.notebook(self)

    @property
    def _by(self) -> Display:
        if Shown.display is None:  # the result was unpickled where nothing else of the package has been asked for
            import_module(f"{__name__.partition('.')[0]}.interface")
        return Shown.display

    def __getattr__(self, name: str) -> Any:
        """Say what was probably meant."""
        if name.startswith("_"):
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")
        new = next((one.__dict__["renamed"][name] for one in type(self).__mro__ if name in one.__dict__.get("renamed", ())), None)
        if new is not None:
            warnings.warn(f"{name} is no longer for users; it goes away", DeprecationWarning, stacklevel=2)
            return getattr(self, new)
        if hasattr(type(self), name):  # it is there, and said itself what is wrong
            return object.__getattribute__(self, name)
        known = [one for one in dir(self) if not one.startswith("_")]
        raise AttributeError(missing(type(self).__name__, name, known, {**MEANT, **self.meant}))
