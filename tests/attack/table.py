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
        By value, bounds divided by the true errors.
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
        for kind, ratios in verdict.ratios.items():
            self.ratios.setdefault(kind, []).extend(ratios)

    @property
    def count(self):
        """Cases."""
        return self.outcomes.total()

    def text(self):
        """A few lines for the screen."""
        outcomes = ", ".join(f"{name} {number:,}" for name, number in self.outcomes.most_common())
        lines = [f"{self.name}: {self.count:,} cases in {self.seconds:.0f} s ({outcomes})"]
        lines.append(f"  wrong {self.wrong:,}, of which hangs {self.hangs:,}, aborts {self.aborts:,}")
        for kind, ratios in self.ratios.items():
            lines.append(f"  bound/error of {kind}: median {share(ratios, 0.5):.3g}, 99 % below {share(ratios, 0.99):.3g}")
        return "\n".join(lines)


def share(values, part):
    """The value below which a part of all values is."""
    return sorted(values)[min(int(part * len(values)), len(values) - 1)]


WORDS = """\
Every family draws its cases by seed and judges the answers by means of its own: rational arithmetic, free motions from hinge
to hinge, limits that the system sets. A case counts as wrong if any part of the promise is broken for it; one that gives no
answer in time is a hang, one that ends the process an abort, and both count as wrong. Bounds are compared with the true error
or half a unit in the last place of the largest value, whichever is larger.
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
    lines += ["", "| family | outcome | cases |", "|---|---|---:|"]
    lines += [f"| {r.name} | {outcome} | {number:,} |" for r in rows for outcome, number in r.outcomes.most_common()]
    bounds = [(r, kind, ratios) for r in rows for kind, ratios in r.ratios.items()]
    if bounds:
        lines += ["", "| family | bound of | median of bound/error | 99 % below |", "|---|---|---:|---:|"]
        lines += [f"| {r.name} | {kind} | {share(v, 0.5):.2g} | {share(v, 0.99):.2g} |" for r, kind, v in bounds]
    return "\n".join(lines) + "\n"
