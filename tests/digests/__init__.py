"""Digests of everything gapbeam computes, of two commits side by side; `python tests/digests --help`."""
