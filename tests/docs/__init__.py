"""What the pages say, and that the house stands as they say."""
