"""Studies that measure the program itself."""
