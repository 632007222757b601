"""What a user writes: scenes in TOML, JSON or Python, read and checked."""

from .structs import *  # noqa: F403
from .structs import __all__ as __all__
