"""What everything is made with: files, memory, characters."""
