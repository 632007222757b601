"""Largest and smallest values: at full load, over the way of the load, on the ground."""
