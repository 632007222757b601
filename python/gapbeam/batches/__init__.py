"""One scene with some of its numbers taken from the rows of a table, solved row by row into files that last."""
