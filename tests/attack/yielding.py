"""Histories of yielding supports under axial forces and on two-sided ground beside exact ones."""

from oracle.axial_history import CondensedBeam
from oracle.cells import Loose
from scenes.law import in_stretches

from .family import Family, Verdict
from .laws import judge_history

PROMISE = (
    "Under an axial force that stays, and on ground that holds both ways by k alone, states and sets after histories of plastic "
    "supports are those of exact histories on compliances in 90 digits"
)


def judge(made, seed=0):
    """Follow a scene and compare it with its exact history."""
    try:
        return judge_history(made, CondensedBeam(made))
    except Loose:
        return Verdict("nothing but yielding supports holds it")


FAMILY = Family("yielding", PROMISE, in_stretches, judge, share=0.2)
