"""Common base: errors, records of arrays, files, memory."""
