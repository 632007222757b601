"""States of a beam: steps, their fields, what is free to move."""
