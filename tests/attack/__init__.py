"""Attacks on gapbeam: cases drawn at random in families, judged by means of their own; `python tests/attack --help`."""
