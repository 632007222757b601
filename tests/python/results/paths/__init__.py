"""The loading history: events, laws, limit points, branches."""
