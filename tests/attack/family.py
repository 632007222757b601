"""A family of attacks: how its cases are drawn, judged and written."""

import json
import re
import traceback
from collections.abc import Callable
from dataclasses import dataclass, field

from .workers import Ended, judge_all


@dataclass
class Verdict:
    """What became of one case.

    Attributes
    ----------
    outcome : str
        solved, no-equilibrium, ...; hang or aborted where the process did not live to say it.
    wrong : list of str
        How the program breaks its promise; empty if it does not.
    ratios : dict
        By value, bounds divided by the true errors.
    kind : str
        How the case was drawn.
    """

    outcome: str = ""
    wrong: list = field(default_factory=list)
    ratios: dict = field(default_factory=dict)
    kind: str = ""


def write_scene(made, title):
    """A scene as the text of a JSON file whose title says what is wrong."""
    return ".json", (json.dumps({"title": title[:2000], **made}) + "\n").encode()


def read_scene(path):
    """A scene that was written, and its seed."""
    made = json.loads(path.read_bytes())
    seed = re.match(r"\w+ (\d+):", made.pop("title", ""))
    return made, int(seed[1]) if seed else 0


@dataclass(frozen=True)
class Family:
    """How cases are drawn, judged and written.

    Attributes
    ----------
    name : str
    promise : str
        What is promised for all of its cases.
    draw : callable
        From a seed to a kind and a case.
    judge : callable
        From a case and its seed to a `Verdict`.
    write, read : callable
        From a case and a title to the suffix and the bytes of a file; from its path to the case and its seed.
    share : float
        Of the cases asked for, those that are drawn: cases of some families take a hundred times as long as those of others.
    """

    name: str
    promise: str
    draw: Callable
    judge: Callable
    write: Callable = write_scene
    read: Callable = read_scene
    share: float = 1.0

    def judged(self, case, seed):
        """The verdict on a case; an exception that nobody promised is one, too."""
        try:
            return self.judge(case, seed)
        except Exception as error:
            place = traceback.extract_tb(error.__traceback__)[-1]
            return Verdict("raised", [f"{type(error).__name__}: {error} ({place.filename}, line {place.lineno})"])

    def judge_seed(self, seed):
        """Draw the case of a seed and judge it."""
        kind, case = self.draw(seed)
        verdict = self.judged(case, seed)
        verdict.kind = kind
        return verdict

    def verdicts(self, seeds, jobs, limit, until):
        """Judge the cases of many seeds; pairs of seed and verdict, as they come.

        Parameters
        ----------
        seeds : iterable of int
        jobs : int
        limit : float
            Seconds for one case.
        until : float
            Monotonic time after which no new case begins.
        """
        for seed, answer in judge_all(self.judge_seed, seeds, jobs, limit, until):
            yield seed, Verdict(answer.outcome, [answer.how]) if isinstance(answer, Ended) else answer

    def failure(self, seed, verdict):
        """Name and bytes of the file that reproduces a failure."""
        suffix, text = self.write(self.draw(seed)[1], f"{self.name} {seed}: {'; '.join(verdict.wrong)}")
        return f"{self.name}-{seed}{suffix}", text
