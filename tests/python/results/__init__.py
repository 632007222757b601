"""What comes of a scene: as plain data, and as proofs."""
