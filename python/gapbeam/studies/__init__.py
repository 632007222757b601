"""The study that is for users: error against run time, on families of beams or on their own."""
