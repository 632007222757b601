"""The compiled layer: what crosses it, and calls that end."""
