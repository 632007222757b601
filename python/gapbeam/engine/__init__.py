"""Typed calls of the Fortran engine."""
