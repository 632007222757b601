"""Largest and smallest values."""
