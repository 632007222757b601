"""Studies of the program itself: error against run time, solves, corners."""
