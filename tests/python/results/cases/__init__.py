"""Many load cases, combinations, numbers by case."""
