"""Paths and histories of supports that soften or break, under axial forces and on two-sided ground, beside exact ones."""

from oracle.axial_history import CondensedBeam
from oracle.cells import Loose
from scenes.law import in_stretches

from .family import Family, Verdict
from .laws import judge as judge_on_laws

PROMISE = (
    "Under an axial force that stays, and on ground that holds both ways by k alone, paths of softening supports have the "
    "segments of exact ones on compliances in 90 digits. Histories of brittle ones have their states"
)


def draw(seed):
    """Kind and scene of a seed."""
    return in_stretches(seed, ("softening", "softening", "softening", "broken"))


def judge(made, seed=0):
    """Follow a scene and compare it with its exact path or history."""
    try:
        return judge_on_laws(made, problem=CondensedBeam(made))
    except Loose:
        return Verdict("nothing but supports with laws holds it")


FAMILY = Family("softening", PROMISE, draw, judge, share=0.2)
