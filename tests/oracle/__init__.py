"""Independent solutions, in rational numbers or many digits, by other methods than the engine's: they import nothing of it.

`equilibrium` has what most of the tests ask for.
"""

from .equilibrium import Oracle, Redundant, solve, to_mpf
from .forms import cone_rays, dot, null_space

__all__ = ["Oracle", "Redundant", "cone_rays", "dot", "null_space", "solve", "to_mpf"]
