"""Results of a scene: steps, fields, paths, load cases."""
