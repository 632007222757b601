"""Trains on their way over a beam, and what they make at most."""
