"""What everything else is made with: errors, records, files, memory."""
