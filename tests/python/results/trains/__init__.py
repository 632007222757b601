"""Loads that move: events, envelopes, influence lines."""
