"""Tests of the Python package, in rooms as those of `python/gapbeam`."""
