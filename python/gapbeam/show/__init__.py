"""Pictures, reports and files behind the verbs of results."""
