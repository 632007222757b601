"""Scenes with which the program was once caught."""
