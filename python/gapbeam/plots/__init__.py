"""Results as pictures."""

from .hysteresis import hysteresis_figure
from .path import path_figure, plot_path
from .result import figure, plot

__all__ = ["figure", "hysteresis_figure", "path_figure", "plot", "plot_path"]
