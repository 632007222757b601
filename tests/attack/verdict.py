"""What became of one attack."""

from dataclasses import dataclass, field


@dataclass
class Verdict:
    """What became of one scene.

    Attributes
    ----------
    outcome : str
        What the exact solution says it is: solved, no-equilibrium, ...
    wrong : list of str
        How the program disagrees; empty if it does not.
    ratios : dict
        By value, bounds divided by the true errors.
    """

    outcome: str = ""
    wrong: list = field(default_factory=list)
    ratios: dict = field(default_factory=dict)
