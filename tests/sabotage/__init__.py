"""Sabotage of gapbeam: one line of it changed at a time, to see whether the tests of that room notice."""
