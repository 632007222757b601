"""Results as pictures."""

from .path import path_figure, plot_path
from .result import figure, plot

__all__ = ["figure", "path_figure", "plot", "plot_path"]
