"""Results as a page of HTML that one moves, prints and signs: one file, without anything from elsewhere."""
