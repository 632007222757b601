"""Common base of the package: errors, records of arrays, files, memory."""
