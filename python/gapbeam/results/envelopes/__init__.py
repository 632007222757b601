"""Largest and smallest values: at full load, over the loading history, on the ground."""
