"""A scene for every row of a table."""
