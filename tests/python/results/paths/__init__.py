"""The way of the load: events, laws, limit points, branches."""
