"""The command, its messages and exit statuses."""
