"""The study for users: error against run time, on families of beams or on their own."""
