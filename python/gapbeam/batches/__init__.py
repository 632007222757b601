"""Batches of cases: one scene with numbers from the rows of a table, solved row by row into files that last."""
