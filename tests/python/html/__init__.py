"""Pages of HTML: what stands in them, and what they do in a browser."""
