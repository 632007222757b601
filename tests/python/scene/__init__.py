"""What a user writes: keys, values, names, places, refusals."""
