"""Text, JSON and CSV."""
