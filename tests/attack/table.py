"""The table of the attack."""

from collections import Counter
from dataclasses import dataclass, field


@dataclass
class Row:
    """What became of one family.

    Attributes
    ----------
    name, promise : str
    outcomes : Counter
        Cases by outcome.
    wrong, hangs, aborts : int
        Cases with a wrong answer, without any, and that ended the process.
    ratios : dict
        By kind of scene and of value, bounds divided by the true errors.
    seconds : float
    """

    name: str
    promise: str
    outcomes: Counter = field(default_factory=Counter)
    wrong: int = 0
    hangs: int = 0
    aborts: int = 0
    ratios: dict = field(default_factory=dict)
    seconds: float = 0.0

    def add(self, verdict):
        """Count one verdict."""
        self.outcomes[verdict.outcome] += 1
        self.wrong += bool(verdict.wrong)
        self.hangs += verdict.outcome == "hang"
        self.aborts += verdict.outcome == "aborted"
        for value, ratios in verdict.ratios.items():
            self.ratios.setdefault((verdict.kind, value), []).extend(ratios)

    @property
    def count(self):
        """Cases."""
        return self.outcomes.total()

    def text(self):
        """A few lines for the screen."""
        outcomes = ", ".join(f"{name} {number:,}" for name, number in self.outcomes.most_common())
        lines = [f"{self.name}: {self.count:,} cases in {self.seconds:.0f} s ({outcomes})"]
        lines.append(f"  wrong {self.wrong:,}, of which hangs {self.hangs:,}, aborts {self.aborts:,}")
        for value in dict.fromkeys(value for _, value in self.ratios):
            ratios = [ratio for (_, name), some in self.ratios.items() if name == value for ratio in some]
            lines.append(f"  bound/error of {value}: median {share(ratios, 0.5):.3g}, 99 % below {share(ratios, 0.99):.3g}")
        return "\n".join(lines)


def share(values, part):
    """The value below which a part of all values is."""
    return sorted(values)[min(int(part * len(values)), len(values) - 1)]


WORDS = """\
Random scenes, drawn by seed in families, are solved, and the answers are judged by other means than those of the program:

* rational arithmetic;
* free motions passed from hinge to hinge;
* the standard library's own reading of a file;
* sanitizers, and limits set by the system.

A case counts as wrong if any part of the promise is broken for it. A hang gives no answer in time, an abort ends the process, and
both count as wrong. A scene that reproduces it is written to a file.
"""
BOUNDS = """\
Error bounds are divided by the true errors of the same state. An error counts as at least half a unit in the last place of the
largest value:
"""


def markdown(rows, command):
    """The page of the documentation.

    Parameters
    ----------
    rows : list of Row
    command : str
        What it is made by.

    Returns
    -------
    str
    """
    lines = ["# Reliability", "", f"This page is made by `{command}`.", "", WORDS]
    lines += ["| family | cases | wrong | hangs | aborts | what is promised |", "|---|---:|---:|---:|---:|---|"]
    lines += [f"| {r.name} | {r.count:,} | {r.wrong:,} | {r.hangs:,} | {r.aborts:,} | {r.promise} |" for r in rows]
    lines += ["", "What the cases were:", "", "| family | outcome | cases |", "|---|---|---:|"]
    lines += [f"| {r.name} | {outcome} | {number:,} |" for r in rows for outcome, number in r.outcomes.most_common()]
    bounds = [(row.name, *key, ratios) for row in rows for key, ratios in sorted(row.ratios.items())]
    if bounds:
        lines += ["", BOUNDS, "| family | scenes | bound of | median | 99 % below |", "|---|---|---|---:|---:|"]
        lines += [f"| {name} | {kind} | {value} | {share(v, 0.5):.2g} | {share(v, 0.99):.2g} |" for name, kind, value, v in bounds]
    return "\n".join(lines) + "\n"
