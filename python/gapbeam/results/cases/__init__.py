"""Many cases and combinations of one beam."""
