"""Beams on supports that act one way only: gaps, lift-off, hinges, solved by the classical mixed method.

Five lines are enough:

>>> import gapbeam
>>> scene = gapbeam.Scene(beam=gapbeam.Beam(spans=[6.0, 6.0], EI=1e4), loads=[gapbeam.UniformLoad(q=5.0, to=6.0)])
>>> scene.supports = [gapbeam.Support(node=i, side="below") for i in range(3)]
>>> scene.loads.append(gapbeam.UniformLoad(q=1.0, case="dead"))
>>> gapbeam.solve(scene).steps[-1].reaction.round(3)
array([15.375, 26.25 ,  0.375])

Units: any consistent set. Signs: x to the right; deflections and loads positive downward, reactions upward, moments
sagging, rotations and couples clockwise.
"""

TYPE_CHECKING = False  # that of typing would be imported before the command can see to signals
if TYPE_CHECKING:
    from .interface import *  # noqa: F403


def __getattr__(name: str) -> object:
    """Import what is first asked for, so that the command can report when that fails, or is interrupted."""
    from importlib import import_module
    from importlib.util import find_spec

    if find_spec(f"{__name__}.{name}"):
        return import_module(f"{__name__}.{name}")
    interface = import_module(f"{__name__}.interface")
    later = {*interface.LATER, "__version__"}
    globals().update({key: getattr(interface, key) for key in ("__all__", *interface.__all__) if key == name or key not in later})
    if name not in globals():
        raise AttributeError(interface.no_such_name(name))
    return globals()[name]


def __dir__() -> list[str]:
    return sorted(__getattr__("__all__"))
