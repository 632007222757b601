"""Pictures, reports and files of verbs of results."""
