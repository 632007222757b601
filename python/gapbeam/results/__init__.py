"""What came of a scene: steps, fields, paths, load cases."""
